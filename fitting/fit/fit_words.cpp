#include "fitting/fit/fit_words.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace rollres {

namespace {

/// Parameters with a share in the weakest direction, the largest first.
std::vector<std::size_t> sharers(const FitErrors& errors) {
  constexpr double small = 0.25;
  std::vector<std::size_t> found;
  const double largest = errors.weakest.cwiseAbs().maxCoeff();
  for (Eigen::Index j = 0; j < errors.weakest.size(); ++j)
    if (std::abs(errors.weakest[j]) > small * largest) found.push_back(static_cast<std::size_t>(j));
  std::stable_sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(errors.weakest[static_cast<Eigen::Index>(a)]) >
           std::abs(errors.weakest[static_cast<Eigen::Index>(b)]);
  });
  return found;
}

}  // namespace

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string weakest_parameters(const FitProblem& problem, const FitErrors& errors) {
  const std::vector<std::size_t> names = sharers(errors);
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + problem.parameters[names[k]].name;
  return text;
}

std::string weakest_direction_in_words(const FitProblem& problem, const FitErrors& errors) {
  const std::vector<std::size_t> names = sharers(errors);
  if (names.empty()) return "";
  if (!std::isfinite(errors.weakest_deviation))
    return weakest_parameters(problem, errors) + (names.size() > 1 ? " change together" : " changes") +
           " without any effect on the predictions";
  const double sign = errors.weakest[static_cast<Eigen::Index>(names.front())] < 0 ? -1 : 1;
  std::string text;
  for (const std::size_t j : names) {
    const Variable& variable = problem.parameters[j].variable;
    const double moved = sign * errors.weakest[static_cast<Eigen::Index>(j)] * errors.weakest_deviation;
    text += (text.empty() ? "" : " with ") + problem.parameters[j].name;
    text += variable.logarithmic ? " x " + rounded(std::exp(moved))
                                 : (moved < 0 ? " - " : " + ") + rounded(std::abs(moved) * variable.size);
  }
  return text + " is within one standard deviation";
}

}  // namespace rollres
