"""Makes unpacked crates of a directory find each other as if a registry had them: registry.py DIRECTORY VERSION

Each crate and what it asks of the others gets VERSION, so that two releases can be made from one set of packages.
"""
import re
import sys
from pathlib import Path

directory, version = Path(sys.argv[1]), sys.argv[2]
names = []
for crate in sorted(directory.iterdir()):
    name = re.sub(r"-[0-9.]+$", "", crate.name)
    crate = crate.rename(directory / name)
    manifest = crate / "Cargo.toml"
    text = manifest.read_text()
    text = re.sub(r'^version = "[0-9.]+"$', f'version = "{version}"', text, count=1, flags=re.M)
    text = re.sub(r'^(\[(?:dev-)?dependencies\.pathbuild-[a-z]+\]\nversion = ")=[0-9.]+"', rf'\g<1>={version}"', text, flags=re.M)
    manifest.write_text(text)
    (crate / "Cargo.lock").unlink(missing_ok=True)
    names.append(name)
patches = "\n".join(f'{name} = {{ path = "{name}" }}' for name in names)
members = ", ".join(f'"{name}"' for name in names)
(directory / "Cargo.toml").write_text(f'[workspace]\nresolver = "3"\nmembers = [{members}]\n\n[patch.crates-io]\n{patches}\n')
