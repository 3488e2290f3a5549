#!/usr/bin/env python3
"""Writes programs.bzl for the library in this directory: of each path of `[emit] targets` how it is asked for, its files, and the drawings
that are read for it, as `pathbuild emit --deps` tells them. Run it again when that changes; :NAME_check tells when that is.
With `-` it prints to standard output."""
import json
import os
import re
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path


def main():
    lines = ['"""Written by configure.py."""\n', "PROGRAMS = {"]
    for path, *values in targets():
        lines += [f"    {json.dumps(path)}: (", *(f"        {json.dumps(value)}," for value in values), "    ),"]
    text = "\n".join([*lines, "}", ""])
    if sys.argv[1:] == ["-"]:
        sys.stdout.write(text)
    else:
        Path("programs.bzl").write_text(text, encoding="utf-8")


def targets():
    """Of each path: its name, how it is asked for, its files, the drawings."""
    asked = how_asked()
    with tempfile.TemporaryDirectory() as temporary:
        rules = Path(temporary) / "rules.d"
        rows = told("emit", "--check", "--deps", rules)
        text = rules.read_text(encoding="utf-8")
    paths = {from_here(row["file"]): row["path"] for row in rows if row["type"] == "output"}
    for line in text.split("\n")[:-1]:
        outputs, sources = (names(side) for side in re.split(r"(?<!\\):", line, maxsplit=1))
        # The empty rules of inputs are for make.
        if not sources:
            continue
        path = paths[outputs[0]]
        yield path, asked[path], outputs, [name for name in sources if name.lower().endswith(".dxf")]


def names(text):
    """The names of one side of a rule for make."""
    return [re.sub(r"\\(.)", r"\1", name).replace("$$", "$") for name in re.findall(r"(?:\\.|[^ \\])+", text)]


def how_asked():
    """A path that is alone in its drawing is asked for by the drawing, as Q-projects have to be, another by its name."""
    drawings = {row["path"]: row["file"] for row in told("list") if row["type"] == "path"}
    paths = Counter(drawings.values())
    return {path: from_here(file) if paths[file] == 1 else path for path, file in drawings.items()}


# Programs that are missing, out of date, or of no use any more: the build writes them, or leaves them alone.
NOT_CURRENT = {"PB520", "PB522", "PB528"}


def told(*command):
    """What a command says in JSON."""
    run = subprocess.run(["pathbuild", *command, "--quiet", "--no-cache", "--format", "json"], stdout=subprocess.PIPE)
    rows = [json.loads(line) for line in run.stdout.splitlines()]
    errors = [row for row in rows if row["type"] == "finding" and row["severity"] == "error"]
    if not rows or any(row["code"] not in NOT_CURRENT for row in errors):
        sys.exit("configure.py: fix the errors first, `pathbuild check` shows them")
    return rows


def from_here(name):
    """A name of JSON, which counts from the repository's root."""
    here = Path.cwd()
    root = next((place for place in [here, *here.parents] if (place / ".git").exists()), here)
    return os.path.relpath(root / name)


main()
