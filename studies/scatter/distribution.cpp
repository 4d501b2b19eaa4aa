#include "studies/scatter/distribution.hpp"

#include <algorithm>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/triangular.hpp>
#include <boost/math/distributions/uniform.hpp>
#include <cmath>

#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

/// Calls `function` with the distribution of Boost; one that is uniform in ln x as such, and true.
template <class Function>
double with_boost(const Distribution& distribution, Function function) {
  const std::vector<double>& p = distribution.parameters;
  switch (distribution.kind) {
    case DistributionKind::normal:
      return function(boost::math::normal(p[0], p[1]), false);
    case DistributionKind::lognormal:
      return function(boost::math::normal(std::log(p[0]), p[1]), true);
    case DistributionKind::uniform:
      return function(boost::math::uniform(p[0], p[1]), false);
    case DistributionKind::loguniform:
      return function(boost::math::uniform(std::log(p[0]), std::log(p[1])), true);
    case DistributionKind::triangular:
      break;
  }
  return function(boost::math::triangular(p[0], p[1], p[2]), false);
}

bool below_zero(bool of_logarithm, double x) { return of_logarithm && x <= 0; }

}  // namespace

std::string broken_rule(const Distribution& distribution) {
  const std::vector<double>& p = distribution.parameters;
  if (!all_of(p, [](double number) { return std::isfinite(number); })) return "its numbers must be finite";
  switch (distribution.kind) {
    case DistributionKind::normal:
      return p[1] > 0 ? "" : "the standard deviation must be > 0";
    case DistributionKind::lognormal:
      if (!(p[0] > 0)) return "the median must be > 0";
      return p[1] > 0 ? "" : "the standard deviation of the logarithm must be > 0";
    case DistributionKind::uniform:
      return p[0] < p[1] ? "" : "the second number must be larger than the first";
    case DistributionKind::loguniform:
      if (!(p[0] > 0)) return "both numbers must be > 0";
      return p[0] < p[1] ? "" : "the second number must be larger than the first";
    case DistributionKind::triangular:
      return p[0] <= p[1] && p[1] <= p[2] && p[0] < p[2] ? "" : "its numbers must rise: lowest, most probable, highest";
  }
  return {};
}

double weight_below(const Distribution& distribution, double x) {
  if (std::isinf(x)) return x > 0 ? 1 : 0;
  return with_boost(distribution, [&](const auto& known, bool of_logarithm) {
    return below_zero(of_logarithm, x) ? 0 : boost::math::cdf(known, of_logarithm ? std::log(x) : x);
  });
}

double weight_above(const Distribution& distribution, double x) {
  if (std::isinf(x)) return x > 0 ? 0 : 1;
  return with_boost(distribution, [&](const auto& known, bool of_logarithm) {
    if (below_zero(of_logarithm, x)) return 1.0;
    return boost::math::cdf(boost::math::complement(known, of_logarithm ? std::log(x) : x));
  });
}

double quantile(const Distribution& distribution, double probability) {
  const double below = weight_below(distribution, distribution.lowest),
               above = weight_above(distribution, distribution.highest);
  // The tail that is nearer is the one whose weight is known to all digits.
  const double left = 1 - below - above, from_below = below + probability * left,
               from_above = above + (1 - probability) * left;
  const double found = with_boost(distribution, [&](const auto& known, bool of_logarithm) {
    const double x = from_below <= from_above ? boost::math::quantile(known, from_below)
                                              : boost::math::quantile(boost::math::complement(known, from_above));
    return of_logarithm ? std::exp(x) : x;
  });
  return std::clamp(found, distribution.lowest, distribution.highest);
}

double weight_outside(const Distribution& distribution, const Range& range) {
  return weight_below(distribution, range.lowest) + weight_above(distribution, range.highest);
}

Distribution cut_off(Distribution distribution, const Range& range) {
  distribution.lowest = std::max(distribution.lowest, range.lowest);
  distribution.highest = std::min(distribution.highest, range.highest);
  return distribution;
}

Distribution times(Distribution distribution, double factor) {
  distribution.parameters[0] *= factor;
  if (distribution.kind != DistributionKind::lognormal)
    for (std::size_t i = 1; i < distribution.parameters.size(); ++i) distribution.parameters[i] *= factor;
  distribution.lowest *= factor;
  distribution.highest *= factor;
  return distribution;
}

std::string in_words(const Distribution& distribution, std::string_view unit) {
  const std::vector<double>& p = distribution.parameters;
  const std::string name(name_of(distribution.kind));
  const auto shown = [&](std::size_t i) { return readable(p[i], unit); };
  switch (distribution.kind) {
    case DistributionKind::normal:
      return name + ", mean " + shown(0) + ", standard deviation " + shown(1);
    case DistributionKind::lognormal:
      return name + ", median " + shown(0) + ", standard deviation of the logarithm " + short_number(p[1], 5);
    case DistributionKind::uniform:
    case DistributionKind::loguniform:
      return name + " from " + shown(0) + " to " + shown(1);
    case DistributionKind::triangular:
      break;
  }
  return name + " from " + shown(0) + " to " + shown(2) + ", most probable " + shown(1);
}

}  // namespace rollres
