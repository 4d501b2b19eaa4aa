#pragma once

/// How an input scatters: distributions of one number, by their quantiles.
///
///     normal       mean, standard deviation
///     lognormal    median m > 0, standard deviation s of ln x: about the share s of m for small s
///     uniform      lowest, highest
///     loguniform   lowest, highest > 0: uniform in ln x
///     triangular   lowest, most probable, highest value
///
/// Densities and quantiles are those of Boost.Math. A distribution may be cut off at two ends; what is between them
/// then has all the weight.

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/quantity.hpp"

namespace rollres {

enum class DistributionKind { normal, lognormal, uniform, loguniform, triangular };
template <>
struct ChoiceNames<DistributionKind> {
  static constexpr std::array<std::string_view, 5> names{"normal", "lognormal", "uniform", "loguniform", "triangular"};
};

struct Distribution {
  DistributionKind kind = DistributionKind::normal;
  std::vector<double> parameters;                            ///< as above, in their order [SI; of ln x: 1]
  double lowest = -std::numeric_limits<double>::infinity();  ///< cut off below
  double highest = std::numeric_limits<double>::infinity();  ///< cut off above
};

/// What is wrong with the parameters, "the standard deviation must be > 0"; empty if nothing is.
std::string broken_rule(const Distribution& distribution);

/// Probability of a value below x, and above it, before anything is cut off.
double weight_below(const Distribution& distribution, double x);
double weight_above(const Distribution& distribution, double x);

/// The x with a weight of `probability` below it, 0 < probability < 1, of what is left between the ends.
double quantile(const Distribution& distribution, double probability);

/// The weight that lies outside a range [1].
double weight_outside(const Distribution& distribution, const Range& range);

/// The same distribution cut off at the ends of a range.
Distribution cut_off(Distribution distribution, const Range& range);

/// The distribution of `factor` times the number, factor > 0.
Distribution times(Distribution distribution, double factor);

/// "normal, mean 3 MPa, standard deviation 300 kPa".
std::string in_words(const Distribution& distribution, std::string_view unit);

}  // namespace rollres
