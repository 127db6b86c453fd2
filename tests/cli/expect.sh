# SPDX-License-Identifier: Apache-2.0
# For tests of the command line, to be sourced: a folder of their own to work in, and checks that go on after a failure.
# A test ends with `report`.
set -uo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

# expect CODE TITLE COMMAND...: runs it; standard output and error are left in out.txt and err.txt
expect() {
  local code=$1 title=$2 got
  shift 2
  "$@" > out.txt 2> err.txt
  got=$?
  if (( got == code )); then
    echo "ok    $title"
  else
    echo "FAIL  $title: exit code $got, not $code"
    cat err.txt out.txt
    failures=$(( failures + 1 ))
  fi
}

# holds TITLE COMMAND...
holds() {
  local title=$1
  shift
  if "$@" > /dev/null; then echo "ok    $title"; else echo "FAIL  $title"; failures=$(( failures + 1 )); fi
}

report() { (( failures == 0 )) || { echo "$failures failed"; exit 1; }; }
