#!/bin/sh
# Installs what is missing from Debian's packages, builds the release preset with its tests and runs them.
# The last line says "N passed, N failed"; the exit status is that of ctest.
set -u
CDPATH= cd -- "$(dirname -- "$0")/.." || exit 1
. ./studies/setup.sh

install_packages $packages $test_packages
build_release all

report=$PWD/build/release/tests.xml
rm -f "$report"
ctest --preset release --parallel "$(nproc)" --no-tests=error --output-junit "$report"
status=$?

count() { sed -n "s/^[[:space:]]*$1=\"\([0-9]*\)\".*/\1/p" "$report" 2>/dev/null | head -n 1; }
total=$(count tests) failed=$(count failures) disabled=$(count disabled) skipped=$(count skipped)
say "$((${total:-0} - ${failed:-0} - ${disabled:-0} - ${skipped:-0})) passed, ${failed:-0} failed"
exit $status
