#!/usr/bin/env bash
# Builds the tests of the program and of everything that depends on the operating system for Windows, and runs them under Wine with one wineserver.
#   tests/tools/windows.sh [TEST FILTERS]
# Wine 8 loses about one process in a hundred, and more on a busy machine: it prints "wine client error: sendmsg: Bad file
# descriptor", and the process is not started (error 1359) or ends with 1 or -9 after everything was written. The cause is threads
# that are created while a process ends. Of 450 processes started one by one from a shell, none was lost. Therefore tests run two at a time,
# and the recorded runs repeat comparisons that differ.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/tools/wine.sh "$PWD/target/wine"
trap 'wineserver -k' EXIT
export CARGO_TARGET_X86_64_PC_WINDOWS_GNU_RUNNER=wine INSTA_WORKSPACE_ROOT=$PWD INSTA_UPDATE=no RUST_BACKTRACE=0
# Wine has neither git nor cargo. Random libraries, kills, the book and the messages of a rule test nothing more of Windows than others do, and take
# long, or start so many processes that Wine loses one.
skipped=(since:: diff::revisions german::refusals_of_git dependencies:: agreement:: kills:: book:: machines:: conformance::no_recorded_run)
run() {
  cargo test --quiet --no-fail-fast --target x86_64-pc-windows-gnu "${packages[@]}" "${targets[@]}" -- "${skipped[@]/#/--skip=}" "$@" </dev/null
}
packages=(--package pathbuild --package pathbuild-files)
if [ $# -gt 0 ]; then
  # All tests of pathbuild-files, and the named tests of the program.
  targets=(--test os_system --test other_systems)
  run
  targets=(--test cli)
else
  packages+=(--package pathbuild-db --package pathbuild-cache --package pathbuild-workspace)
  targets=(--tests)
fi
said=$(mktemp)
if run --test-threads 2 "$@" 2>&1 | tee "$said"; then exit; fi
# Failed tests are repeated alone and must then pass. More than a few failures are not caused by Wine.
mapfile -t failed < <(sed -n '/^failures:$/,/^test result/s/^    \([a-z_:0-9]*\)$/\1/p' "$said" | sort -u)
if [ ${#failed[@]} -eq 0 ] || [ ${#failed[@]} -gt 5 ]; then exit 1; fi
echo "again, one by one: ${failed[*]}"
run --test-threads 1 --exact "${failed[@]}"
