#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "studies/commands.hpp"
#include "studies/progress.hpp"
#include "studies/stop_signal.hpp"
#include "studies/sweep.hpp"
#include "studies/table_json.hpp"
#include "studies/write_file.hpp"

namespace rollres {

namespace {

struct SweepWords {
  std::string study, database;
  int jobs = 0;
  bool json = false;
};

void print_json(std::ostream& out, const SweepReport& report, const std::vector<Failure>& failures,
                const std::string& database, std::size_t dropped) {
  const StudySummary& study = report.study;
  Json object{{"study", study.name},
              {"db", database},
              {"points", study.points},
              {"dropped", dropped},
              {"answered", study.answered},
              {"recalled", report.recalled},
              {"solved", report.solved},
              {"failed", study.failed},
              {"interrupted", report.interrupted},
              {"seconds", report.seconds},
              {"failures", Json::array()}};
  for (const Failure& failure : failures)
    object["failures"].push_back({{"status", failure.status}, {"reason", failure.reason}, {"points", failure.points}});
  out << text_of(object, 2) << '\n';
}

void print_summary(Session& session, const SweepReport& report, const std::vector<Failure>& failures,
                   const std::string& database, std::size_t dropped) {
  const StudySummary& study = report.study;
  session.out << study.name << ": " << study.answered << " of " << study.points << " points in " << database << ", "
              << report.recalled << " recalled, " << report.solved << " solved in " << duration_in_words(report.seconds)
              << ", " << study.failed << " failed\n";
  if (dropped > 0)
    session.err << dropped << (dropped == 1 ? " point is" : " points are") << " dropped by constraints\n";
  constexpr std::size_t shown = 5;
  for (std::size_t i = 0; i < failures.size() && i < shown; ++i)
    session.err << failures[i].points << " x " << failures[i].status << ": " << failures[i].reason << '\n';
  if (failures.size() > shown)
    session.err << "and " << failures.size() - shown << " other reasons: rollres query 'study=" << study.name
                << "' 'status!=converged' --columns position,status,reason --db " << database << '\n';
  if (report.interrupted) session.err << "interrupted: the same command solves what is missing\n";
}

void sweep(const SweepWords& words, Session& session) {
  const Study study = read_study(words.study);
  const StopSignal signal;
  SweepOptions options;
  options.jobs = words.jobs;
  options.stop = &signal.requested();
  options.definition = text_in(words.study);
  const std::size_t width = terminal_width(session.err);
  if (width > 0)
    options.report = [&](const SweepProgress& progress) {
      session.err << '\r' << progress_line(progress, width) << "\x1b[K" << std::flush;
    };
  auto clear_line = [&] {
    if (width > 0) session.err << "\r\x1b[K" << std::flush;
  };
  SweepReport report;
  try {
    report = run_sweep(study, session.evaluate, words.database, options);
  } catch (...) {
    clear_line();
    throw;
  }
  clear_line();
  const std::size_t dropped = study.constraints.empty() ? 0 : plan(study).all_dropped();
  std::vector<Failure> failures;
  if (report.study.failed > 0) failures = ResultStore(words.database, Access::read).failures(study.name);
  if (words.json)
    print_json(session.out, report, failures, words.database, dropped);
  else
    print_summary(session, report, failures, words.database, dropped);
  if (report.study.failed > 0 || report.study.answered < report.study.points) session.status = ExitStatus::no_answer;
}

}  // namespace

void add_sweep(CLI::App& program, Session& session) {
  CLI::App* command = program.add_subcommand("sweep", "Solve all points of a study and store each as it comes");
  const auto words = std::make_shared<SweepWords>();
  command->add_option("study", words->study, "study file")->required();
  command->add_option("--db", words->database, "database; created if it is missing")->required();
  command->add_option("--jobs", words->jobs, "threads; default: one for each core")->check(CLI::Range(1, 1024));
  command->add_flag("--json", words->json, "print the outcome as one JSON object");
  command->footer(
      "What is stored already is not solved again: a study that was stopped goes on with the same command.\n"
      "Example: rollres sweep studies/examples/speed_resistance.json --db results.db");
  command->callback([words, &session] { sweep(*words, session); });
}

}  // namespace rollres
