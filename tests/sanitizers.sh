#!/bin/sh
# The suite under address and undefined-behaviour sanitizers, without the tests that build or run other programs and with
# a tenth of the random input (ROLLRES_THIN), then spheres on many threads and a sweep with 8 jobs under the thread
# sanitizer. Asserts of libstdc++ and Eigen are on. Needs what tests/run.sh installs.
set -u
cd "$(dirname "$0")/.." || exit 1
export ROLLRES_THIN=1 ASAN_OPTIONS=detect_stack_use_after_return=0:allocator_may_return_null=0 UBSAN_OPTIONS=print_stacktrace=1

cmake --preset asan >/dev/null && ninja -C build/asan || exit 1
ctest --test-dir build/asan --parallel "$(nproc)" --output-on-failure --timeout 900 \
  -E "^(every command of the README|a Slurm array|An outside program|The Debian package)"
status=$?

cmake --preset tsan >/dev/null && ninja -C build/tsan rollres || exit 1
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
export TSAN_OPTIONS="halt_on_error=0:exitcode=66:suppressions=$PWD/tests/tsan.txt"
threads() {
  echo "rollres $*"
  build/tsan/rollres "$@" >"$folder/out" 2>"$folder/err"
  ended=$?
  [ $ended -le 1 ] && return
  cat "$folder/err"
  status=1
}
cat >"$folder/study.json" <<'STUDY'
{"study": "threads", "scene": {"indenter": "cylinder", "radius": 0.02, "layer_thickness": 0.005, "static_shear_modulus": 3e6,
  "stiffening": 1, "creep_time": 0.25, "speed": 0.05, "load": 100, "friction_coefficient": 0.2},
 "axes": {"indenter": ["cylinder", "sphere"], "method": ["automatic", "active_set"],
  "speed": {"from": 0.01, "to": 1, "points": 6, "spacing": "logarithmic"}, "poisson_ratio": [0.5, 0.3]}}
STUDY
threads sweep "$folder/study.json" --db "$folder/a.db" --jobs 8
threads report --db "$folder/a.db" --out "$folder/a.html"
threads solve studies/examples/paper_sphere.json --set "spacing=0.08 mm"
threads solve studies/examples/ball_on_mat.json
threads fit studies/examples/fit_cylinder.json --db "$folder/f.db" --jobs 8
threads gradient studies/examples/paper_cylinder.json --jobs 8
exit $status
