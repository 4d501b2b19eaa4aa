#include "studies/run/slurm_scripts.hpp"

#include <algorithm>
#include <cctype>

#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// A name without what would need quotes in a comment of sbatch or in a file's name.
std::string plain_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char letter) { return !std::isalnum(letter) && letter != '-'; }, '_');
  return name;
}

/// sbatch reads its comments with quotes like a shell's.
std::string option(const std::string& name, const std::string& value) {
  return value.empty() ? "" : "#SBATCH --" + name + "=" + shell_word(value) + "\n";
}

/// A file for messages; in its name Slurm replaces patterns such as %a.
std::string output_file(const SlurmJob& job, const std::string& pattern) {
  std::string folder;
  for (const char letter : (job.folder / "logs").string()) folder += letter == '%' ? "%%" : std::string(1, letter);
  return option("output", folder + "/" + pattern);
}

/// The variables that all scripts share.
std::string variables(const SlurmJob& job) {
  std::string lines = "set -u\n";
  const auto set = [&](const std::string& name, const std::string& value) {
    lines += name + "=" + shell_word(value) + "\n";
  };
  set("rollres", job.program.string());
  set("study", job.name);
  set("folder", job.folder.string());
  set("database", job.database.string());
  set("tasks", std::to_string(job.tasks));
  return lines;
}

}  // namespace

std::string array_script(const SlurmJob& job) {
  return "#!/bin/sh\n" + option("job-name", plain_name(job.name)) + output_file(job, "shard-%a-%A.txt") +
         option("cpus-per-task", std::to_string(job.cores)) + option("time", job.time) +
         option("partition", job.partition) + R"sh(#SBATCH --signal=B:TERM@60

# Solves shard $SLURM_ARRAY_TASK_ID on the disk of this node. submit.sh submits this script.

)sh" + variables(job) +
         R"sh(shard=${SLURM_ARRAY_TASK_ID:?is set by Slurm}
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
)sh";
}

std::string merge_script(const SlurmJob& job) {
  return "#!/bin/sh\n" + option("job-name", plain_name(job.name) + "-merge") + output_file(job, "merge-%j.txt") +
         option("time", job.time) + option("partition", job.partition) + R"sh(
# Brings the shards together. Merging again changes nothing.

)sh" + variables(job) +
         R"sh("$rollres" merge "$folder"/shards/*.db --db "$database"
merged=$?
"$rollres" status "$folder/study.json" --db "$database" --shards "$tasks" || [ $merged -ne 0 ] || merged=1
exit $merged
)sh";
}

std::string submit_script(const SlurmJob& job) {
  const std::string throttle = job.throttle > 0 ? "%" + std::to_string(job.throttle) : "";
  return R"sh(#!/bin/sh
# Submits the shards that have points missing as a job array, and a job that merges them. Run it again to submit
# what is missing then.

)sh" + variables(job) +
         R"sh(if [ -e "$folder/jobs" ]; then
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
  array=$(sbatch --parsable --array="$missing)sh" +
         throttle + R"sh(" "$folder/array.sh") || exit 3
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
)sh";
}

}  // namespace rollres
