#include "studies/scatter/surrogate_statistics.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>

#include "fitting/errors/statistics.hpp"

namespace rollres {

namespace {

constexpr double two_sided = 1.96;

/// A polynomial, and what it is at the wanted points when all batches, or all but one, are fitted.
class Surrogate {
 public:
  Surrogate(const SurrogatePoints& points, const ScatterBatches& batches, const Eigen::VectorXd& values)
      : chaos_(points.fitted, values), count_(values.size()), batches_(batches.size()) {
    const Eigen::MatrixXd wanted = chaos_.terms_at(points.wanted);
    const Eigen::VectorXd all = wanted * chaos_.coefficients();
    whole_ = sorted(all);
    const Eigen::Index each = all.size() / static_cast<Eigen::Index>(points.wanted_batches);
    for (std::size_t i = 0; i < points.wanted_batches; ++i)
      sections_.push_back(sorted(all.segment(static_cast<Eigen::Index>(i) * each, each)));
    const Eigen::MatrixXd terms = chaos_.terms_at(points.fitted.points);
    Eigen::Index begin = 0;
    for (const std::vector<double>& batch : batches) {
      const auto size = static_cast<Eigen::Index>(batch.size()), after = count_ - begin - size;
      Eigen::MatrixXd others(count_ - size, terms.cols());
      Eigen::VectorXd known(count_ - size);
      others << terms.topRows(begin), terms.bottomRows(after);
      known << values.head(begin), values.tail(after);
      parts_.push_back(sorted(wanted * others.colPivHouseholderQr().solve(known)));
      begin += size;
    }
  }

  const PolynomialChaos& chaos() const { return chaos_; }

  /// @param missed  what the polynomial misses the number by
  ScatterEstimate estimate(const std::function<double(const std::vector<double>&)>& number, double missed) const {
    ScatterEstimate found{number(whole_), 0};
    const auto apart = [&](const std::vector<std::vector<double>>& lists) {
      double squares = 0;
      for (const std::vector<double>& list : lists) squares += std::pow(number(list) - found.value, 2);
      return squares;
    };
    const auto b = static_cast<double>(batches_), k = static_cast<double>(sections_.size());
    const double fitted =
        two_sided_quantile(0.95, static_cast<int>(batches_) - 1) * std::sqrt((b - 1) / b * apart(parts_));
    const double sampled =
        two_sided_quantile(0.95, static_cast<int>(sections_.size()) - 1) * std::sqrt(apart(sections_) / (k - 1) / k);
    found.error = std::hypot(fitted, sampled) + missed;
    return found;
  }

 private:
  static std::vector<double> sorted(const Eigen::VectorXd& values) {
    std::vector<double> list(values.begin(), values.end());
    std::sort(list.begin(), list.end());
    return list;
  }

  PolynomialChaos chaos_;
  Eigen::Index count_;
  std::size_t batches_;
  std::vector<double> whole_;
  std::vector<std::vector<double>> parts_, sections_;
};

std::optional<Eigen::VectorXd> all_values(const SurrogatePoints& points, const ScatterBatches& batches) {
  std::vector<double> values;
  for (const std::vector<double>& batch : batches) values.insert(values.end(), batch.begin(), batch.end());
  const bool whole = std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  constexpr std::size_t fewest = 16, fewest_batches = 3;
  if (!whole || values.size() < fewest || batches.size() < fewest_batches ||
      static_cast<Eigen::Index>(values.size()) != points.fitted.points.rows())
    return std::nullopt;
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  if (*least == *greatest) return std::nullopt;
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Share of sorted values up to a limit.
double share_up_to(const std::vector<double>& sorted, double limit) {
  const auto below = std::upper_bound(sorted.begin(), sorted.end(), limit) - sorted.begin();
  return static_cast<double>(below) / static_cast<double>(sorted.size());
}

}  // namespace

std::optional<SurrogateStatistics> surrogate_statistics(const SurrogatePoints& points, const ScatterBatches& batches,
                                                        const std::vector<double>& probabilities) {
  const auto values = all_values(points, batches);
  if (!values) return std::nullopt;
  const Surrogate surrogate(points, batches, *values);
  const double missed = surrogate.chaos().error();
  SurrogateStatistics found{.quantiles = {}};
  found.mean = surrogate.estimate(mean_value, two_sided * missed / std::sqrt(static_cast<double>(values->size())));
  found.deviation = surrogate.estimate(deviation_of, missed);
  for (const double probability : probabilities)
    found.quantiles.push_back(
        surrogate.estimate([&](const std::vector<double>& sorted) { return quantile_of_sorted(sorted, probability); },
                           two_sided * missed));
  found.error = missed / found.deviation.value;
  found.degree = surrogate.chaos().degree();
  found.terms = surrogate.chaos().terms();
  return found;
}

std::optional<ScatterEstimate> surrogate_probability(const SurrogatePoints& points, const ScatterBatches& batches) {
  const auto values = all_values(points, batches);
  if (!values) return std::nullopt;
  const Surrogate surrogate(points, batches, *values);
  const double near = two_sided * surrogate.chaos().error();
  const auto at_most = [](double limit) {
    return [limit](const std::vector<double>& sorted) { return share_up_to(sorted, limit); };
  };
  ScatterEstimate found = surrogate.estimate(at_most(0), 0);
  found.error += std::max(surrogate.estimate(at_most(near), 0).value - found.value,
                          found.value - surrogate.estimate(at_most(-near), 0).value);
  return found;
}

bool is_surer(const SurrogateStatistics& surrogate, const ScatterStatistics& sampled) {
  const auto surer = [](const ScatterEstimate& a, const ScatterEstimate& b) { return a.error < b.error; };
  return surer(surrogate.mean, sampled.mean) && surer(surrogate.deviation, sampled.deviation) &&
         std::equal(surrogate.quantiles.begin(), surrogate.quantiles.end(), sampled.quantiles.begin(),
                    sampled.quantiles.end(), surer);
}

}  // namespace rollres
