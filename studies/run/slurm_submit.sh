#!/bin/sh
# Submits the shards that have points missing as a job array, and a job that merges them. Run it again to submit
# what is missing then.

{{variables}}
if [ -e "$folder/jobs" ]; then
  queued=$(squeue --noheader --format=%i --jobs="$(cat "$folder/jobs")" 2>/dev/null)
  [ -z "$queued" ] || {
    echo "still in the queue:" $queued
    exit 1
  }
fi

set --
for file in "$database" "$folder"/shards/*.db; do
  [ ! -e "$file" ] || set -- "$@" --db "$file"
done
missing=$("$rollres" status "$folder/study.json" "$@" --shards "$tasks" --array)
[ $? -le 1 ] || exit 3
if [ -n "$missing" ]; then
  array=$(sbatch --parsable --array="$missing{{throttle}}" "$folder/array.sh") || exit 3
  array=${array%%;*}
  echo "$array" >"$folder/jobs"
  merge=$(sbatch --parsable --dependency="afterany:$array" "$folder/merge.sh") || exit 3
  echo "submitted shards $missing as job $array, and their merge as job ${merge%%;*}"
elif "$rollres" status "$folder/study.json" --db "$database" 2>/dev/null; then
  exit 0
else
  array=
  merge=$(sbatch --parsable "$folder/merge.sh") || exit 3
  echo "all shards are complete; submitted their merge as job ${merge%%;*}"
fi
echo "${array:+$array,}${merge%%;*}" >"$folder/jobs"
