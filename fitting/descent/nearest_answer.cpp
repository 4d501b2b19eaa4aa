#include "fitting/descent/nearest_answer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rollres {

namespace {

/// The point with the least value of a parameter with which these rows have an answer; nothing if twenty times its
/// value has none.
std::optional<FitPoint> nearest_answer(const FitProblem& problem, FitPoint point, std::size_t parameter,
                                       const DataRows& rows) {
  constexpr double fine = 1.0005;
  double& value = point[parameter];
  const auto answered = [&](double tried) {
    value = tried;
    return problem.predict(point, rows).found();
  };
  const double from = value, highest = problem.parameters[parameter].variable.highest;
  double without = from, with = 0;
  for (const double factor : {1.02, 1.1, 1.5, 4.0, 20.0}) {
    const double tried = std::min(factor * from, highest);
    if (!(tried > without)) break;
    if (answered(tried)) {
      with = tried;
      break;
    }
    without = tried;
  }
  if (!(with > without)) return std::nullopt;
  while (with > fine * without) {
    const double middle = std::sqrt(with * without);
    (answered(middle) ? with : without) = middle;
  }
  value = with;
  return point;
}

}  // namespace

FitProblem with_nearest_answers(const FitProblem& problem, const std::vector<std::size_t>& held) {
  for (std::size_t j = 0; j < problem.size(); ++j) {
    if (!problem.parameters[j].has_least || contains(held, j)) continue;
    FitProblem answered = problem;
    answered.model.predict = [problem, j](const FitPoint& point, const DataRows& rows) {
      Prediction prediction = problem.predict(point, rows);
      DataRows without;
      for (Eigen::Index i = 0; i < prediction.values.size(); ++i)
        if (!std::isfinite(prediction.values[i])) without.push_back(static_cast<std::size_t>(i));
      if (prediction.found() || without.empty() || !rows.empty() || problem.ending->over()) return prediction;
      const std::optional<FitPoint> nearest = nearest_answer(problem, point, j, without);
      if (!nearest) return prediction;
      Prediction there = problem.predict(*nearest);
      if (!there.found()) return prediction;
      there.taken_at = *nearest;
      return there;
    };
    return answered;
  }
  return problem;
}

}  // namespace rollres
