#!/bin/sh
# Lets only those G-code programs through in which `pathbuild verify` finds no error: gate.sh PROGRAM...
# A program is renamed to PROGRAM.rejected before it is checked, so that it cannot be run meanwhile, and gets its name back if it passes.
# Otherwise the findings are in PROGRAM.rejected.txt, and the exit status is 1; so they are if pathbuild is missing.
# PATHBUILD_GATE has options of `verify`: PATHBUILD_GATE="--surface 0 --require rapids=assumed"
if [ "$#" -eq 0 ]; then
  echo "gate: no program was named" >&2
  exit 2
fi
status=0
for program in "$@"; do
  held=$program.rejected
  if [ -d "$program" ]; then
    echo "gate: $program is a directory" >&2
    status=1
    continue
  fi
  if ! mv -f -- "$program" "$held"; then
    status=1
    continue
  fi
  # Several options are several words.
  # shellcheck disable=SC2086
  if pathbuild verify $PATHBUILD_GATE -- "$held" >"$held.txt" 2>&1 && mv -f -- "$held" "$program"; then
    rm -f -- "$held.txt"
  else
    cat -- "$held.txt" >&2
    echo "gate: $program is now $held" >&2
    status=1
  fi
done
exit "$status"
