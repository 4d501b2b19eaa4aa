#pragma once

/// What a database knows of points.

#include <span>
#include <string>
#include <vector>

#include "db/file/database.hpp"

namespace rollres {

enum class Answer { missing, failed, converged };

struct PointState {
  Answer answer = Answer::missing;
  double seconds = 0;  ///< that its solution took
};

/// The state of the evaluation of each key.
/// @throws std::runtime_error naming the file if the database fails
std::vector<PointState> point_states(const Database& database, std::span<const std::string> keys);

}  // namespace rollres
