#pragma once

/// Runs of many pieces by child processes, in front of a terminal: a line of progress, and a signal that ends them
/// early.

#include <ostream>

#include "studies/program/commands.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/stop_signal.hpp"

namespace rollres {

/// What `run()` returns; the plan that it carries out tells its progress to the terminal, if there is one, and stops at
/// an interruption.
template <class Plan, class Run>
auto watched_run(Plan& plan, Session& session, const Run& run) {
  const std::size_t width = terminal_width(session.err);
  if (width > 0)
    plan.report = [&session, width](const SweepProgress& progress) {
      session.err << '\r' << progress_line(progress, width) << "\x1b[K" << std::flush;
    };
  const StopSignal signal;
  plan.stop = &signal.requested();
  session.out.flush();  // a child process inherits what is not written yet
  auto report = run();
  plan.stop = nullptr;
  if (width > 0) session.err << "\r\x1b[K" << std::flush;
  return report;
}

}  // namespace rollres
