"""A zip archive of a directory whose bytes depend on its files only: zip.py DIRECTORY ARCHIVE"""
import os
import sys
import time
import zipfile
from pathlib import Path

directory, archive = Path(sys.argv[1]), sys.argv[2]
when = time.gmtime(int(os.environ["SOURCE_DATE_EPOCH"]))[:6]
with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as out:
    for path in sorted(path for path in directory.rglob("*") if path.is_file()):
        entry = zipfile.ZipInfo((directory.name / path.relative_to(directory)).as_posix(), when)
        entry.compress_type = zipfile.ZIP_DEFLATED
        entry.external_attr = 0o644 << 16
        out.writestr(entry, path.read_bytes())
