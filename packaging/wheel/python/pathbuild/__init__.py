"""Checks drawings of milling paths and compiles them to G-code.

Each function runs the program that this package brings and reads its JSON. Inputs are what the command line takes: drawings, names of
paths or patterns of them, directories. Without inputs it is the library of `directory`, which is the working directory unless given.
Lengths are in mm, feeds in mm/min, angles in degrees.

    >>> import pathbuild
    >>> for finding in pathbuild.check(directory="library").findings:
    ...     print(finding.code, finding.file, finding.message)

A finding is a result, not an exception. `Failed` is raised if the program could not do its work at all, and by `moves` and `scene` if
the drawing has errors.
"""

from __future__ import annotations

import dataclasses
import json
import os
import shutil
import subprocess
import sysconfig
import tempfile
from dataclasses import dataclass
from typing import Any, Dict, Iterable, List, Optional, Sequence, Tuple, Type, TypeVar, Union

__all__ = [
    "Agreement", "Arc", "Box", "CheckResult", "EmitResult", "Failed", "Finding", "Move", "Output", "Path", "Place", "VerifyResult",
    "check", "emit", "moves", "paths", "program", "scene", "verify",
]

Name = Union[str, "os.PathLike[str]"]
Ends = Optional[Tuple[float, float]]
Point = Tuple[Optional[float], Optional[float], Optional[float]]


@dataclass(frozen=True)
class Place:
    """Where a project embeds a path."""

    file: str
    path: str
    x: float
    y: float


@dataclass(frozen=True)
class Finding:
    """An error or a warning. Fields that do not apply are None."""

    code: str
    """For example `PB107`; `pathbuild explain PB107` explains it."""
    name: str
    severity: str
    """`error` or `warning`."""
    message: str
    help: Optional[str]
    notes: Tuple[str, ...]
    file: Optional[str]
    """Relative to the repository's root, or else to the directory of pathbuild.toml."""
    line: Optional[int]
    path: Optional[str]
    layer: Optional[str]
    handle: Optional[str]
    entity: Optional[str]
    x: Optional[float]
    y: Optional[float]
    text: Optional[str]
    span: Optional[Tuple[int, int]]
    """The wrong characters of `text`: the first, and the one behind the last."""
    trace: Tuple[Place, ...]
    """The projects through which the element was reached, outermost first."""

    @property
    def is_error(self) -> bool:
        return self.severity == "error"


@dataclass(frozen=True)
class Box:
    """The ends in each direction; None where nothing is cut."""

    x: Ends
    y: Ends
    z: Ends


@dataclass(frozen=True)
class Path:
    """A path as `pathbuild list` shows it. What its errors leave unknown is None."""

    path: str
    file: str
    material: Optional[str]
    thickness: Optional[float]
    tool: Optional[float]
    """Diameter of the cutter."""
    size: Ends
    cutting_box: Box
    length: Optional[float]
    minutes: Optional[float]
    state: str
    """`errors`, `stale`, `current` or `ok`."""
    program: Optional[str]
    """Whether the program on disk is `current` or `stale`; None if there is none."""
    errors: int
    warnings: int


@dataclass(frozen=True)
class Output:
    """A file, and what became of it."""

    file: str
    path: Optional[str]
    state: str
    """`written` or `unchanged`; from `emit(check=True)` `current`, `stale` or `missing`."""
    length: Optional[float] = None
    minutes: Optional[float] = None


@dataclass(frozen=True)
class Agreement:
    """How many moves the path's program has, and how many a file has alike before the first that differs."""

    file: str
    path: str
    drawing: str
    dialect: str
    moves: int
    equal: int


@dataclass(frozen=True)
class Arc:
    """A circular arc, or a helix where the ends differ across its plane."""

    axes: Tuple[int, int]
    """The plane: 0 is X, 1 is Y, 2 is Z."""
    centre: Tuple[float, float]
    """In these axes."""
    clockwise: bool
    degrees: float


@dataclass(frozen=True)
class Move:
    kind: str
    """`sweep`, `lift`, `plunge`, `mill`, `mark` or `probe`."""
    start: Point
    """None for a coordinate that is not known yet."""
    end: Point
    length: Optional[float]
    line: Optional[int]
    """Line of the program, counted from 1."""
    feed: Optional[float] = None
    arc: Optional[Arc] = None
    element: Optional[int] = None
    """Index of the element in `elements` of the path's `scene`."""


@dataclass(frozen=True)
class CheckResult:
    findings: List[Finding]
    paths: int
    drawings: int

    @property
    def ok(self) -> bool:
        """Whether there are no errors."""
        return not any(finding.is_error for finding in self.findings)


@dataclass(frozen=True)
class EmitResult:
    findings: List[Finding]
    outputs: List[Output]

    @property
    def ok(self) -> bool:
        """Whether there are no errors."""
        return not any(finding.is_error for finding in self.findings)


@dataclass(frozen=True)
class VerifyResult:
    findings: List[Finding]
    agreements: List[Agreement]
    configuration: Optional[str]
    """The pathbuild.toml that applied."""

    @property
    def ok(self) -> bool:
        """Whether there are no errors."""
        return not any(finding.is_error for finding in self.findings)


class Failed(Exception):
    """The program could not do its work; `findings` says why if the cause is in the drawings."""

    def __init__(self, message: str, findings: Sequence[Finding] = ()) -> None:
        super().__init__(message)
        self.findings = list(findings)


def check(*inputs: Name, directory: Optional[Name] = None, options: Iterable[str] = ()) -> CheckResult:
    """Checks paths and writes nothing. `options` are further options of the command line, here and below."""
    rows = _run("check", inputs, options, directory)
    summary = rows[-1]
    return CheckResult(_findings(rows), paths=summary["paths"], drawings=summary["drawings"])


def paths(*inputs: Name, directory: Optional[Name] = None, options: Iterable[str] = ()) -> List[Path]:
    """Lists paths. Raises `Failed` if an input names nothing."""
    rows = _run("list", inputs, options, directory)
    _raise_errors(_findings(rows))
    return [_path(row) for row in rows if row["type"] == "path"]


def emit(
    *inputs: Name,
    directory: Optional[Name] = None,
    post: Optional[Name] = None,
    out_dir: Optional[Name] = None,
    check: bool = False,
    options: Iterable[str] = (),
) -> EmitResult:
    """Writes programs; with `check`, only says which of them are out of date."""
    arguments = [*_option("--post", post), *_option("--out-dir", out_dir), *(["--check"] if check else []), *options]
    rows = _run("emit", inputs, arguments, directory)
    return EmitResult(_findings(rows), [_from_row(Output, row) for row in rows if row["type"] == "output"])


def verify(
    *programs: Name, directory: Optional[Name] = None, against: Optional[str] = None, options: Iterable[str] = ()
) -> VerifyResult:
    """Checks G-code programs; with `against`, also compares them with the drawing of this path."""
    rows = _run("verify", programs, [*_option("--against", against), *options], directory)
    agreements = [_from_row(Agreement, row) for row in rows if row["type"] == "agreement"]
    return VerifyResult(_findings(rows), agreements, rows[-1].get("configuration"))


def scene(path_or_drawing: Name, *, directory: Optional[Name] = None, options: Iterable[str] = ()) -> Dict[str, Any]:
    """All that a picture of the path or drawing shows, as the book describes it under "The scene as data"."""
    with tempfile.TemporaryDirectory(prefix="pathbuild-") as place:
        file = os.path.join(place, "scene.json")
        _raise_errors(_findings(_run("view", [path_or_drawing], ["-o", file, *options], directory)))
        with open(file, encoding="utf-8") as text:
            data: Dict[str, Any] = json.load(text)
    return data


def moves(
    path: str, *, drawing: Optional[Name] = None, directory: Optional[Name] = None, options: Iterable[str] = ()
) -> List[Move]:
    """The moves of one path's program, in their order. `drawing` is needed if the name of the path's drawing does not cover the path."""
    if drawing is None:
        drawing = path
    for row in scene(drawing, directory=directory, options=options)["paths"]:
        if row["name"].casefold() == path.casefold():
            return [_move(move) for move in row["moves"]]
    raise Failed(f"{os.fspath(drawing)} has no path {path}")


def program() -> str:
    """The program's file: that of this package, or else the one on PATH."""
    name = "pathbuild" + (sysconfig.get_config_var("EXE") or "")
    user = sysconfig.get_path("scripts", "nt_user" if os.name == "nt" else "posix_user")
    for directory in (sysconfig.get_path("scripts"), user):
        file = os.path.join(directory, name)
        if os.path.isfile(file):
            return file
    on_path = shutil.which(name)
    if on_path is None:
        raise Failed(f"{name} is neither beside this Python nor on PATH; install the wheel again")
    return on_path


def _run(command: str, inputs: Iterable[Name], options: Iterable[str], directory: Optional[Name]) -> List[Dict[str, Any]]:
    # Behind `--`, an input that begins with a hyphen is no option.
    arguments = [program(), command, "--format", "json", *options, "--", *(os.fspath(name) for name in inputs)]
    run = subprocess.run(arguments, cwd=directory, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if run.returncode not in (0, 1):
        raise Failed(run.stderr.decode("utf-8", "replace").strip() or f"pathbuild {command} ended with {run.returncode}")
    return [json.loads(line) for line in run.stdout.decode("utf-8").splitlines()]


def _option(name: str, value: Optional[Name]) -> List[str]:
    return [] if value is None else [name, os.fspath(value)]


T = TypeVar("T")


def _from_row(kind: Type[T], row: Dict[str, Any], **parts: Any) -> T:
    """Builds a result from a row of JSON, and ignores fields that later versions add."""
    names = [field.name for field in dataclasses.fields(kind) if field.name in row]  # type: ignore[arg-type]
    return kind(**{**{name: _frozen(row[name]) for name in names}, **parts})


def _frozen(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value


def _findings(rows: List[Dict[str, Any]]) -> List[Finding]:
    findings = (row for row in rows if row["type"] == "finding")
    return [_from_row(Finding, row, trace=tuple(_from_row(Place, place) for place in row["trace"])) for row in findings]


def _path(row: Dict[str, Any]) -> Path:
    return _from_row(Path, row, cutting_box=_from_row(Box, row["cutting_box"]))


def _move(row: Dict[str, Any]) -> Move:
    arc = _from_row(Arc, row["arc"]) if row.get("arc") else None
    return _from_row(Move, row, start=tuple(row["from"]), end=tuple(row["to"]), arc=arc)


def _raise_errors(findings: List[Finding]) -> None:
    errors = [finding for finding in findings if finding.is_error]
    if errors:
        raise Failed(errors[0].message, findings)
