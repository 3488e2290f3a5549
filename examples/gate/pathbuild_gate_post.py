"""A post-processor for FreeCAD's CAM workbench: what its post for GRBL makes is only written if `pathbuild verify` finds no error in it.

Copy this file to FreeCAD's directory of macros; `pathbuild_gate` is then among the post-processors of a job. OPTIONS are those of `verify`.
"""

import os
import subprocess
import tempfile

from Path.Post.scripts import grbl_post as post

OPTIONS = ["--require", "rapids=assumed"]

TOOLTIP = post.TOOLTIP
TOOLTIP_ARGS = post.TOOLTIP_ARGS


def export(objectslist, filename, argstring):
    gcode = post.export(objectslist, "-", argstring)
    is_file = filename != "-"
    # Beside the program, so that the pathbuild.toml of its directory applies.
    beside = os.path.dirname(os.path.abspath(filename)) if is_file else None
    with tempfile.TemporaryDirectory(dir=beside) as directory:
        program = os.path.join(directory, os.path.basename(filename) if is_file else "program.nc")
        with open(program, "w") as file:
            file.write(gcode)
        verified = subprocess.run(["pathbuild", "verify", *OPTIONS, "--", program], capture_output=True, text=True)
    if verified.returncode != 0:
        raise RuntimeError("pathbuild: the program was not written\n" + verified.stdout + verified.stderr)
    if is_file:
        with open(filename, "w") as file:
            file.write(gcode)
    return gcode
