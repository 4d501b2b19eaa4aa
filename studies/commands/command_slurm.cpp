#include <ostream>
#include <stdexcept>
#include <utility>

#include "studies/program/commands.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/slurm_scripts.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/study/shards.hpp"
#include "studies/text/files.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

struct SlurmArguments {
  SlurmJob job;
  std::string study, database, folder, program;
};

void write_script(const std::filesystem::path& file, const std::string& text) {
  using enum std::filesystem::perms;
  write_file(file, text);
  std::error_code error;
  std::filesystem::permissions(file, owner_exec | group_exec | others_exec, std::filesystem::perm_options::add, error);
  if (error) throw std::runtime_error(file.string() + ": cannot be made executable: " + error.message());
}

void slurm(const SlurmArguments& arguments, Session& session) {
  const Study study = read_study(arguments.study);
  const std::pair<const char*, const std::string*> in_lines[] = {{"--time", &arguments.job.time},
                                                                 {"--partition", &arguments.job.partition},
                                                                 {"--out", &arguments.folder},
                                                                 {"--db", &arguments.database},
                                                                 {"--program", &arguments.program}};
  for (const auto& [option, text] : in_lines)
    for (const unsigned char letter : *text)
      if (letter < 0x20)
        throw std::invalid_argument(std::string(option) + ": must be one line, without control characters");
  SlurmJob job = arguments.job;
  job.name = study.name;
  job.folder = std::filesystem::absolute(arguments.folder).lexically_normal();
  job.database = std::filesystem::absolute(arguments.database).lexically_normal();
  job.program = arguments.program.empty() ? std::filesystem::read_symlink("/proc/self/exe")
                                          : std::filesystem::absolute(arguments.program).lexically_normal();
  const std::filesystem::path copy = job.folder / "study.json";
  if (std::filesystem::exists(copy) && read_study(copy).name != study.name)
    throw std::invalid_argument("out = " + arguments.folder + ": holds the scripts of another study");
  for (const char* const folder : {"shards", "logs"}) make_directory(job.folder / folder);
  write_file(copy, study.definition);
  write_script(job.folder / "array.sh", array_script(job));
  write_script(job.folder / "merge.sh", merge_script(job));
  write_script(job.folder / "submit.sh", submit_script(job));

  const StudyStatus status = study_status(study, {}, 1);
  session.out << study.name << ": " << status.points << " points, about " << duration_in_words(status.seconds_left)
              << " on one core, in " << job.tasks << " shards\nnext: sh "
              << shell_word((job.folder / "submit.sh").string()) << '\n';
}

}  // namespace

void add_slurm(Command& program, Session& session) {
  const auto [command, arguments] =
      program.add<SlurmArguments>("slurm", "Write the scripts that run a study as a Slurm job array", session, slurm);
  command->add_option("study STUDY", arguments.study, "study file")->required();
  command->add_option("--tasks N", arguments.job.tasks, "number of shards, each a task of the array")
      ->required()
      ->between(1, most_shards);
  command->add_option("--db FILE", arguments.database, "database that takes the results in the end")->required();
  command->add_option("--out DIR", arguments.folder, "folder, seen by all nodes, for scripts, shards and logs")
      ->required();
  command->add_option("--throttle N", arguments.job.throttle, "tasks that run at a time; default: no limit")
      ->between(1, most_shards);
  command->add_option("--cores N", arguments.job.cores, "cores for each task; default: 1")->between(1, 1024);
  command->add_option("--time TIME", arguments.job.time,
                      "time limit of a task, as sbatch takes it; a minute before it what is "
                      "solved is brought back");
  command->add_option("--partition PARTITION", arguments.job.partition, "partition, as sbatch takes it");
  command->add_option("--program FILE", arguments.program, "rollres as the nodes see it; default: this one");
  command->footer(
      "Writes array.sh, merge.sh and submit.sh. `sh DIR/submit.sh` submits the array and, after it, the merge; run "
      "again,\n"
      "it submits only the shards that have points missing. Clusters allow 1000 tasks unless set otherwise\n"
      "(MaxArraySize).\n"
      "Without Slurm, the same shards by GNU parallel:\n"
      "  parallel -j 8 rollres sweep STUDY --shard {}/16 --jobs 1 --db shard-{}.db ::: $(seq 16)\n"
      "  rollres merge shard-*.db --db results.db\n"
      "Example: rollres slurm STUDY --tasks 100 --throttle 20 --time 2:00:00 --db results.db --out jobs");
}

}  // namespace rollres
