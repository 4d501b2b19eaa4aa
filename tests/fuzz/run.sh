#!/bin/sh
# Fuzzes every reader and the solver for so many minutes in all, with a new seed each time. With clang: libFuzzer under
# address and undefined-behaviour sanitizers (build/fuzz), else mutations by rollres_fuzz of the asan preset. What was
# found stands in build/found; put it into tests/fuzz/corpus/TARGET once it is mended.
#
#     tests/fuzz/run.sh MINUTES
set -eu
[ $# -eq 1 ] || { echo "tests/fuzz/run.sh MINUTES" >&2; exit 2; }
cd "$(dirname "$0")/../.."
top=$PWD seconds=$(($1 * 60)) seed=$(date +%s)
targets="scene study fit csv filter formula unit database line solve"
mkdir -p build/found
status=0
if command -v clang++ >/dev/null; then
  flags="-O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=undefined"
  cmake -S . -B build/fuzz -G Ninja -D CMAKE_BUILD_TYPE=Sanitized -D CMAKE_CXX_COMPILER=clang++ -D CMAKE_C_COMPILER=clang \
    -D ROLLRES_FUZZERS=ON -D CMAKE_CXX_FLAGS="$flags -fsanitize=fuzzer-no-link" >/dev/null
  ninja -C build/fuzz $(for target in $targets; do echo "tests/fuzz/fuzz_$target"; done)
  program=build/fuzz/tests/fuzz
  for target in $targets; do
    mkdir -p "build/fuzz/new_$target"
    "$program/fuzz_$target" -max_total_time=$((seconds / 10)) -timeout=60 -rss_limit_mb=4000 -seed="$seed" -print_final_stats=1 \
      -artifact_prefix="build/found/$target-" "build/fuzz/new_$target" "tests/fuzz/corpus/$target" \
      2>"build/found/$target.log" || status=1
    echo "$target: $(sed -n 's/stat::number_of_executed_units: *//p' "build/found/$target.log") inputs"
  done
  last=$((seconds / 10))
else
  cmake --preset asan >/dev/null
  ninja -C build/asan rollres_fuzz
  (cd build/found && "$top/build/asan/tests/fuzz/rollres_fuzz" mutate "$top/tests/fuzz/corpus" $((seconds / 2)) "$seed") || status=1
  last=$((seconds / 2))
fi
# Scenes with the usual limits, a hundred at a time.
cmake --preset release >/dev/null
ninja -C build/release rollres_fuzz
end=$(($(date +%s) + last))
while [ "$(date +%s)" -lt "$end" ]; do
  (cd build/found && "$top/build/release/tests/fuzz/rollres_fuzz" scenes 100 "$seed") || status=1
  seed=$((seed + 1))
done
ls build/found
exit $status
