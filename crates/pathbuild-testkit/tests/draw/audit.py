"""Reads DXF files with ezdxf and audits them: prints what is wrong, and exits with 1 if anything is.

Needs ezdxf 1.4 (pip install ezdxf). A file must be read without recovery, without errors and without fixes.
"""

import logging
import sys

import ezdxf


class Warnings(logging.Handler):
    """Remarks that ezdxf makes while it loads a file, such as handles that are used twice."""

    def __init__(self):
        super().__init__(level=logging.WARNING)
        self.lines = []

    def emit(self, record):
        self.lines.append(record.getMessage())


def audit(path):
    warnings = Warnings()
    logging.getLogger("ezdxf").addHandler(warnings)
    try:
        drawing = ezdxf.readfile(path)
        auditor = drawing.audit()
        found = [entry.message for entry in auditor.errors + auditor.fixes]
        return found + warnings.lines, len(drawing.modelspace())
    except (IOError, ezdxf.DXFError) as error:
        return [str(error)], 0
    finally:
        logging.getLogger("ezdxf").removeHandler(warnings)


def main(paths):
    faulty = 0
    for path in paths:
        found, entities = audit(path)
        faulty += bool(found)
        for line in found:
            print(f"{path}: {line}")
        if not found:
            print(f"{path}: {entities} entities")
    return 1 if faulty else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
