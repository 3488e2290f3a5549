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
cp -r "$root/fixtures/library" "$repository/other"
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
  rm -f "$place/summary.md" "$place/output"
  : > "$place/output"
  DIRECTORY=${directory:-library} INSTALL=${install-} GITHUB_OUTPUT="$place/output" URL="https://example.invalid/artifact" BASE="$base" SARIF="$repository/pathbuild.sarif" RUNNER_TEMP="$place/temp" GITHUB_STEP_SUMMARY="$place/summary.md" \
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
git checkout -q main
hook 0 > /dev/null 2>&1 || fail "the hook finds an error in a sound library"
git checkout -q change -- library/components/2050.1P.dxf
if hook 0 > /dev/null 2>&1; then fail "the hook passes a component that is broken"; fi
git reset -q --hard main

# A pull request that mills less deep.
git checkout -qb higher
sed -i 's/B-0.2/B-0.1/' library/components/2050.1P.dxf
git commit -qam "Raise the bottom"
github Moves > /dev/null 2> "$place/log" || fail "the comparison ended with an error: $(cat "$place/log")"
grep -q '^| ` 8001.1P ` | ` projects/8001.1P.dxf ` | 0.1 mm higher' "$place/summary.md" || fail "no comparison: $(cat "$place/summary.md")"
page() { sed -n 's/^page=//p' "$place/output"; }
grep -q '<html' "$(page)" || fail "no pictures"
github "Link to the pictures"
grep -q '^\[Pictures of the changes\](https://example.invalid/artifact)' "$place/summary.md" || fail "no link to the pictures"
# The action once more in the same job, for a directory in which nothing changed: it must not upload what the first use made.
directory=other github Moves > /dev/null 2> "$place/log" || fail "the second use ended with an error: $(cat "$place/log")"
[ -z "$(page)" ] || fail "the second use has pictures: $(page)"
directory=other github Check > /dev/null 2> "$place/log" || fail "the second use finds errors: $(cat "$place/log")"
git checkout -q main

# The installation must obey no file of the checkout: rustup would run any program as cargo.
mkdir -p "$place/toolchain/bin"
printf '#!/bin/sh\ntouch "%s"\n' "$place/obeyed" > "$place/toolchain/bin/cargo"
chmod +x "$place/toolchain/bin/cargo"
cp "$place/toolchain/bin/cargo" "$place/toolchain/bin/rustc"
printf '[toolchain]\npath = "%s"\n' "$place/toolchain" > rust-toolchain.toml
install="pwd > '$place/where'; cargo --version > '$place/version'" github Install > /dev/null 2> "$place/log" || fail "Install ended with an error: $(cat "$place/log")"
case $(cat "$place/where") in "$repository"*) fail "Install runs in the checkout" ;; esac
[ ! -f "$place/obeyed" ] || fail "Install obeys the checkout's rust-toolchain.toml"
if install='false; true' github Install > /dev/null 2>&1; then fail "an installation that fails is passed over"; fi
rm rust-toolchain.toml

# Programs of any origin.
mkdir programs programs/b
printf '%s\n' '(T1 D=6 CR=0 - ZMIN=-2 - flat end mill)' G21 G90 G94 G17 'T1 M6' 'S12000 M3' 'G0 Z15' 'G0 X0 Y0' 'G1 Z-2 F200' 'G1 X40 F600' 'G0 Z15' M5 M30 > programs/sound.nc
grep -v S12000 programs/sound.nc > "programs/b/spindle off.nc"
directory=programs VERIFY='*.nc' REQUIRE='' github Verify > "$place/annotations" 2> "$place/log" || fail "a sound program is refused: $(cat "$place/log")"
if directory=programs VERIFY='**/*.nc' REQUIRE='' github Verify > "$place/annotations" 2> "$place/log"; then fail "a program with the spindle off passes"; fi
grep -q '^::error file=programs/b/spindle off.nc,' "$place/annotations" || fail "no annotation: $(cat "$place/annotations")"
if directory=programs VERIFY='*.nc' REQUIRE=envelope github Verify > /dev/null 2>&1; then fail "an unmade check passes"; fi
if directory=programs VERIFY='*.tap' REQUIRE='' github Verify > /dev/null 2>&1; then fail "no program at all passes"; fi
program_hook() { eval "$(step "$root/.pre-commit-hooks.yaml" 2 entry) \"\$1\""; }
program_hook programs/sound.nc > /dev/null 2>&1 || fail "the hook refuses a sound program"
if program_hook "programs/b/spindle off.nc" > /dev/null 2>&1; then fail "the hook passes a program with the spindle off"; fi
rm -r programs

# A pull request that breaks nothing.
git checkout -qb harmless
echo "A note." > library/NOTES.txt
git add -A
git commit -qm "Add a note"
github Check > "$place/annotations" 2> "$place/log" || fail "a harmless change is refused: $(cat "$place/log")"
[ ! -s "$place/annotations" ] || fail "annotations of a harmless change"
github Moves > /dev/null 2> "$place/log" || fail "the comparison ended with an error: $(cat "$place/log")"
grep -q '0 of [0-9]* paths changed' "$place/summary.md" || fail "no comparison of a harmless change: $(cat "$place/summary.md")"
[ -z "$(page)" ] || fail "pictures of nothing"
base=0000000000000000000000000000000000000000 github Moves > /dev/null 2>&1 || fail "an unknown base ends the comparison with an error"
gitlab 2> "$place/log" || fail "the template refuses a harmless change: $(cat "$place/log")"

# Programs: missing, written, changed by hand.
if github Programs > "$place/out" 2>&1; then fail "programs that are missing are current"; fi
(cd library && pathbuild emit -q > /dev/null)
github Programs > "$place/out" 2>&1 || fail "programs just written are not current: $(cat "$place/out")"
hook 1 > /dev/null 2>&1 || fail "the hook finds current programs not current"
sed -i 's/X40.000/X41.000/' library/gcode/8001.1P_Milling.gcode
if hook 1 > /dev/null 2>&1; then fail "a program changed by hand is current"; fi

# The real pre-commit: before the first commit, over a broken commit, and where the library is a directory of the repository.
if ! command -v pre-commit > /dev/null; then
  echo "ci-steps: pre-commit is missing: its hooks were run without it"
  echo "ci-steps: all other steps did what they should"
  exit
fi
export PRE_COMMIT_HOME="$place/pre-commit" GIT_CONFIG_COUNT=1 GIT_CONFIG_KEY_0=safe.directory GIT_CONFIG_VALUE_0='*'
hooks="$place/hooks"
mkdir "$hooks"
cp "$root/.pre-commit-hooks.yaml" "$hooks"
git -C "$hooks" init -q -b main
git -C "$hooks" add -A
git -C "$hooks" commit -qm "Hooks"
configured() { # the configuration of a repository whose library is in a directory
  printf 'repos:\n- repo: file://%s\n  rev: %s\n  hooks:\n  - id: pathbuild-check\n' "$hooks" "$(git -C "$hooks" rev-parse HEAD)"
  [ "$1" = . ] || printf '    args: [--config, %s/pathbuild.toml]\n' "$1"
}
for directory in . library; do
  rm -rf "$place/new"
  mkdir "$place/new"
  cd "$place/new"
  git init -q -b main
  mkdir -p "$directory"
  cp -r "$root/fixtures/library/." "$directory"
  chmod -R u+w .
  configured "$directory" > .pre-commit-config.yaml
  git add -A
  pre-commit run > "$place/log" 2>&1 || fail "the hook refuses the first commit ($directory): $(cat "$place/log")"
  grep -q 'pathbuild check.*Passed' "$place/log" || fail "the hook was not run ($directory): $(cat "$place/log")"
  git commit -qnm "The library"
  sed -i 's/\bO2\b/O0/' "$directory/components/2050.1P.dxf"
  git add -A
  if pre-commit run > "$place/log" 2>&1; then fail "the hook passes a broken component ($directory)"; fi
  grep -q '2050.1P.dxf:.*error\[PB' "$place/log" || fail "the hook shows no finding ($directory): $(cat "$place/log")"
  git commit -qnm "Break a component"
  if pre-commit run --all-files > "$place/log" 2>&1; then fail "--all-files passes a broken commit ($directory)"; fi
  if pre-commit run --from-ref HEAD~1 --to-ref HEAD > "$place/log" 2>&1; then fail "--from-ref passes a broken commit ($directory)"; fi
  git revert --no-edit HEAD > /dev/null
  pre-commit run --all-files > "$place/log" 2>&1 || fail "the hook refuses what is mended ($directory): $(cat "$place/log")"
done
echo "ci-steps: all steps did what they should"
