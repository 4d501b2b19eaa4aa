#pragma once

/// The answers of a stored study along one of its axes, with their fields: what a picture shows that needs more of each
/// point than its numbers.

#include <functional>
#include <span>
#include <string_view>

#include "studies/charts/shown_study.hpp"

namespace rollres {

struct StoredLine {
  const QuantityColumn* axis = nullptr;
  std::vector<StoredEvaluation> points;  ///< converged, with fields, in the order of the axis
  std::size_t solved = 0;                ///< of these, solved again as their fields are not stored
  std::size_t left_out = 0;              ///< rows without an answer

  /// "3 scenes were solved again: ..." and "1 point has no answer ...", each a line; empty where there is nothing to
  /// say
  std::string remarks() const;
};

/// @param axis      its key; empty: the longest axis   @param picture "a film", for messages
/// @param evaluate  solves a scene whose fields are not stored
/// @param usual     the axes of which the longest is taken where none is asked for; empty: all
/// @throws std::invalid_argument naming an unknown axis, what is no axis, or another axis that has several values
StoredLine stored_line(ResultStore& store, const ShownStudy& shown, const std::vector<Filter>& filters,
                       const std::string& axis, const std::string& picture,
                       const std::function<RollingSolution(const RollingScene&)>& evaluate,
                       std::span<const std::string_view> usual = {});

}  // namespace rollres
