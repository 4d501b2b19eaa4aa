#include "studies/run/slurm_scripts.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>

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

/// The scripts of this folder by their names. What differs from job to job stands in them as {{options}} (of sbatch),
/// {{variables}} and {{throttle}}.
const std::map<std::string_view, std::string_view> scripts{
#include "slurm_scripts.inc"
};

std::string filled_in(std::string_view name, const SlurmJob& job, const std::string& options) {
  std::string text(scripts.at(name));
  const auto fill_in = [&](std::string_view place, const std::string& by) {
    if (const auto at = text.find(place); at != std::string::npos) text.replace(at, place.size(), by);
  };
  // From the end of a script, so that no text that is filled in is taken for a place.
  fill_in("{{throttle}}", job.throttle > 0 ? "%" + std::to_string(job.throttle) : "");
  fill_in("{{variables}}\n", variables(job));
  fill_in("{{options}}\n", options);
  return text;
}

}  // namespace

std::string array_script(const SlurmJob& job) {
  return filled_in("slurm_array", job,
                   option("job-name", plain_name(job.name)) + output_file(job, "shard-%a-%A.txt") +
                       option("cpus-per-task", std::to_string(job.cores)) + option("time", job.time) +
                       option("partition", job.partition));
}

std::string merge_script(const SlurmJob& job) {
  return filled_in("slurm_merge", job,
                   option("job-name", plain_name(job.name) + "-merge") + output_file(job, "merge-%j.txt") +
                       option("time", job.time) + option("partition", job.partition));
}

std::string submit_script(const SlurmJob& job) { return filled_in("slurm_submit", job, ""); }

}  // namespace rollres
