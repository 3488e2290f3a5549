#!/usr/bin/env bash
# The tests of the program and of what asks the operating system, built for Windows and run under Wine, all by one wineserver.
#   tests/tools/windows.sh [TEST FILTERS]
# Of some hundred processes Wine 8 loses one, more where the machine is busy: it prints "wine client error: sendmsg: Bad file
# descriptor", and the process is not started (error 1359) or ends with 1 or -9 after everything was written. Threads are at fault
# that are made while a process ends. Started one after the other by a shell none of 450 was lost. So tests run two at a time,
# and the recorded runs compare again what differs.
set -euo pipefail
cd "$(dirname "$0")/../.."
. tests/tools/wine.sh "$PWD/target/wine"
trap 'wineserver -k' EXIT
export CARGO_TARGET_X86_64_PC_WINDOWS_GNU_RUNNER=wine INSTA_WORKSPACE_ROOT=$PWD INSTA_UPDATE=no RUST_BACKTRACE=0
# Wine has neither git nor cargo. Random libraries, kills, the book and a rule's messages ask nothing of Windows that others do not, and take
# long or so many processes that Wine loses one.
skipped=(since:: diff::revisions german::refusals_of_git dependencies:: agreement:: kills:: book:: machines:: conformance::no_recorded_run)
run() {
  cargo test --quiet --no-fail-fast --target x86_64-pc-windows-gnu "${packages[@]}" "${targets[@]}" -- "${skipped[@]/#/--skip=}" "$@" </dev/null
}
packages=(--package pathbuild --package pathbuild-files)
if [ $# -gt 0 ]; then
  # Of the files everything, of the program what is named.
  targets=(--test os_system --test other_systems)
  run
  targets=(--test cli)
else
  packages+=(--package pathbuild-db --package pathbuild-cache --package pathbuild-workspace)
  targets=(--tests)
fi
said=$(mktemp)
if run --test-threads 2 "$@" 2>&1 | tee "$said"; then exit; fi
# What failed is tried again alone, and must pass then. More than a few failures are no loss of Wine's.
mapfile -t failed < <(sed -n '/^failures:$/,/^test result/s/^    \([a-z_:0-9]*\)$/\1/p' "$said" | sort -u)
if [ ${#failed[@]} -eq 0 ] || [ ${#failed[@]} -gt 5 ]; then exit 1; fi
echo "again, one by one: ${failed[*]}"
run --test-threads 1 --exact "${failed[@]}"
