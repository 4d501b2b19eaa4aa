#pragma once

/// Two fits of the store beside each other: parameters with their intervals, whether they agree, and which of two
/// models of the same data is the more likely.

#include <string>
#include <vector>

#include "db/rows/fit_store.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// A parameter that both have.
struct ComparedParameter {
  FitParameterRecord first, second;
  /// The difference over the root of both errors' squares; of logarithms where both intervals are even about those. NaN
  /// where an error is not known.
  double deviations;
  double relative;  ///< difference over the first [1]

  static constexpr double most = 1.96;  ///< in 95 % of all cases, of independent data
  bool agree() const { return deviations <= most; }
};

struct StoredComparison {
  FitRecord first, second;
  std::vector<ComparedParameter> parameters;
  std::vector<std::string> only_first, only_second;  ///< fitted parameters
  bool same_data = false;                            ///< the same values with the same deviations

  /// Whether there are parameters in common and all agree.
  bool agree() const;
  /// Whether there are any, and all differ relatively by no more.
  bool within(double relative) const;
};

/// @param first, second  with their data
StoredComparison compare_fits(const FitRecord& first, const FitRecord& second);

std::string stored_comparison_summary(const StoredComparison& comparison);
Json json_of(const StoredComparison& comparison);

}  // namespace rollres
