#include "fitting/material/even_series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "core/algebra/dense_algebra.hpp"
#include "fitting/material/material_fit.hpp"

namespace rollres {

namespace {

struct Span {
  double lowest = std::numeric_limits<double>::infinity(), highest = 0;  // reduced angular frequencies
};

Span reduced_frequencies(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift) {
  Span span;
  const ShiftFactors factors(shift);
  for (const MeasuredModulus& row : data) {
    const double omega = row.angular_frequency * factors.time(row.temperature);
    span.lowest = std::min(span.lowest, omega);
    span.highest = std::max(span.highest, omega);
  }
  return span;
}

}  // namespace

int EvenSeries::moduli() const { return static_cast<int>(series.terms.size()) + (series.static_modulus > 0 ? 1 : 0); }

std::vector<double> even_times(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift, int times,
                               double beyond) {
  Span span = reduced_frequencies(data, shift);
  span.lowest *= std::pow(10, -beyond);
  span.highest *= std::pow(10, beyond);
  std::vector<double> all;
  for (int j = times - 1; j >= 0; --j)
    all.push_back(std::pow(span.lowest / span.highest, (j + 0.5) / times) / span.lowest);
  return all;
}

Eigen::VectorXd measured_values(const std::vector<MeasuredModulus>& data) {
  Eigen::VectorXd values(2 * std::ssize(data));
  for (Eigen::Index i = 0; i < std::ssize(data); ++i)
    values.segment<2>(2 * i) << data[static_cast<std::size_t>(i)].storage, data[static_cast<std::size_t>(i)].loss;
  return values;
}

Eigen::VectorXd deviations_of(const std::vector<MeasuredModulus>& data) {
  Eigen::VectorXd deviations(2 * std::ssize(data));
  for (Eigen::Index i = 0; i < std::ssize(data); ++i)
    deviations.segment<2>(2 * i) << data[static_cast<std::size_t>(i)].storage_deviation,
        data[static_cast<std::size_t>(i)].loss_deviation;
  return deviations;
}

Eigen::MatrixXd unit_moduli(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift,
                            const std::vector<double>& times) {
  Eigen::MatrixXd units(2 * std::ssize(data), std::ssize(times) + 1);
  const ShiftFactors factors(shift);
  Eigen::Index row = 0;
  for (const MeasuredModulus& measured : data) {
    const double omega = measured.angular_frequency * factors.time(measured.temperature);
    const double scale = 1 / factors.modulus(measured.temperature);
    units.col(0).segment<2>(row) << scale, 0;
    for (Eigen::Index j = 0; j < std::ssize(times); ++j) {
      // i omega tau/(1 + i omega tau)
      const double turned = omega * times[static_cast<std::size_t>(j)], loss = scale * turned / (1 + turned * turned);
      units.col(j + 1).segment<2>(row) << turned * loss, loss;
    }
    row += 2;
  }
  return units;
}

EvenSeries series_at_times(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift,
                           const std::vector<double>& times) {
  const Eigen::Index terms = std::ssize(times);
  const Eigen::VectorXd weights = deviations_of(data).cwiseInverse();
  const Eigen::MatrixXd a = weights.asDiagonal() * unit_moduli(data, shift, times);
  const Eigen::VectorXd b = weights.cwiseProduct(measured_values(data));
  const Eigen::VectorXd moduli = nonnegative_least_squares(a, b);
  EvenSeries answer{{moduli[0], {}}, (a * moduli - b).squaredNorm(), static_cast<int>(terms)};
  for (Eigen::Index j = 0; j < terms; ++j)
    if (moduli[j + 1] > 0) answer.series.terms.push_back({moduli[j + 1], times[static_cast<std::size_t>(j)]});
  return answer;
}

EvenSeries even_series(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift, int times,
                       double beyond) {
  EvenSeries series = series_at_times(data, shift, even_times(data, shift, times, beyond));
  series.beyond = beyond;
  return series;
}

EvenSeries automatic_series(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift,
                            bool deviations_known) {
  constexpr double per_decade = 2, dense = 2;
  constexpr int most_times = 400;
  const Span span = reduced_frequencies(data, shift);
  const double decades = std::log10(span.highest / span.lowest), values = 2.0 * static_cast<double>(data.size());
  std::optional<EvenSeries> best;
  double least = std::numeric_limits<double>::infinity();
  for (const double beyond : {0.0, 1.0}) {
    if (beyond > 0 && static_cast<double>(data.size()) < dense * decades) break;  // nothing there holds slow terms
    const double wanted = std::ceil(per_decade * (decades + 2 * beyond));
    const int most = std::clamp(static_cast<int>(std::min<double>(wanted, most_times)), 1, most_times);
    for (int times = 1; times <= most; ++times) {
      EvenSeries series = even_series(data, shift, times, beyond);
      const double freedom = values - series.moduli();
      if (freedom < 1 || series.series.terms.empty()) continue;
      const double criterion =
          deviations_known ? series.squares + 2.0 * series.moduli() : values * series.squares / (freedom * freedom);
      if (criterion >= least) continue;
      least = criterion;
      best = std::move(series);
    }
  }
  if (!best) throw std::invalid_argument("the moduli are too few for a Prony series");
  return *best;
}

}  // namespace rollres
