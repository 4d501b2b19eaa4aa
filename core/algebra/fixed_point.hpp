#pragma once

/// Where a map of few unknowns stays, x = f(x), with few evaluations.
///
/// Anderson's mixing first (Anderson 1965; Walker and Ni 2011, SIAM Journal on Numerical Analysis 49): of the last
/// steps the combination whose differences f(x) - x leave least is taken. Where these do not fall any more, Newton's
/// method with differences goes on from the least, with steps halved until they do; likewise where the map has no
/// value.

#include <Eigen/Core>
#include <functional>
#include <optional>

namespace rollres {

struct FixedPointProblem {
  std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd&)> map;  ///< nothing: there is no value
  std::function<bool(const Eigen::VectorXd&, const Eigen::VectorXd&)> near;   ///< whether x and f(x) are one
  double difference = 0;                                                      ///< of x, for slopes
  int most_evaluations = 0;
};

/// @return the x of the last evaluation: the one that was near, or that which missed least; nothing where the map has
/// no value at the start
std::optional<Eigen::VectorXd> fixed_point(const FixedPointProblem& problem, const Eigen::VectorXd& start);

}  // namespace rollres
