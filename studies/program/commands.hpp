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
#include "studies/program/command_line.hpp"

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

/// Each declares the words of one command on the program, and what it does.
using AddCommand = void(Command& program, Session& session);
AddCommand add_new, add_solve, add_draw, add_characteristic, add_film, add_figures, add_material, add_gradient,
    add_sensitivity, add_plan, add_sweep, add_scatter, add_serve, add_explore, add_optimise, add_fit, add_merge,
    add_status, add_slurm, add_export, add_import, add_list, add_show, add_query, add_compare, add_chart, add_report,
    add_accuracy, add_stability, add_verify, add_schema, add_quantities, add_manual, add_completion,
    add_upkeep;  // rename, delete, note, prune

}  // namespace rollres
