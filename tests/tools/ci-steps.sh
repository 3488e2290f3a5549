#!/usr/bin/env bash
# Runs what action.yml, templates/pathbuild.gitlab-ci.yml and .pre-commit-hooks.yaml say over a copy of fixtures/library as a Git repository:
# a pull request that breaks a component, and one that breaks nothing. What GitHub and GitLab do around the steps is not tried.
#   tests/tools/ci-steps.sh PATHBUILD
set -euo pipefail
pathbuild=$(realpath "$1")
root=$(cd "$(dirname "$0")/../.." && pwd)
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
mkdir "$place/bin" "$place/temp"
ln -s "$pathbuild" "$place/bin/pathbuild"
export PATH="$place/bin:$PATH" XDG_CACHE_HOME="$place/caches" XDG_CONFIG_HOME="$place/configurations"
export GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@example.com GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@example.com

# The command lines of a step, by its place in the file.
step() { python3 -c '
import sys, yaml
at = yaml.safe_load(open(sys.argv[1]))
for key in sys.argv[2:]:
    at = at[int(key) if key.isdigit() else key]
print(at)' "$@"; }
fail() { echo "ci-steps: $*" >&2; exit 1; }

repository="$place/repository"
mkdir "$repository"
cp -r "$root/fixtures/library" "$repository/library"
cd "$repository"
git init -q -b main
git add -A
git commit -qm "The library"
base=$(git rev-parse HEAD)

# A pull request: B above T in a component that projects embed.
git checkout -qb change
python3 - <<'P'
import re
p = "library/components/2050.1P.dxf"
s = open(p, encoding="latin-1", newline="").read()
t = re.sub(r"\bO2\b", "O0", s)
assert s != t, "the component says no O2"
open(p, "w", encoding="latin-1", newline="").write(t)
P
git commit -qam "Break a component"

github() { # a step of the action by its name, as GitHub runs it
  python3 -c '
import sys, yaml
steps = yaml.safe_load(open(sys.argv[1]))["runs"]["steps"]
print(next(step["run"] for step in steps if step["name"] == sys.argv[2]))' "$root/action.yml" "$1" > "$place/step.sh"
  rm -f "$place/summary.md"
  DIRECTORY=library URL="https://example.invalid/artifact" BASE="$base" SARIF="$repository/pathbuild.sarif" RUNNER_TEMP="$place/temp" GITHUB_STEP_SUMMARY="$place/summary.md" \
    PATHBUILD_CACHE_DIR="$place/cache" bash --noprofile --norc -eo pipefail "$place/step.sh"
}
status=0; github Check > "$place/annotations" 2> "$place/log" || status=$?
[ "$status" = 1 ] || fail "the action ended with $status: $(cat "$place/log")"
grep -q '^::error file=library/components/2050.1P.dxf,' "$place/annotations" || fail "no annotation: $(cat "$place/annotations")"
grep -q 'error' "$place/summary.md" || fail "no summary"
python3 -c 'import json, sys; assert json.load(open(sys.argv[1]))["runs"][0]["results"]' "$repository/pathbuild.sarif"

github Moves > /dev/null 2> "$place/log" || fail "a path with errors ends the comparison: $(cat "$place/log")"
grep -q '^| ` 2050.1P ` | ` components/2050.1P.dxf ` | has errors now' "$place/summary.md" || fail "no comparison: $(cat "$place/summary.md")"

gitlab() {
  step "$root/templates/pathbuild.gitlab-ci.yml" pathbuild script 0 > "$place/step.sh"
  PATHBUILD_DIRECTORY=library CI_PROJECT_DIR="$repository" CI_MERGE_REQUEST_DIFF_BASE_SHA="$base" PATHBUILD_CACHE_DIR="$place/cache" bash -eo pipefail "$place/step.sh"
}
status=0; gitlab 2> "$place/log" || status=$?
[ "$status" = 1 ] || fail "the template ended with $status: $(cat "$place/log")"
python3 -c 'import json, sys; assert any(i["location"]["path"] == "library/components/2050.1P.dxf" for i in json.load(open(sys.argv[1])))' "$repository/gl-code-quality-report.json"
python3 -c 'import sys, xml.etree.ElementTree as x; assert x.parse(sys.argv[1]).getroot().findall(".//failure")' "$repository/junit.xml"

hook() { (cd library && eval "$(step "$root/.pre-commit-hooks.yaml" "$1" entry)"); }
hook 0 > /dev/null 2>&1 || fail "the hook finds an error though nothing changed since the last commit"
git checkout -q main
git checkout -q change -- library/components/2050.1P.dxf
if hook 0 > /dev/null 2>&1; then fail "the hook passes a component that is broken"; fi
git reset -q --hard main

# A pull request that mills less deep.
git checkout -qb higher
sed -i 's/B-0.2/B-0.1/' library/components/2050.1P.dxf
git commit -qam "Raise the bottom"
github Moves > /dev/null 2> "$place/log" || fail "the comparison ended with an error: $(cat "$place/log")"
grep -q '^| ` 8001.1P ` | ` projects/8001.1P.dxf ` | 0.1 mm higher' "$place/summary.md" || fail "no comparison: $(cat "$place/summary.md")"
grep -q '<html' "$place/temp/pathbuild-moves.html" || fail "no pictures"
github "Link to the pictures"
grep -q '^\[Pictures of the changes\](https://example.invalid/artifact)' "$place/summary.md" || fail "no link to the pictures"
rm "$place/temp/pathbuild-moves.html"
git checkout -q main

# A pull request that breaks nothing.
git checkout -qb harmless
echo "A note." > library/NOTES.txt
git add -A
git commit -qm "Add a note"
github Check > "$place/annotations" 2> "$place/log" || fail "a harmless change is refused: $(cat "$place/log")"
[ ! -s "$place/annotations" ] || fail "annotations of a harmless change"
github Moves > /dev/null 2> "$place/log" || fail "the comparison ended with an error: $(cat "$place/log")"
grep -q '0 of [0-9]* paths changed' "$place/summary.md" || fail "no comparison of a harmless change: $(cat "$place/summary.md")"
[ ! -f "$place/temp/pathbuild-moves.html" ] || fail "pictures of nothing"
base=0000000000000000000000000000000000000000 github Moves > /dev/null 2>&1 || fail "an unknown base ends the comparison with an error"
gitlab 2> "$place/log" || fail "the template refuses a harmless change: $(cat "$place/log")"

# Programs: missing, written, changed by hand.
if github Programs > "$place/out" 2>&1; then fail "programs that are missing are current"; fi
(cd library && pathbuild emit -q > /dev/null)
github Programs > "$place/out" 2>&1 || fail "programs just written are not current: $(cat "$place/out")"
hook 1 > /dev/null 2>&1 || fail "the hook finds current programs not current"
sed -i 's/X40.000/X41.000/' library/gcode/8001.1P_Milling.gcode
if hook 1 > /dev/null 2>&1; then fail "a program changed by hand is current"; fi
echo "ci-steps: all steps did what they should"
