#!/bin/sh
{{options}}
#SBATCH --signal=B:TERM@60

# Solves shard $SLURM_ARRAY_TASK_ID on the disk of this node. submit.sh submits this script.

{{variables}}
shard=${SLURM_ARRAY_TASK_ID:?is set by Slurm}
kept=$folder/shards/$shard.db
scratch=$(mktemp -d "${TMPDIR:-/tmp}/rollres.XXXXXX") || exit 3
trap 'rm -rf "$scratch"' EXIT
rm -f "$kept".*.part
[ ! -e "$kept" ] || cp "$kept" "$scratch/shard.db" || exit 3

# As one file without a log, which network file systems do not bear; nobody ever sees half of it.
bring_back() {
  [ -e "$scratch/shard.db" ] || return 0
  "$rollres" export --study "$study" --db "$scratch/shard.db" --out "$scratch/$1" >"$scratch/$1.txt" &&
    cp "$scratch/$1/results.db" "$kept.$$.part" && mv "$kept.$$.part" "$kept"
}

"$rollres" sweep "$folder/study.json" --shard "$shard/$tasks" --db "$scratch/shard.db" \
  --jobs "${SLURM_CPUS_PER_TASK:-1}" &
sweep=$!
(
  trap 'kill $! 2>/dev/null; exit' TERM
  while :; do
    sleep 600 &
    wait $!
    bring_back meanwhile
  done
) &
now_and_then=$!
last_word=

# The sweep ends after the points in work; if they take too long, without them.
on_term() {
  trap '' TERM
  kill -TERM "$sweep" 2>/dev/null
  (
    trap 'kill $! 2>/dev/null; exit' TERM
    sleep 30 &
    wait $!
    kill -KILL "$sweep" 2>/dev/null
  ) &
  last_word=$!
}
trap on_term TERM

while :; do
  wait "$sweep"
  status=$?
  kill -0 "$sweep" 2>/dev/null || break
done
[ -z "$last_word" ] || kill "$last_word" 2>/dev/null
kill "$now_and_then" 2>/dev/null
wait "$now_and_then" 2>/dev/null
bring_back whole || status=3
exit $status
