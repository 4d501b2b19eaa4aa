#pragma once

/// Runs in front of a terminal: a line of progress, and a signal that ends them early.

#include <optional>
#include <ostream>
#include <utility>

#include "studies/program/commands.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/stop_signal.hpp"
#include "studies/run/sweep.hpp"

namespace rollres {

/// Tells that a study of this name is defined anew.
inline std::function<void(const Redefinition&)> tell_redefined(const std::string& study, Session& session) {
  return [study, &session](const Redefinition& redefined) {
    session.err << study << ": defined anew: " << redefined.in_words() << '\n';
  };
}

/// Sweeps. @param signal  taken when only solving is left to do: until then there is nothing to bring home, and a
/// signal ends the program
inline SweepReport watched_sweep(const Study& study, const std::string& database, SweepOptions options,
                                 std::optional<StopSignal>& signal, Session& session) {
  options.ready = [&] { signal.emplace(); };
  options.stop = &StopSignal::requested();
  options.redefined = tell_redefined(study.name, session);
  StatusLine line(session.err);
  if (line) options.report = [&](const SweepProgress& progress) { line.show(progress); };
  return run_sweep(study, session.evaluate, database, options);
}

/// What `run()` returns, by child processes; the plan that it carries out tells its progress to the terminal, if there
/// is one, and stops at an interruption.
template <class Plan, class Run>
auto watched_run(Plan& plan, Session& session, const Run& run) {
  StatusLine line(session.err);
  if (line) plan.report = [&](const SweepProgress& progress) { line.show(progress); };
  const StopSignal signal;
  plan.stop = &signal.requested();
  session.out.flush();  // a child process inherits what is not written yet
  auto report = run();
  plan.stop = nullptr;
  plan.report = {};
  return report;
}

}  // namespace rollres
