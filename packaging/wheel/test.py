"""Compares the Python package with the program's JSON over a library: packaging/wheel/test.py LIBRARY.

packaging/try runs it with the Python of a venv that has the wheel. Without a wheel, PATH must contain the program's directory, and
PYTHONPATH the absolute name of packaging/wheel/python.
"""

import dataclasses
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import pathbuild

PAGES = sorted(pathlib.Path(__file__).resolve().parents[2].glob("docs/*/src/howto/python.md"))
BROKEN = "mistakes/3004.1P.dxf"


def rows(command, *arguments):
    """What the command line prints, by type of row."""
    run = subprocess.run([pathbuild.program(), command, *arguments, "--format", "json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    by_type = {}
    for line in run.stdout.decode("utf-8").splitlines():
        row = json.loads(line)
        by_type.setdefault(row.pop("type"), []).append(row)
    return by_type


def plain(results):
    """Typed results as JSON has them."""
    return json.loads(json.dumps([dataclasses.asdict(result) for result in results]))


class Equal(unittest.TestCase):
    maxDiff = None

    def test_check(self):
        expected, checked = rows("check"), pathbuild.check()
        self.assertEqual(plain(checked.findings), expected.get("finding", []))
        self.assertEqual((checked.paths, checked.drawings), (expected["summary"][0]["paths"], expected["summary"][0]["drawings"]))
        self.assertGreater(checked.paths, 0)
        self.assertTrue(checked.ok)

    def test_check_of_broken_drawings(self):
        expected, checked = rows("check", "mistakes"), pathbuild.check("mistakes")
        self.assertEqual(plain(checked.findings), expected["finding"])
        self.assertFalse(checked.ok)

    def test_paths(self):
        self.assertEqual(plain(pathbuild.paths()), rows("list")["path"])
        self.assertEqual(plain(pathbuild.paths(BROKEN)), rows("list", BROKEN)["path"])

    def test_emit_and_verify(self):
        with tempfile.TemporaryDirectory() as place:
            written = pathbuild.emit("2050.1P", out_dir=place)
            self.assertEqual([output.state for output in written.outputs], ["written"])
            again = rows("emit", "2050.1P", "--out-dir", place)["output"]
            self.assertEqual(plain(pathbuild.emit("2050.1P", out_dir=place).outputs), again)
            self.assertEqual([output.state for output in pathbuild.emit("2050.1P", out_dir=place, check=True).outputs], ["current"])

            file = written.outputs[0].file
            expected, verified = rows("verify", file, "--against", "2050.1P"), pathbuild.verify(file, against="2050.1P")
            self.assertEqual(plain(verified.agreements), expected["agreement"])
            self.assertEqual(plain(verified.findings), expected.get("finding", []))
            self.assertEqual(verified.configuration, expected["summary"][0]["configuration"])

    def test_moves(self):
        with tempfile.TemporaryDirectory() as place:
            file = os.path.join(place, "scene.json")
            rows("view", "2050.1P", "-o", file)
            with open(file, encoding="utf-8") as text:
                data = json.load(text)
        names = {"from": "start", "to": "end"}
        expected = [{names.get(name, name): value for name, value in move.items()} for move in data["paths"][0]["moves"]]
        actual = [{name: value for name, value in move.items() if value is not None} for move in plain(pathbuild.moves("2050.1P"))]
        self.assertEqual(actual, expected)
        self.assertEqual(pathbuild.scene("2050.1P"), data)

    def test_moves_of_a_path_that_its_drawing_does_not_name(self):
        with self.assertRaises(pathbuild.Failed):
            pathbuild.moves("2057.0Q")
        self.assertGreater(len(pathbuild.moves("2057.0Q", drawing="components/2057.1-2057.2P_Q.dxf")), 0)
        with self.assertRaisesRegex(pathbuild.Failed, "has no path 2050.1P"):
            pathbuild.moves("2050.1P", drawing="components/2057.1-2057.2P_Q.dxf")

    def test_what_cannot_be_done(self):
        with self.assertRaisesRegex(pathbuild.Failed, "nosuch"):
            pathbuild.paths("nosuch.1P")
        with self.assertRaises(pathbuild.Failed) as raised:
            pathbuild.moves("nosuch.1P")
        self.assertEqual([finding.code for finding in raised.exception.findings], ["PB503"])
        with self.assertRaisesRegex(pathbuild.Failed, "--no-such-option"):
            pathbuild.check(options=["--no-such-option"])
        self.assertFalse(pathbuild.check("--no-such-file").ok)

    def test_the_examples_of_the_book_run(self):
        examples = [code for page in PAGES for code in re.findall("^```python\n(.*?)^```", page.read_text(encoding="utf-8"), re.M | re.S)]
        self.assertEqual(len(examples), 4)
        for code in examples:
            subprocess.run([sys.executable, "-c", code], stdout=subprocess.DEVNULL, check=True)

    def test_the_module_is_the_program(self):
        for arguments in (["list", "--format", "json"], ["check", BROKEN, "--format", "json"], ["--no-such-option"]):
            command = subprocess.run([pathbuild.program(), *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            module = subprocess.run([sys.executable, "-m", "pathbuild", *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.assertEqual((module.returncode, module.stdout), (command.returncode, command.stdout))


if __name__ == "__main__":
    library = os.path.abspath(sys.argv.pop(1))
    with tempfile.TemporaryDirectory() as place:
        os.chdir(shutil.copytree(library, os.path.join(place, "library")))
        run = unittest.main(exit=False)
        os.chdir(library)
    sys.exit(not run.result.wasSuccessful())
