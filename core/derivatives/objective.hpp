#pragma once

/// An objective: named inputs of a scene -> one of its named outputs, for gradients, fits and optimisers.
///
/// A point is the list of the inputs' values in SI units. Steps are taken in scaled variables, in which a change by 1
/// is a large one: ln x for quantities that cannot be zero, x over its size for the others (fits have a third).

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/solve/rolling_contact.hpp"

namespace rollres {

/// An input that varies, as a caller names it; what is left out follows from the quantity.
struct InputChoice {
  std::string key;
  std::optional<double> lowest = {}, highest = {};  ///< bounds [SI]; default: the quantity's range
  std::optional<bool> logarithmic = {};             ///< default: if it has a unit, or must be positive, and is not zero
};

/// The scaled variable of a value x.
enum class Scaling {
  linear,       ///< x / size
  logarithmic,  ///< ln x
  reciprocal    ///< -size / x, in which what saturates is nearly a straight line
};
template <>
struct ChoiceNames<Scaling> {
  static constexpr std::array<std::string_view, 3> names{"linear", "logarithmic", "reciprocal"};
};

/// An input that varies.
struct Variable {
  Quantity quantity;
  double lowest, highest;  ///< values from lowest to highest [SI] are allowed, both included
  Scaling scaling;
  double size;                            ///< [SI] the base scene's value, or a natural unit where that is zero
  std::optional<double> own_length = {};  ///< [SI] over which answers change, where that is no change of `scaled` by 1

  double scaled(double value) const;
  double value(double scaled) const;
  /// scaled(value) - scaled(from), without cancellation.
  double scaled_step(double from, double value) const;
  /// d value / d scaled [SI].
  double slope(double value) const;
};

struct Objective {
  RollingScene base;
  std::vector<Variable> variables;
  Quantity output;
  Evaluate evaluate;  ///< called by several threads at once where a function is given several jobs
  /// What is wanted of a scene that is no output of its solution, as a modulus of its material: then nothing is solved.
  std::function<double(const RollingScene&)> value_of = {};
};

/// @param inputs  keys of inputs that are real numbers and present in `base`
/// @param output  key of an output that is a real number
/// @throws std::invalid_argument naming key, value and rule
Objective objective(const RollingScene& base, const std::vector<InputChoice>& inputs, std::string_view output,
                    Evaluate evaluate);

/// The inputs that vary, for a scene. @throws std::invalid_argument naming key, value and rule
std::vector<Variable> variables_of(const RollingScene& base, const std::vector<InputChoice>& inputs);

/// The output with this key. @throws std::invalid_argument if there is none that is a real number
Quantity real_output(std::string_view key);

/// An input of a scene that is a real number [SI]; NaN if it is absent, or none. And gives it a value.
double real_input(const RollingScene& scene, std::string_view key);
void assign_real(RollingScene& scene, std::string_view key, double number);

/// The base scene's values of the inputs that vary [SI].
std::vector<double> base_point(const Objective& objective);

/// The base scene with the values of `point` [SI].
RollingScene scene_at(const Objective& objective, std::span<const double> point);

/// @throws std::invalid_argument naming the first value outside its bounds
void require_inside(const Objective& objective, std::span<const double> point);

/// The output at one point, or why there is none.
struct ObjectiveValue {
  double value = RollingSolution::absent;  ///< [SI]; NaN without an answer
  double relative_error = 0;               ///< as the solution estimates it of its rolling resistance [1]
  Status status = Status::not_converged;
  std::string reason = {};  ///< empty for an answer

  bool found() const { return reason.empty() && status == Status::converged; }
};

/// Evaluates one point. A scene that breaks a rule (std::invalid_argument of `evaluate`) and an output that the answer
/// lacks are failures with a reason; other exceptions are left to the caller.
ObjectiveValue value_at(const Objective& objective, std::span<const double> point);

/// A point at which the objective has no value.
struct FailedPoint {
  double value;  ///< of the input that was changed [SI]
  Status status;
  std::string reason;
};

/// An objective along one of its inputs, the others fixed: evaluates points at distances from a centre inside the
/// bounds, in units of the variable's own length, and keeps count.
class SampledLine {
 public:
  struct Sample {
    double offset;  ///< distance from the centre, as the rounded input has it
    double value;
    double relative_error = 0;  ///< of ObjectiveValue
  };

  /// @param objective must outlive the line
  /// @param centre    the objective at `point`
  SampledLine(const Objective& objective, std::span<const double> point, std::size_t input,
              const ObjectiveValue& centre)
      : objective_(objective),
        point_(point.begin(), point.end()),
        input_(input),
        centre_(centre.value),
        centre_error_(centre.relative_error) {
    if (const auto own = variable().own_length) length_ = *own / variable().slope(centre_input());
  }

  const Variable& variable() const { return objective_.variables[input_]; }
  std::string_view output() const { return objective_.output.key; }
  double centre_input() const { return point_[input_]; }  ///< [SI]
  double centre_value() const { return centre_; }
  double centre_error() const { return centre_error_; }  ///< relative, of ObjectiveValue
  /// Whether a sample is known so much worse than the centre that their difference may be that of two methods.
  bool is_poor(const Sample& sample) const {
    constexpr double ratio = 30, least = 1e-6;
    return centre_error_ > 0 && sample.relative_error > std::max(least, ratio * centre_error_);
  }
  /// Distance from the centre to the lower bound, and to the upper.
  double room_below() const { return -distance_to(variable().lowest); }
  double room_above() const { return distance_to(variable().highest); }
  /// d input / d distance [SI].
  double slope() const { return variable().slope(centre_input()) * length_; }
  /// The unit of distance [scaled].
  double length() const { return length_; }

  /// The value at an offset inside the room, or nothing: then the failure is kept.
  std::optional<Sample> at(double offset);

  int evaluations() const { return evaluations_; }
  const std::vector<FailedPoint>& failures() const { return failures_; }

 private:
  double distance_to(double value) const { return variable().scaled_step(centre_input(), value) / length_; }

  const Objective& objective_;
  std::vector<double> point_;
  std::size_t input_;
  double centre_, centre_error_;
  double length_ = 1;
  int evaluations_ = 0;
  std::vector<FailedPoint> failures_;
  std::map<double, std::optional<Sample>> known_;  // by offset
};

}  // namespace rollres
