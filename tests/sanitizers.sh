#!/bin/sh
# The suite under address and undefined-behaviour sanitizers, then what runs on several threads under the thread sanitizer:
# their tests, spheres, a fit, a gradient and a sweep with 8 jobs. Asserts of libstdc++, Eigen and rollres are on. Slow
# tests have a tenth of their random input (ROLLRES_THIN). The tests are those that the release preset has compiled, run
# with libraries that are compiled anew. Left out are tests tagged [long], whose code shorter tests run as well, and tests
# that run none of these libraries: of the Python package, of an outside program on the installed library, of the Debian
# package. A pointer that is null ends the program under the address sanitizer, too: the checks of pointers that the
# undefined-behaviour sanitizer has besides, half of the compiler's time, are off. Needs what tests/run.sh has installed
# and built. The last line says what was found; the exit status is 0 if nothing was.
set -u
cd "$(dirname "$0")/.." || exit 1
trouble=

# Builds a preset's program and tests, and shows the compiler's words if that fails.
build() {
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

reports='ERROR: AddressSanitizer\|runtime error\|Assertion .* failed'
if build asan rollres_fuzz; then
  say_time "address and undefined behaviour built"
  suite() { ctest --test-dir build/asan --timeout 1800 --output-on-failure "$@" >>build/asan-tests.log 2>&1; }
  : >build/asan-tests.log
  # What fails without a report may have been late: it runs once more, alone.
  suite --parallel "$(nproc)" --no-tests=error || { ! grep -q "$reports" build/asan-tests.log && suite --rerun-failed; } ||
    trouble="$trouble the suite fails under address and undefined-behaviour sanitizers;"
  sed -n "/$reports\|tests passed\|FAILED:\$/p;/The following tests FAILED/,\$p" build/asan-tests.log
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
if build tsan; then
  say_time "threads built"
  folder=$(mktemp -d) || exit 1
  trap 'rm -rf "$folder"' EXIT
  for tests in "[parallel]" "~[python]~[limits]*threads*" "*thread that*"; do
    $plain_addresses build/tsan/tests/rollres_tests "$tests" >"$folder/out" 2>&1 && tail -n 2 "$folder/out" || {
      cat "$folder/out"
      trouble="$trouble the tests $tests fail under the thread sanitizer;"
    }
  done
  cat >"$folder/study.json" <<'STUDY'
{"study": "threads", "scene": {"indenter": "cylinder", "radius": 0.02, "layer_thickness": 0.005, "static_shear_modulus": 3e6,
  "stiffening": 1, "creep_time": 0.25, "speed": 0.05, "load": 100, "friction_coefficient": 0.2},
 "axes": {"indenter": ["cylinder", "sphere"], "method": ["automatic", "newton"],
  "speed": {"from": 0.01, "to": 1, "points": 6, "spacing": "logarithmic"}, "poisson_ratio": [0.5, 0.3]}}
STUDY
  threads sweep "$folder/study.json" --db "$folder/a.db" --jobs 8
  threads report --db "$folder/a.db" --out "$folder/a.html"
  threads solve studies/examples/paper_sphere.json --set "spacing=0.08 mm"
  threads fit studies/examples/fit_cylinder.json --db "$folder/f.db" --jobs 8
  threads gradient studies/examples/paper_cylinder.json --inputs speed,layer_thickness --jobs 8
  say_time "threads run"
fi

[ -n "$trouble" ] && echo "SANITIZERS FOUND:$trouble see above and build/asan-tests.log" && exit 1
echo "sanitizers: nothing found"
