#!/bin/sh
# Installs what is missing from Debian's packages, builds the release preset with its tests and runs them; with --dev the
# preset dev, in which warnings are errors. The last line says "N passed, N failed"; tests that had to leave something
# out for want of a program follow as "N skipped". The exit status is that of ctest.
set -u
script=tests/run.sh
CDPATH= cd -- "$(dirname -- "$0")/.." || exit 1
. ./studies/setup.sh

case $* in
  "") preset=release ;;
  --dev) preset=dev ;;
  *) fail "takes --dev or nothing" ;;
esac
install_packages $packages $test_packages
build "$preset" all

report=$PWD/build/$preset/tests.xml
rm -f "$report"
temporary_files_in_memory
# One more than there are cores: some tests wait for clocks and other programs.
follow tests "build/$preset-tests.log" ctest --preset "$preset" --parallel "$(($(nproc) + 1))" --no-tests=error \
  --output-junit "$report" --test-output-size-passed 100000
status=$?

# Such a test says so in a warning of Catch2's.
left_out=$(awk -F '"' '
  /<testcase /{name = $2; passed = /status="run"/; said = 0}
  /warning:$/ && passed {getline; printf "%s%s", said++ ? "," : "\nnot tried in \"" name "\":", $0}' "$report" | grep .)
[ -z "$left_out" ] || say "$left_out"
skipped=$(say "$left_out" | grep -c .)
count() { sed -n "s/^[[:space:]]*$1=\"\([0-9]*\)\".*/\1/p" "$report" | head -n 1; }
total=$(count tests) failed=$(count failures)
say "$((${total:-0} - ${failed:-0} - skipped)) passed, ${failed:-0} failed$([ "$skipped" -eq 0 ] || say ", $skipped skipped")"
exit $status
