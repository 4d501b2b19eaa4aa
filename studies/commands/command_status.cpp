#include <chrono>
#include <cmath>
#include <ostream>
#include <stdexcept>
#include <thread>

#include "db/rows/result_store.hpp"
#include "studies/charts/live_view.hpp"
#include "studies/program/commands.hpp"
#include "studies/run/probed_cost.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/stop_signal.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/study/shards.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"

namespace rollres {

namespace {

struct StatusArguments {
  std::string study;  // file; empty: what the databases say themselves
  std::vector<std::string> databases;
  int shards = 0;  // 0: not asked for
  bool json = false, array = false, follow = false;
  double every = 1;  // [s]
  std::string name;  // of the followed study
};

Json object_of(const std::string& name, const StudyStatus& status) {
  Json object = json_object("study", name, "points", status.points, "converged", status.converged, "failed",
                            status.failed, "missing", status.missing);
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

/// Shows a study while it grows, until it is whole or somebody stops it: on a terminal in one place, elsewhere a line
/// for each change.
void follow(const StatusArguments& arguments, Session& session) {
  if (arguments.databases.size() != 1) throw std::invalid_argument("--follow: needs one --db");
  if (!(arguments.every >= 0.01 && arguments.every <= 3600))
    throw std::invalid_argument("--every = " + short_number(arguments.every) + ": must be from 0.01 to 3600 s");
  const std::string name = arguments.study.empty() ? arguments.name : read_study(arguments.study).name;
  const StopSignal signal;
  const std::size_t width = terminal_width(session.out), height = terminal_height(session.out);
  std::string last;
  while (true) {
    ResultStore store(arguments.databases.front(), Access::read);
    const double now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    const LiveProgress progress = live_progress(store, name, now);
    if (width > 0)
      session.out << "\x1b[H\x1b[J" << live_view(store, progress, width, height) << std::flush;
    else if (const std::string line = in_words(progress); line != last)
      session.out << (last = line) << std::endl;
    if (progress.done() || signal.requested()) {
      if (!progress.done()) session.status = ExitStatus::no_answer;
      return;
    }
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(arguments.every);
    while (std::chrono::steady_clock::now() < end && !signal.requested())
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

void status(const StatusArguments& arguments, Session& session) {
  if (arguments.follow) return follow(arguments, session);
  if (arguments.study.empty()) {
    if (arguments.shards > 0) throw std::invalid_argument("--shards: needs the study file");
    if (arguments.json && arguments.databases.size() > 1)
      throw std::invalid_argument("--db: only one with --json, without a study file");
    if (arguments.databases.empty()) status_of_stored(usual_database(), arguments, session);
    for (const std::string& file : arguments.databases) status_of_stored(file, arguments, session);
    return;
  }
  const Study study = read_study(arguments.study);
  std::vector<std::filesystem::path> present;
  if (arguments.databases.empty() && std::filesystem::exists(usual_database())) present.emplace_back(usual_database());
  for (const std::string& file : arguments.databases) {
    if (std::filesystem::exists(file))
      present.emplace_back(file);
    else
      session.err << file << ": no such file, counted as empty\n";
  }
  StudyStatus found = study_status(study, present, std::max(1, arguments.shards));
  if (!arguments.array && found.unlearned > 0) {
    const ProbedCost probed = probed_cost(study, session.evaluate);
    found.seconds_left += probed.seconds_each * static_cast<double>(found.unlearned) - found.seconds_unlearned;
    session.err << "the time is that of " << probed.points << " points solved just now\n";
  }
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
                      "database; may be repeated: several are read as one; left out: that of ROLLRES_DB, or "
                      "rollres.db, if it is there");
  CommandOption* const shards =
      command->add_option("--shards N", arguments.shards, "number of shards: tell which have something missing")
          ->between(1, most_shards);
  CommandOption* const array =
      command->add_flag("--array", arguments.array, "print only these shards, as Slurm's --array takes them")
          ->needs(shards);
  CommandOption* const json = command->add_flag("--json", arguments.json, "print one JSON object")->excludes(array);
  CommandOption* const follow =
      command
          ->add_flag("--follow", arguments.follow,
                     "show a study while others compute it: how far it is, when it will be done, what failed, its "
                     "curves; ends with it, or at Ctrl-C")
          ->excludes(array)
          ->excludes(json);
  command->add_option("--study NAME", arguments.name, "the study to follow, of several in the database")->needs(follow);
  command->add_option("--every SECONDS", arguments.every, "time between two looks; default: 1")->needs(follow);
  command->footer(
      "Exit status 0: every point is answered, failed ones included; 1: something is missing.\n"
      "Examples: rollres status STUDY --db shard-*.db --shards 16\n"
      "          rollres status --db results.db --follow");
}

}  // namespace rollres
