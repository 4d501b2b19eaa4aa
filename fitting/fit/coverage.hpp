#pragma once

/// Whether the intervals of a fit are true: data are drawn anew around its predictions, fitted, and the intervals that
/// hold the known parameters counted.

#include <cstdint>
#include <functional>
#include <vector>

#include "fitting/fit/fit.hpp"

namespace rollres {

struct CoverageOptions {
  int draws = 200;
  std::uint64_t seed = 1;
  int jobs = 0;           ///< threads, each with a draw of its own; 0: one for each core
  bool profiles = false;  ///< also count the intervals by profile likelihood
  const std::atomic<bool>* stop = nullptr;
  /// How drawn data are fitted where that is more than `fit`: with their noise. Called by several threads at once.
  std::function<FitReport(const FitProblem&, const FitOptions&)> fit = {};
  std::function<void(int)> report = {};  ///< after each draw, with how many there were; never by two threads at once
};

/// Counts for one parameter.
struct ParameterCoverage {
  std::string name;
  double truth;    ///< [SI]
  int linear = 0;  ///< intervals that hold it
  int profile = 0;
  double mean_offset = 0;     ///< of the scaled value from the truth, in its standard error: its mean over the draws
  double offset_scatter = 0;  ///< and its standard deviation, 1 if the standard errors are true
};

struct Coverage {
  int draws = 0, fitted = 0;  ///< fitted: with a least misfit (GOOD, USABLE WITH WARNINGS or NOT IDENTIFIED)
  std::uint64_t seed = 0;
  bool profiles = false;
  std::vector<ParameterCoverage> parameters = {};
  std::vector<std::string> failures = {};  ///< reasons of the others, those that differ
};

/// @param truth  the parameters that the data are drawn around
/// Errors are normal with the deviations of the data, times `scatter`: the root of the reduced chi squared where
/// deviations are not known. The model's predict and differentiate are called by several threads at once.
/// @throws std::invalid_argument if there is no prediction at the truth
Coverage coverage(const FitProblem& problem, const FitPoint& truth, double scatter,
                  const CoverageOptions& options = {});

}  // namespace rollres
