#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "studies/program/commands.hpp"

/// What one run of the program left behind.
struct ProgramRun {
  int status;
  std::string out, err;
};

inline ProgramRun run_rollres(const std::vector<std::string>& words, const rollres::Evaluate& evaluate) {
  std::ostringstream out, err;
  const int status = rollres::run_program(words, {out, err, evaluate});
  return {status, out.str(), err.str()};
}
