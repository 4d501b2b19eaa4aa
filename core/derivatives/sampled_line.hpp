#pragma once

/// An objective along one of its inputs, the others fixed.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/derivatives/objective.hpp"

namespace rollres {

/// A point at which the objective has no value.
struct FailedPoint {
  double value;  ///< of the input that was changed [SI]
  Status status;
  std::string reason;
};

/// Evaluates points at scaled distances from a centre inside the bounds, and keeps count.
class SampledLine {
 public:
  struct Sample {
    double offset;  ///< distance from the centre in the scaled variable, as the rounded input has it
    double value;
  };

  /// @param objective must outlive the line
  /// @param centre    the objective's value at `point`
  SampledLine(const Objective& objective, std::span<const double> point, std::size_t input, double centre)
      : objective_(objective), point_(point.begin(), point.end()), input_(input), centre_(centre) {}

  const Variable& variable() const { return objective_.variables[input_]; }
  double centre_input() const { return point_[input_]; }  ///< [SI]
  double centre_value() const { return centre_; }
  /// Scaled distance from the centre to the lower bound, and to the upper.
  double room_below() const { return -variable().scaled_step(centre_input(), variable().lowest); }
  double room_above() const { return variable().scaled_step(centre_input(), variable().highest); }

  /// The value at an offset inside the room, or nothing: then the failure is kept.
  std::optional<Sample> at(double offset);

  int evaluations() const { return evaluations_; }
  const std::vector<FailedPoint>& failures() const { return failures_; }

 private:
  const Objective& objective_;
  std::vector<double> point_;
  std::size_t input_;
  double centre_;
  int evaluations_ = 0;
  std::vector<FailedPoint> failures_;
};

}  // namespace rollres
