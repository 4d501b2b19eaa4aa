#include <cmath>
#include <ostream>
#include <stdexcept>

#include "db/rows/result_store.hpp"
#include "studies/program/commands.hpp"
#include "studies/run/progress.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/study/shards.hpp"
#include "studies/text/table_json.hpp"

namespace rollres {

namespace {

struct StatusArguments {
  std::string study;  // file; empty: what the databases say themselves
  std::vector<std::string> databases;
  int shards = 0;  // 0: not asked for
  bool json = false, array = false;
};

Json object_of(const std::string& name, const StudyStatus& status) {
  Json object{{"study", name},
              {"points", status.points},
              {"converged", status.converged},
              {"failed", status.failed},
              {"missing", status.missing}};
  if (!std::isnan(status.seconds_left)) object["seconds_left"] = status.seconds_left;
  return object;
}

void print_json(std::ostream& out, const std::string& name, const StudyStatus& status,
                const StatusArguments& arguments) {
  Json object = object_of(name, status);
  if (arguments.shards > 0) {
    object["shards"] = arguments.shards;
    object["shards_missing"] = status.shards_missing;
    object["array"] = array_list(status.shards_missing);
  }
  out << text_of(object, 2) << '\n';
}

void print_lines(std::ostream& out, const std::string& name, const StudyStatus& status,
                 const StatusArguments& arguments) {
  out << name << ": " << status.converged + status.failed << " of " << status.points << " points answered, "
      << status.failed << " of them failed; " << status.missing << " missing";
  if (status.missing > 0 && !std::isnan(status.seconds_left))
    out << ", about " << duration_in_words(status.seconds_left) << " on one core";
  out << '\n';
  if (arguments.shards > 0 && status.missing > 0)
    out << "shards with points missing: " << array_list(status.shards_missing) << " of " << arguments.shards << '\n';
}

/// Of the studies that a database holds, as it holds them.
void status_of_stored(const std::string& file, const StatusArguments& arguments, Session& session) {
  const std::vector<StudySummary> studies = ResultStore(file, Access::read).studies();
  Json object{{"db", file}, {"studies", Json::array()}};
  for (const StudySummary& study : studies) {
    StudyStatus status;
    status.points = static_cast<std::size_t>(study.points);
    status.failed = static_cast<std::size_t>(study.failed);
    status.converged = static_cast<std::size_t>(study.answered - study.failed);
    status.missing = static_cast<std::size_t>(study.points - study.answered);
    if (arguments.json)
      object["studies"].push_back(object_of(study.name, status));
    else
      print_lines(session.out, study.name, status, arguments);
    if (status.missing > 0) session.status = ExitStatus::no_answer;
  }
  if (arguments.json) session.out << text_of(object, 2) << '\n';
  if (studies.empty()) session.err << file << ": holds no study\n";
}

void status(const StatusArguments& arguments, Session& session) {
  if (arguments.study.empty()) {
    if (arguments.databases.empty()) throw std::invalid_argument("status: needs a study file, or --db, or both");
    if (arguments.shards > 0) throw std::invalid_argument("--shards: needs the study file");
    if (arguments.json && arguments.databases.size() > 1)
      throw std::invalid_argument("--db: only one with --json, without a study file");
    for (const std::string& file : arguments.databases) status_of_stored(file, arguments, session);
    return;
  }
  const Study study = read_study(arguments.study);
  std::vector<std::filesystem::path> present;
  for (const std::string& file : arguments.databases) {
    if (std::filesystem::exists(file))
      present.emplace_back(file);
    else
      session.err << file << ": no such file, counted as empty\n";
  }
  const StudyStatus found = study_status(study, present, std::max(1, arguments.shards));
  if (arguments.array)
    session.out << array_list(found.shards_missing) << '\n';
  else if (arguments.json)
    print_json(session.out, study.name, found, arguments);
  else
    print_lines(session.out, study.name, found, arguments);
  if (found.missing > 0) session.status = ExitStatus::no_answer;
}

}  // namespace

void add_status(Command& program, Session& session) {
  const auto [command, arguments] =
      program.add<StatusArguments>("status", "Tell what of a study is stored, and what is missing", session, status);
  command->add_option("study STUDY", arguments.study, "study file; left out: every study of the database");
  command->add_option("--db FILE", arguments.databases,
                      "database; several are taken together; none: the whole study is missing");
  CommandOption* const shards =
      command->add_option("--shards N", arguments.shards, "number of shards: tell which have something missing")
          ->between(1, most_shards);
  CommandOption* const array =
      command->add_flag("--array", arguments.array, "print only these shards, as Slurm's --array takes them")
          ->needs(shards);
  command->add_flag("--json", arguments.json, "print one JSON object")->excludes(array);
  command->footer(
      "Exit status 0: every point is answered, failed ones included; 1: something is missing.\n"
      "Example: rollres status STUDY --db shard-*.db --shards 16");
}

}  // namespace rollres
