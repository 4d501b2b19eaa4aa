#pragma once

/// The frame of the command line `rollres COMMAND ...`. Each command stands in its own file command_NAME.cpp as a
/// function `add_NAME` that declares its options on the program and sets a callback; commands.cpp lists them.
///
/// A callback prints its answer to `session.out`, everything else (progress, messages) to `session.err`, and sets
/// `session.status` where it is not 0. It throws std::invalid_argument for wrong input and std::runtime_error for
/// files, databases and disks that fail: the frame prints the message as one line and picks the exit status.

#include <iosfwd>
#include <string>
#include <vector>

#include "core/solve/rolling_contact.hpp"

namespace rollres {

class Command;

/// Exit status of the program.
struct ExitStatus {
  static constexpr int answered = 0;
  static constexpr int no_answer = 1;    ///< a scene has no steady state, or did not converge
  static constexpr int wrong_input = 2;  ///< the input or the command is wrong
  static constexpr int failure = 3;      ///< a file, the database or the disk failed
};

/// What one run of the program reads from and writes to.
struct Session {
  std::ostream& out;  ///< answers
  std::ostream& err;  ///< progress and messages
  Evaluate evaluate;  ///< solves a scene
  int status = ExitStatus::answered;
};

/// Runs the program on its words, without its own name: {"solve", "scene.json", "--json"}. Returns the exit status;
/// never throws.
int run_program(std::vector<std::string> words, Session session);

void add_solve(Command& program, Session& session);
void add_figures(Command& program, Session& session);
void add_material(Command& program, Session& session);
void add_gradient(Command& program, Session& session);
void add_sensitivity(Command& program, Session& session);
void add_plan(Command& program, Session& session);
void add_sweep(Command& program, Session& session);
void add_serve(Command& program, Session& session);
void add_optimise(Command& program, Session& session);
void add_fit(Command& program, Session& session);
void add_merge(Command& program, Session& session);
void add_status(Command& program, Session& session);
void add_slurm(Command& program, Session& session);
void add_export(Command& program, Session& session);
void add_import(Command& program, Session& session);
void add_list(Command& program, Session& session);
void add_show(Command& program, Session& session);
void add_query(Command& program, Session& session);
void add_compare(Command& program, Session& session);
void add_chart(Command& program, Session& session);
void add_report(Command& program, Session& session);
void add_accuracy(Command& program, Session& session);
void add_stability(Command& program, Session& session);
void add_verify(Command& program, Session& session);
void add_schema(Command& program, Session& session);
void add_quantities(Command& program, Session& session);
void add_manual(Command& program, Session& session);
void add_completion(Command& program, Session& session);

}  // namespace rollres
