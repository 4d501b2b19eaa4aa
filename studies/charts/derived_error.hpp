#pragma once

/// The error of a number that a study derives by a formula, as far as it comes from that of the rolling resistance.

#include <optional>

#include "studies/scene_io/formula.hpp"
#include "studies/stored/study_rows.hpp"

namespace rollres {

class DerivedError {
 public:
  /// Of a column of the store: none.
  explicit DerivedError(const QuantityColumn& column);

  /// Whether the column is a formula that has the rolling resistance in it.
  bool any() const { return formula_.has_value(); }
  /// What it changes by, relative, where the rolling resistance is larger by its estimated error.
  double operator()(const StudyRows& rows, std::size_t row) const;

 private:
  std::optional<Formula> formula_;
};

}  // namespace rollres
