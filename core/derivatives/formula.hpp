#pragma once

/// Difference formulas of a first derivative, and what they err by.
///
/// A formula with weights w_j at the offsets o_j errs by the noise, of deviation sigma |w|, and by truncation, at most
/// sum_k |sum_j w_j o_j^k| |f^(k)| / k!.

#include <array>
#include <limits>
#include <string_view>
#include <vector>

#include "core/scene/quantity.hpp"

namespace rollres {

/// Where the points of a formula lie; those of `forward` and `backward` begin in the centre.
enum class Scheme { central, forward, backward, none };
template <>
struct ChoiceNames<Scheme> {
  static constexpr std::array<std::string_view, 4> names{"central", "forward", "backward", "none"};
};

/// What is known of a function beside a point.
struct FunctionSize {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  double noise = unknown;  ///< standard deviation
  /// Bounds of |f''|, |f'''|, |f''''| and |f^(5)|.
  std::array<double, 4> derivatives{unknown, unknown, unknown, unknown};
  double reach = std::numeric_limits<double>::infinity();  ///< distance from the point up to which this is known
};

struct FormulaError {
  double truncation = 0, noise = 0;  ///< the noise's standard deviation
};

/// What a formula errs by, over the noise and over the derivatives of a function.
class FormulaSize {
 public:
  FormulaSize(const std::vector<double>& weights, const std::vector<double>& offsets);

  /// Of the formula with all offsets multiplied by `step`.
  FormulaError error(double step, const FunctionSize& known) const;

 private:
  double norm_ = 0;                  // |w|
  std::array<double, 4> moments_{};  // |sum_j w_j o_j^k| / k!, k = 2 to 5
};

/// Offsets in units of the step; none: there is no such formula. @param order of the truncation error: 1, 2 or 4
std::vector<double> offsets_of(Scheme scheme, int order);

struct DifferenceFormula {
  Scheme scheme = Scheme::none;
  double step = 0;
  double expected_error = 0;
};

/// Formulas whose points lie within the room on either side and within `known.reach`, with steps up to `limit`, each
/// with the step of the smallest error, the best formula first. Where nothing is known that step is the largest.
std::vector<DifferenceFormula> formulas(int order, const FunctionSize& known, double limit, double room_below,
                                        double room_above);

}  // namespace rollres
