#pragma once

/// Runs of many pieces by child processes, in front of a terminal: a line of progress, and a signal that ends them
/// early.

#include "studies/program/commands.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/stop_signal.hpp"

namespace rollres {

/// What `run()` returns; the plan that it carries out tells its progress to the terminal, if there is one, and stops at
/// an interruption.
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
