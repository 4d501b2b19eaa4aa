#pragma once

/// Profile likelihood: how far one parameter can go, all others following, before the misfit rises too much.
/// @see Venzon and Moolgavkar (1988), J. R. Stat. Soc. C 37, 87

#include <limits>
#include <vector>

#include "fitting/descent/descent.hpp"
#include "fitting/errors/fit_errors.hpp"

namespace rollres {

/// What is at an end of an interval.
enum class IntervalEnd {
  closed,  ///< beyond it the misfit is too large
  limit,   ///< the quantity cannot go beyond it: 0 for a friction coefficient, or the least that the drive bears
  open     ///< a bound of the fit, a factor of 1000, or points without a prediction come first
};
template <>
struct ChoiceNames<IntervalEnd> {
  static constexpr std::array<std::string_view, 3> names{"closed", "limit", "open"};
};

struct ConfidenceInterval {
  double lowest = RollingSolution::absent, highest = RollingSolution::absent;  ///< [SI]
  IntervalEnd low = IntervalEnd::open, high = IntervalEnd::open;

  bool open() const { return low == IntervalEnd::open || high == IntervalEnd::open; }
};

struct ProfilePoint {
  double value;  ///< of the parameter [SI]
  double rise;   ///< of the misfit over the scale: chi squared above its least value
};

struct Profile {
  std::vector<ProfilePoint> points;  ///< by value, the fit among them
  ConfidenceInterval interval;
  /// A point with a smaller misfit than the fit's, if one was met: then the fit was not at the least misfit.
  FitPoint better = {};
  bool complete = true;  ///< else it was given up for its cost
};

/// @param fit        a least misfit   @param slopes, errors there
/// @param threshold  the rise at the ends of the interval: 3.84 for 95 % where deviations are known
/// @param most_solutions  of the whole fit, with which the profile is given up
/// The slopes of the fit are carried on by secants (secant_slopes.hpp): a point of the profile costs one or two
/// predictions.
Profile profile(const FitProblem& problem, const Descent& fit, const Slopes& slopes, const FitErrors& errors,
                std::size_t parameter, double threshold, const std::atomic<bool>* stop = nullptr,
                std::size_t most_solutions = std::numeric_limits<std::size_t>::max());

}  // namespace rollres
