#!/bin/sh
# The suite under address and undefined-behaviour sanitizers, then what runs on several threads under the thread sanitizer:
# their tests, spheres, a fit, a gradient and a sweep with 8 jobs. Asserts of libstdc++, Eigen and rollres are on. Slow
# tests have a tenth of their random input, those of tests/fuzz a quarter (ROLLRES_THIN). The tests are those that the
# release preset has compiled, run with libraries that are compiled anew; under the thread sanitizer the chapters of studies
# that start no threads are the release's, too. Left out are tests tagged [long], whose code
# shorter tests run as well, and tests that run none of these libraries: of the Python package, of an outside program on
# the installed library, of the Debian package. What is read or written by a pointer that is null or points beyond
# an object ends the program under the address sanitizer, too: the checks of pointers that the undefined-behaviour
# sanitizer has besides, half of the compiler's time, are off. Needs what tests/run.sh has installed and built. The last
# line says what was found; the exit status is 0 if nothing was.
set -u
script=tests/sanitizers.sh
cd "$(dirname "$0")/.." || exit 1
. ./studies/setup.sh
temporary_files_in_memory
trouble=

# Builds a preset's program and tests, and shows the compiler's words if that fails.
build_sanitized() {
  log=build/$1.log
  { cmake --preset "$1" && ninja -C "build/$1" rollres rollres_tests ${2-}; } >"$log" 2>&1 || {
    grep -E -A 5 'error:|Error|FAILED' "$log" | head -n 60
    trouble="$trouble $1 was not built;"
    return 1
  }
  grep ': warning: ' "$log"
  return 0
}

began=$(date +%s)
say_time() { printf 'sanitizers: %s after %s s\n' "$1" $(($(date +%s) - began)); }

# Debian's ThreadSanitizer wants addresses that are not spread as widely as newer kernels do.
plain_addresses=
! setarch -R true 2>/dev/null || plain_addresses="setarch -R"

export ROLLRES_THIN=1 UBSAN_OPTIONS=print_stacktrace=1
export ASAN_OPTIONS=detect_stack_use_after_return=0:allocator_may_return_null=0:detect_leaks=0
export TSAN_OPTIONS="exitcode=66:suppressions='$PWD/tests/tsan.txt'"

# Prints what a run said that matters.
reports='ERROR: AddressSanitizer\|runtime error\|Assertion .* failed'
show() { sed -n "/$reports\|tests passed\|FAILED:\$/p;/The following tests FAILED/,\$p" "$@"; }

# The tests of Catch2 in processes of some thirty tests each, as a process takes half a second to start with the address
# sanitizer. Of a process that fails, each test runs once more, alone: what fails then is shown, and the status is 1. With a
# report in the first run it is 1, too.
suite() {
  tests=$PWD/build/asan/tests/rollres_tests parts=build/asan/parts
  rm -rf "$parts" && mkdir "$parts"
  "$tests" --list-test-names-only "~[python]~[long]" >"$parts/names"
  [ -s "$parts/names" ] || return
  split --number=r/$(($(wc -l <"$parts/names") / 30 + 1)) "$parts/names" "$parts/part."
  run='timeout 1800 "$0" --input-file "$1" >"$1.log" 2>&1 || mv "$1" "$1.failed"'
  ls "$parts"/part.* | xargs -n 1 -P "$(nproc)" sh -c "$run" "$tests"
  printf '%s tests in %s processes\n' "$(wc -l <"$parts/names")" "$(ls "$parts"/*.log | wc -l)"
  ended=0
  for part in "$parts"/*.failed; do
    [ -e "$part" ] || continue
    ! grep -q "$reports" "${part%.failed}.log" || ended=1
    show "${part%.failed}.log"
    while read -r name; do
      printf '%s\n' "$name" >"$parts/alone"
      timeout 1800 "$tests" --input-file "$parts/alone" >"$parts/alone.log" 2>&1 </dev/null && continue
      printf 'failed: %s\n' "$name"
      show "$parts/alone.log"
      ended=1
    done <"$part"
  done
  return $ended
}

if build_sanitized asan rollres_fuzz; then
  say_time "address and undefined behaviour built"
  suite || trouble="$trouble the suite fails under address and undefined-behaviour sanitizers;"
  ctest --test-dir build/asan --parallel "$(nproc)" --no-tests=error --timeout 1800 --output-on-failure \
    >build/asan-tests.log 2>&1 || trouble="$trouble random input fails under address and undefined-behaviour sanitizers;"
  show build/asan-tests.log
  say_time "suite run"
fi

# A command of the program under the thread sanitizer; that a scene has no answer is none of its reports.
threads() {
  printf 'rollres %s\n' "$*"
  $plain_addresses build/tsan/rollres "$@" >"$folder/out" 2>"$folder/err"
  ended=$?
  [ $ended -le 1 ] && return
  cat "$folder/err"
  trouble="$trouble rollres $1 ends with $ended under the thread sanitizer;"
}
if build_sanitized tsan; then
  say_time "threads built"
  folder=$(mktemp -d) || exit 1
  trap 'rm -rf "$folder"' EXIT
  # Beside the commands, as they seldom use all cores.
  (
    ended=0
    for tests in "[parallel]" "~[python]~[limits]*threads*" "*thread that*"; do
      $plain_addresses build/tsan/tests/rollres_tests "$tests" >"$folder/test" 2>&1 && tail -n 2 "$folder/test" || {
        cat "$folder/test"
        ended=1
      }
    done
    exit $ended
  ) >"$folder/tests" &
  cat >"$folder/study.json" <<'STUDY'
{"study": "threads", "scene": {"indenter": "cylinder", "radius": 0.02, "layer_thickness": 0.005, "static_shear_modulus": 3e6,
  "stiffening": 1, "creep_time": 0.25, "speed": 0.05, "load": 100, "friction_coefficient": 0.2},
 "axes": {"indenter": ["cylinder", "sphere"], "method": ["automatic", "newton"],
  "speed": {"from": 0.01, "to": 1, "points": 3, "spacing": "logarithmic"}, "poisson_ratio": [0.5, 0.3]}}
STUDY
  # The example's fit of one parameter: threads share the rows of an evaluation, however many evaluations there are.
  sed "/shear_modulus\|stiffening/d; s#paper_cylinder.json\|fit_cylinder.csv#$PWD/studies/examples/&#" \
    studies/examples/fit_cylinder.json >"$folder/fit.json"
  threads sweep "$folder/study.json" --db "$folder/a.db" --jobs 8
  threads report --db "$folder/a.db" --out "$folder/a.html"
  threads solve studies/examples/paper_sphere.json --set "spacing=0.08 mm"
  threads fit "$folder/fit.json" --db "$folder/f.db" --jobs 8
  threads gradient studies/examples/paper_cylinder.json --inputs speed,layer_thickness --jobs 8
  wait $! || trouble="$trouble tests of threads fail under the thread sanitizer;"
  cat "$folder/tests"
  say_time "threads run"
fi

[ -n "$trouble" ] && echo "SANITIZERS FOUND:$trouble see above, build/asan/parts and build/asan-tests.log" && exit 1
echo "sanitizers: nothing found"
