#include <ostream>

#include "studies/program/watched_run.hpp"
#include "studies/text/similar_texts.hpp"
#include "studies/text/table_json.hpp"

namespace rollres {

namespace {

struct SweepArguments {
  std::string study, database, shard;
  int jobs = 0;
  bool json = false, fields = false, replace = false;
  std::string retry = "nothing";
};

void print_json(std::ostream& out, const SweepReport& report, const std::vector<Failure>& failures,
                const SweepArguments& arguments) {
  const StudySummary& study = report.study;
  Json object = json_object("study", study.name, "db", arguments.database, "points", report.points, "dropped",
                            report.dropped, "answered", report.answered, "recalled", report.recalled, "solved",
                            report.solved, "failed", report.failed, "interrupted", report.interrupted, "seconds",
                            report.seconds, "failures", Json::array());
  if (!arguments.shard.empty()) object["shard"] = arguments.shard;
  for (const Failure& failure : failures)
    object["failures"].push_back({{"status", failure.status}, {"reason", failure.reason}, {"points", failure.points}});
  out << text_of(object, 2) << '\n';
}

/// Failures whose reasons differ only in their numbers as one, the most frequent first.
std::vector<Failure> grouped(const std::vector<Failure>& failures) {
  std::vector<std::string> reasons;
  for (const Failure& failure : failures) reasons.push_back(failure.reason);
  reasons = with_ranges(reasons);
  std::vector<Failure> groups;
  for (std::size_t i = 0; i < failures.size(); ++i) {
    const auto same = find_if(
        groups, [&](const Failure& group) { return group.status == failures[i].status && group.reason == reasons[i]; });
    if (same != groups.end())
      same->points += failures[i].points;
    else
      groups.push_back({failures[i].status, reasons[i], failures[i].points});
  }
  stable_sort(groups, [](const Failure& a, const Failure& b) { return a.points > b.points; });
  return groups;
}

void print_summary(Session& session, const SweepReport& report, const std::vector<Failure>& single_failures,
                   const SweepArguments& arguments) {
  const std::vector<Failure> failures = grouped(single_failures);
  const StudySummary& study = report.study;
  session.out << study.name << (arguments.shard.empty() ? "" : ", shard " + arguments.shard) << ": " << report.answered
              << " of " << report.points << " points in " << arguments.database << ", " << report.recalled
              << " recalled, " << report.solved << " solved in " << duration_in_words(report.seconds) << ", "
              << report.failed << " failed\n";
  if (report.dropped > 0)
    session.err << report.dropped << (report.dropped == 1 ? " point is" : " points are") << " dropped by constraints\n";
  constexpr std::size_t shown = 5;
  for (std::size_t i = 0; i < failures.size() && i < shown; ++i)
    session.err << failures[i].points << " x " << failures[i].status << ": " << failures[i].reason << '\n';
  if (failures.size() > shown)
    session.err << "and " << failures.size() - shown << " other reasons: rollres query 'study=" << study.name
                << "' 'status!=converged' --columns position,status,reason --db " << arguments.database << '\n';
  if (report.interrupted) session.err << "interrupted: the same command solves what is missing\n";
}

void sweep(const SweepArguments& given, Session& session) {
  SweepArguments arguments = given;
  const Study study = read_study(arguments.study);
  SweepOptions options{.jobs = arguments.jobs, .retry = retry_named(arguments.retry), .replace = arguments.replace};
  options.fields = arguments.fields || study.fields ? Fields::kept : Fields::dropped;
  if (!arguments.shard.empty()) {
    options.shard = parse_shard(arguments.shard);
    arguments.shard = options.shard.name();
    if (const std::string& variable = options.shard.variable; !variable.empty())
      session.err << "shard " << arguments.shard << " by " << variable << '\n';
  }
  std::optional<StopSignal> signal;
  const SweepReport report = watched_sweep(study, arguments.database, options, signal, session);
  std::vector<Failure> failures;
  if (report.study.failed > 0) failures = ResultStore(arguments.database, Access::read).failures(study.name);
  if (arguments.json)
    print_json(session.out, report, failures, arguments);
  else
    print_summary(session, report, failures, arguments);
  if (report.failed > 0 || report.answered < report.points) session.status = ExitStatus::no_answer;
}

}  // namespace

void add_sweep(Command& program, Session& session) {
  const auto [command, arguments] =
      program.add<SweepArguments>("sweep", "Solve all points of a study and store each as it comes", session, sweep);
  command->add_option("study STUDY", arguments.study, "study file")->required();
  command->add_option("--db FILE", arguments.database, "database; created if it is missing")->or_usual_database();
  command->add_option("--jobs N", arguments.jobs, "threads; default: one for each core")->between(1, 1024);
  command->add_option("--shard I/N", arguments.shard,
                      "I/N: solve only the I-th of N parts of about the same cost; rollres merge brings them together; "
                      "auto/N: I is the index of the task in a queue's array of jobs");
  command
      ->add_option("--retry WHICH", arguments.retry,
                   "solve again what is stored: failed (every point without an answer), not_converged, or all; the new "
                   "answer takes the place of the old one")
      ->one_of({"failed", "not_converged", "all"});
  command->add_flag("--fields", arguments.fields,
                    "store the fields on the surface too, for show --fields; solves points again that have none");
  command->add_flag("--replace", arguments.replace,
                    "take the place of a study of this name that is defined otherwise; its rows stay");
  command->add_flag("--json", arguments.json, "print the outcome as one JSON object");
  command->footer(
      "What is stored already is not solved again: a study that was stopped goes on with the same command.\n"
      "Example: rollres sweep studies/examples/speed_resistance.json --db results.db\n"
      "16 parts on 8 cores, by GNU parallel (for Slurm see rollres slurm):\n"
      "  parallel -j 8 rollres sweep STUDY --shard {}/16 --jobs 1 --db shard-{}.db ::: $(seq 16)\n"
      "  rollres merge shard-*.db --db results.db\n"
      "In an array of 16 jobs of any other queue: rollres sweep STUDY --shard auto/16 --db shard-$INDEX.db");
}

}  // namespace rollres
