#pragma once

/// Shell scripts that run a study as a Slurm job array (schedmd.com/slurm.html, "Job Array Support").

#include <filesystem>
#include <string>

namespace rollres {

struct SlurmJob {
  std::string name;                ///< of the study
  int tasks = 1;                   ///< shards, and elements of the array
  int throttle = 0;                ///< elements that run at a time; 0: as many as the cluster lets
  int cores = 1;                   ///< for each task
  std::string time, partition;     ///< as sbatch takes them; empty: the cluster's default
  std::filesystem::path program;   ///< rollres; this and the others absolute, seen by all nodes
  std::filesystem::path folder;    ///< holds study.json, the scripts, shards/ and logs/
  std::filesystem::path database;  ///< that takes the results in the end
};

/// Solves one shard on the disk of the node, from where what is solved is brought back every ten minutes, at the end,
/// and when Slurm announces the end of the time (SIGTERM, a minute before): as a whole file that replaces the one
/// before.
std::string array_script(const SlurmJob& job);

/// Merges the shards into the database, and fails if points are missing.
std::string merge_script(const SlurmJob& job);

/// Submits both, the second to wait for the first. Run again, submits only the shards that have points missing; nothing
/// while the jobs of the last time are in the queue.
std::string submit_script(const SlurmJob& job);

}  // namespace rollres
