#pragma once

/// How far a study is, in one or several databases.

#include <cstddef>
#include <filesystem>
#include <limits>
#include <span>
#include <vector>

#include "studies/study/study.hpp"

namespace rollres {

struct StudyStatus {
  std::size_t points = 0;
  std::size_t converged = 0;
  std::size_t failed = 0;   ///< answered, but without a solution
  std::size_t missing = 0;  ///< not answered
  /// Of one core, for what is missing: predicted_seconds, scaled by what the answered points took; NaN: not predicted.
  double seconds_left = std::numeric_limits<double>::quiet_NaN();
  std::vector<int> shards_missing{};  ///< shards with a missing point, from 1
};

/// A point is what the best of the databases says it is.
/// @throws std::runtime_error naming the database that fails
StudyStatus study_status(const Study& study, std::span<const std::filesystem::path> databases, int shards);

}  // namespace rollres
