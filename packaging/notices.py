"""What the program is made of, from `cargo metadata`: notices.py TARGET NOTICES SBOM [CRATE]

NOTICES has the name, version, licence and licence texts of every crate that is linked in, SBOM the same as CycloneDX 1.5 without texts.
A crate without any text ends the script: a package must not be made without the notices that its licences ask for.
"""
import json
import subprocess
import sys
from pathlib import Path

metadata = json.loads(subprocess.check_output(["cargo", "metadata", "--format-version", "1", "--locked", "--filter-platform", sys.argv[1]]))
nodes = {node["id"]: node for node in metadata["resolve"]["nodes"]}
packages = {package["id"]: package for package in metadata["packages"]}
root = next(package["id"] for package in metadata["packages"] if package["name"] == (sys.argv[4:] or ["pathbuild"])[0])

linked, open_ = set(), [root]
while open_:
    at = open_.pop()
    if at in linked:
        continue
    linked.add(at)
    for dependency in nodes[at]["deps"]:
        if any(kind["kind"] is None for kind in dependency["dep_kinds"]):
            open_.append(dependency["pkg"])

ours = {package for package in metadata["workspace_members"]}
parts = sorted((packages[part] for part in linked if part not in ours), key=lambda part: (part["name"], part["version"]))

# Texts that a crate leaves out of its package although its licence wants them are those of the licence itself.
TEXTS = {"MIT": "LICENSE-MIT", "Apache-2.0": "LICENSE-APACHE"}
lines, without = [], []
for part in parts:
    directory = Path(part["manifest_path"]).parent
    texts = sorted(path for path in directory.iterdir() if path.name.upper().startswith(("LICENSE", "LICENCE", "COPYING", "NOTICE", "COPYRIGHT")) and path.is_file())
    lines += ["=" * 78, f"{part['name']} {part['version']}", f"Licence: {part['license']}", f"Authors: {', '.join(part['authors']) or 'see ' + str(part['repository'])}", ""]
    if texts:
        lines += [text for path in texts for text in [path.read_text(errors="replace").strip(), ""]]
        continue
    known = [name for name in TEXTS if name in (part["license"] or "")]
    if not known:
        without.append(f"{part['name']} {part['version']}: {part['license']}")
    lines += [f"The text of {name} is in {TEXTS[name]}." for name in known] + [""]
if without:
    sys.exit("no licence text:\n" + "\n".join(without))
Path(sys.argv[2]).write_text("\n".join(lines))

components = [
    {
        "type": "library",
        "name": part["name"],
        "version": part["version"],
        "purl": f"pkg:cargo/{part['name']}@{part['version']}",
        "licenses": [{"expression": part["license"].replace("/", " OR ")}],
    }
    for part in parts
]
sbom = {
    "bomFormat": "CycloneDX",
    "specVersion": "1.5",
    "version": 1,
    "metadata": {"component": {"type": "application", "name": "pathbuild", "version": packages[root]["version"]}},
    "components": components,
}
Path(sys.argv[3]).write_text(json.dumps(sbom, indent=1) + "\n")
