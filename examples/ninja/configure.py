#!/usr/bin/env python3
"""Writes build.ninja for the library in this directory: an edge for each path of `[emit] targets`. Ninja runs it again by itself when a drawing
comes or goes and when pathbuild.toml changes; a path that comes into a drawing that is there needs a run by hand."""
import json
import os
import shlex
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path

# `library` and `search` of pathbuild.toml.
DIRECTORIES = ["components", "projects"]

RULES = """\
ninja_required_version = 1.9

rule configure
  command = {python} $in
  description = CONFIGURE
  generator = 1

# The names of all drawings. The list changes only when a drawing comes or goes, which may define a path again.
rule names
  command = find $in -type d -o -name '*.[dD][xX][fF]' | LC_ALL=C sort -u > $out.new; cmp -s $out.new $out && rm $out.new || mv $out.new $out
  description = NAMES
  restat = 1

# pathbuild leaves a program alone that is as it should be, and restat stops there.
rule emit
  command = {pathbuild} emit $asked --quiet --deps .ninja/$path.d
  description = EMIT $path
  depfile = .ninja/$path.d
  deps = gcc
  restat = 1

# Something that is made of the programs: here their checksums.
rule checksums
  command = sha256sum $in > $out
  description = CHECKSUMS

build .ninja/names: names {directories}
build build.ninja: configure configure.py | .ninja/names pathbuild.toml
"""


def main():
    directories = {below for top in DIRECTORIES for below, _, _ in os.walk(top)}
    pathbuild = shutil.which("pathbuild")
    edges, programs = [], []
    for path, (asked, files) in targets().items():
        inputs = names([".ninja/names", pathbuild])
        edges.append(f"build {names(files)}: emit | {inputs}\n  path = {path}\n  asked = {escaped(shlex.quote(asked))}\n")
        programs += [file for file in files if file.endswith(".gcode")]
    edges.append(f"build gcode.sha256: checksums {names(programs)}\n")
    rules = RULES.format(pathbuild=pathbuild, python=sys.executable, directories=names(sorted(directories)))
    Path("build.ninja").write_text("\n".join([rules, *edges]), encoding="utf-8")


def targets():
    """Of each path of `[emit] targets` how it is asked for, and its files."""
    asked, outputs = how_asked(), {}
    for row in told("emit", "--check"):
        if row["type"] == "output" and row["path"]:
            outputs.setdefault(row["path"], (asked[row["path"]], []))[1].append(from_here(row["file"]))
    return outputs


def how_asked():
    """A path that is alone in its drawing is asked for by the drawing, as Q-projects have to be, another by its name."""
    drawings = {row["path"]: row["file"] for row in told("list") if row["type"] == "path"}
    paths = Counter(drawings.values())
    return {path: from_here(file) if paths[file] == 1 else path for path, file in drawings.items()}


# Programs that are missing, out of date, or of no use any more: the build writes them, or leaves them alone.
NOT_CURRENT = {"PB520", "PB522", "PB528"}


def told(*command):
    """What a command says in JSON."""
    run = subprocess.run(["pathbuild", *command, "--quiet", "--format", "json"], stdout=subprocess.PIPE)
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


def names(files):
    return " ".join(escaped(file).replace(" ", "$ ").replace(":", "$:") for file in files)


def escaped(text):
    return text.replace("$", "$$")


main()
