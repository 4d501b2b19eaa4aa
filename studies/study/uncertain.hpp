#pragma once

/// Inputs that scatter, and the points that stand for them.

#include <cstdint>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "studies/scatter/correlation.hpp"
#include "studies/scatter/distribution.hpp"
#include "studies/scene_io/formula.hpp"
#include "studies/study/sampling.hpp"

namespace rollres {

/// Weight outside an input's range that no number of points ever meets.
inline constexpr double negligible_weight = 1e-9;

/// An input that scatters.
struct UncertainInput {
  std::string key;
  Distribution distribution;  ///< of the input [SI], or of its ratio to `about` [1]
  bool relative = false;      ///< scatters about a value that it has otherwise
  double about = 1;           ///< that value [SI], where it is known
  bool truncated = false;     ///< at the ends of the input's range

  /// The distribution of the input [SI] where it has this value otherwise, cut off at the ends of its range.
  Distribution around(double value) const;
  Distribution own() const { return around(about); }
};

struct UncertainInputs {
  std::vector<UncertainInput> inputs = {};
  std::vector<CorrelatedPair> correlations = {};
  SampleMethod method = SampleMethod::sobol;
  std::size_t points = 512;     ///< all together, a multiple of the scramblings
  std::size_t scramblings = 8;  ///< parts that are independent of each other
  std::uint64_t seed = 1;
  std::vector<Condition> probabilities = {};  ///< whose probability is wanted

  bool any() const { return !inputs.empty(); }
  std::size_t points_of_each() const { return points / scramblings; }
};

/// Probabilities of the inputs at the points, correlated: one list for each input, scrambling after scrambling.
/// quantile() makes values of them.
std::vector<std::vector<double>> uncertain_points(const UncertainInputs& uncertain);

/// Each input's distribution as a line: "creep_time: lognormal, median 250 ms, ...", and what correlates.
std::vector<std::string> in_words(const UncertainInputs& uncertain, Body body);

}  // namespace rollres
