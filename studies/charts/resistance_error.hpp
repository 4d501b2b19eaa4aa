#pragma once

/// The error of a number that is drawn, as far as it comes from that of the rolling resistance.

#include <optional>

#include "studies/scene_io/formula.hpp"
#include "studies/stored/study_rows.hpp"

namespace rollres {

class ResistanceError {
 public:
  explicit ResistanceError(const QuantityColumn& column);

  /// Whether the column is the rolling resistance, its coefficient, or a study's formula of one of them.
  bool known() const { return formula_.has_value(); }
  /// What the number changes by, relative, where the rolling resistance is larger by its estimated error.
  double operator()(const StudyRows& rows, std::size_t row) const;

 private:
  std::optional<Formula> formula_;
};

}  // namespace rollres
