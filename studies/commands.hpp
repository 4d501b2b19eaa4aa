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

#include "core/rolling_contact.hpp"

namespace CLI {
class App;
}

namespace rollres {

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

void add_solve(CLI::App& program, Session& session);
void add_material(CLI::App& program, Session& session);
void add_gradient(CLI::App& program, Session& session);
void add_sensitivity(CLI::App& program, Session& session);
void add_plan(CLI::App& program, Session& session);
void add_sweep(CLI::App& program, Session& session);
void add_optimise(CLI::App& program, Session& session);
void add_fit(CLI::App& program, Session& session);
void add_merge(CLI::App& program, Session& session);
void add_status(CLI::App& program, Session& session);
void add_slurm(CLI::App& program, Session& session);
void add_export(CLI::App& program, Session& session);
void add_import(CLI::App& program, Session& session);
void add_list(CLI::App& program, Session& session);
void add_show(CLI::App& program, Session& session);
void add_query(CLI::App& program, Session& session);
void add_compare(CLI::App& program, Session& session);
void add_chart(CLI::App& program, Session& session);
void add_accuracy(CLI::App& program, Session& session);
void add_stability(CLI::App& program, Session& session);
void add_schema(CLI::App& program, Session& session);
void add_quantities(CLI::App& program, Session& session);

}  // namespace rollres
