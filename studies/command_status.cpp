#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <ostream>

#include "studies/commands.hpp"
#include "studies/progress.hpp"
#include "studies/shards.hpp"
#include "studies/study_status.hpp"
#include "studies/table_json.hpp"

namespace rollres {

namespace {

struct StatusWords {
  std::string study;
  std::vector<std::string> databases;
  int shards = 0;  // 0: not asked for
  bool json = false, array = false;
};

void print_json(std::ostream& out, const Study& study, const StudyStatus& status, const StatusWords& words) {
  Json object{{"study", study.name},     {"points", status.points},   {"converged", status.converged},
              {"failed", status.failed}, {"missing", status.missing}, {"seconds_left", status.seconds_left}};
  if (words.shards > 0) {
    object["shards"] = words.shards;
    object["shards_missing"] = status.shards_missing;
    object["array"] = array_list(status.shards_missing);
  }
  out << text_of(object, 2) << '\n';
}

void print_lines(std::ostream& out, const Study& study, const StudyStatus& status, const StatusWords& words) {
  out << study.name << ": " << status.converged + status.failed << " of " << status.points << " points answered, "
      << status.failed << " of them failed; " << status.missing << " missing";
  if (status.missing > 0) out << ", about " << duration_in_words(status.seconds_left) << " on one core";
  out << '\n';
  if (words.shards > 0 && status.missing > 0)
    out << "shards with points missing: " << array_list(status.shards_missing) << " of " << words.shards << '\n';
}

void status(const StatusWords& words, Session& session) {
  const Study study = read_study(words.study);
  std::vector<std::filesystem::path> present;
  for (const std::string& file : words.databases) {
    if (std::filesystem::exists(file))
      present.emplace_back(file);
    else
      session.err << file << ": no such file, counted as empty\n";
  }
  const StudyStatus found = study_status(study, present, std::max(1, words.shards));
  if (words.array)
    session.out << array_list(found.shards_missing) << '\n';
  else if (words.json)
    print_json(session.out, study, found, words);
  else
    print_lines(session.out, study, found, words);
  if (found.missing > 0) session.status = ExitStatus::no_answer;
}

}  // namespace

void add_status(CLI::App& program, Session& session) {
  CLI::App* command = program.add_subcommand("status", "Tell what of a study is stored, and what is missing");
  const auto words = std::make_shared<StatusWords>();
  command->add_option("study", words->study, "study file")->required();
  command->add_option("--db", words->databases,
                      "database; several are taken together; none: the whole study is missing");
  CLI::Option* const shards =
      command->add_option("--shards", words->shards, "number of shards: tell which have something missing")
          ->check(CLI::Range(1, most_shards));
  CLI::Option* const array =
      command->add_flag("--array", words->array, "print only these shards, as Slurm's --array takes them")
          ->needs(shards);
  command->add_flag("--json", words->json, "print one JSON object")->excludes(array);
  command->footer(
      "Exit status 0: every point is answered, failed ones included; 1: something is missing.\n"
      "Example: rollres status STUDY --db shard-*.db --shards 16");
  command->callback([words, &session] { status(*words, session); });
}

}  // namespace rollres
