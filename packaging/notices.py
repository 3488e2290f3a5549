"""Lists the crates that are linked into a program: notices.py TARGET NOTICES SBOM [CRATE]

NOTICES has the name, version, licence and authors of every crate, and each licence text once. SBOM is the same as CycloneDX 1.5 without texts.
A crate without any text ends the script: a package must not be made without the notices that its licences ask for.
"""
import json
import subprocess
import sys
from pathlib import Path

target, notices, bill = sys.argv[1:4]
crate = (sys.argv[4:] or ["pathbuild"])[0]

# cargo tree lists the linked crates, without procedural macros, build scripts, and crates that only other workspace members need.
tree = ["cargo", "tree", "--locked", "--package", crate, "--target", target, "--edges", "normal,no-proc-macro", "--prefix", "none", "--format", "{p}"]
linked = {tuple(line.split()[:2]) for line in subprocess.check_output(tree, text=True).splitlines() if line}
metadata = json.loads(subprocess.check_output(["cargo", "metadata", "--format-version", "1", "--locked", "--filter-platform", target]))
ours = set(metadata["workspace_members"])
packages = [package for package in metadata["packages"] if (package["name"], "v" + package["version"]) in linked]
root = next(package for package in packages if package["name"] == crate)
parts = sorted((package for package in packages if package["id"] not in ours), key=lambda part: (part["name"], part["version"]))

# Some crates lack a text that their licence requires; the text of the licence itself is used instead.
TEXTS = {"MIT": "LICENSE-MIT", "Apache-2.0": "LICENSE-APACHE"}
NAMES = ("LICENSE", "LICENCE", "COPYING", "NOTICE", "COPYRIGHT")
texts, rows, without = {}, [], []
for part in parts:
    directory = Path(part["manifest_path"]).parent
    files = sorted(path for path in directory.iterdir() if path.name.upper().startswith(NAMES) and path.is_file())
    own = [path.read_text(errors="replace").strip().replace("\r\n", "\n") for path in files]
    numbers = [f"text {texts.setdefault(text, len(texts) + 1)}" for text in own]
    if not own:
        numbers = [TEXTS[name] for name in TEXTS if name in (part["license"] or "")]
    if not numbers:
        without.append(f"{part['name']} {part['version']}: {part['license']}")
    authors = ", ".join(part["authors"]) or f"see {part['repository']}"
    rows += [f"{part['name']} {part['version']}", f"  {part['license']}: {', '.join(numbers)}", f"  {authors}", ""]
if without:
    sys.exit("no licence text:\n" + "\n".join(without))
head = ["This program contains the crates below. The licence texts that they name follow the list; LICENSE-MIT and LICENSE-APACHE lie beside this file.", ""]
blocks = [f"{'=' * 78}\ntext {number}\n\n{text}\n" for text, number in texts.items()]
Path(notices).write_text("\n".join(head + rows + blocks))

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
    "metadata": {"component": {"type": "application", "name": "pathbuild", "version": root["version"]}},
    "components": components,
}
Path(bill).write_text(json.dumps(sbom, indent=1) + "\n")
