#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "db/rows/result_store.hpp"

namespace rollres {

/// A program on a machine, and what of a study it computed.
struct ComputedShare {
  Provenance program;
  std::int64_t points = 0;
  double seconds = 0;       ///< of its solutions, together
  std::string first, last;  ///< when it stored its first and its last result, UTC
};

/// In the order in which the database came to know them.
/// @throws std::runtime_error naming the file if the database fails
std::vector<ComputedShare> computed_shares(ResultStore& store, const std::string& study);

}  // namespace rollres
