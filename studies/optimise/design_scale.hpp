#pragma once

/// A design problem as a search sees it: variables in the unit box, least values, constraints c <= 0.
///
/// Along each side of the box the scaled variable (the logarithm, or the value) runs evenly from one bound to the
/// other. Values that are positive are taken in their logarithm, for rolling resistances and pressures follow power
/// laws nearly: in these terms both the goal and the constraints are almost linear, all slopes are of the order of 1,
/// and so are the multipliers of the constraints, whatever the units.

#include <span>
#include <vector>

#include "studies/optimise/design.hpp"

namespace rollres {

/// The values of the variables at a place in the unit box [SI]; places outside are moved to its sides.
std::vector<double> point_in_box(const DesignProblem& problem, std::span<const double> place);

class DesignScale {
 public:
  /// @param reference  a design with a value: it tells which quantities are positive, and the size of the others
  DesignScale(const DesignProblem& problem, const Design& reference);

  std::size_t size() const { return problem_.variables.size(); }
  std::vector<double> to_box(std::span<const double> point) const;
  std::vector<double> from_box(std::span<const double> place) const { return point_in_box(problem_, place); }
  /// d value / d place of one variable [SI].
  double slope(std::size_t variable, double value) const;

  /// To be minimised [1]: +-ln(value / reference), or +-value / |reference|.
  double value(const Design& design) const;
  /// At most 0 where they hold [1]: +-ln(left / right), or +-(left - right) over their size.
  std::vector<double> constraints(const Design& design) const;

 private:
  struct Side {
    bool logarithmic;
    double size;  // [unit of the left side]
  };

  const DesignProblem& problem_;
  Side value_side_;
  std::vector<Side> constraint_sides_;
};

}  // namespace rollres
