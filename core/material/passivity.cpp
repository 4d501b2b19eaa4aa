#include "core/material/passivity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/material/relative_rows.hpp"
#include "core/messages/message_text.hpp"
#include "core/numerics/sorted_places.hpp"

namespace rollres {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// So dense that one relaxation time between two of these is met to 0.1 %; a decade and a half beyond the table either
/// way.
PronySeries nearest_passive(const RelativeRows& rows) {
  constexpr double per_decade = 8, beyond = 1.5, most = 200;
  const int count = static_cast<int>(std::ceil(std::min(most, per_decade * (rows.decades() + 2 * beyond))));
  std::vector<double> times;
  for (int j = 0; j <= count; ++j)
    times.push_back(std::pow(10, -beyond + (rows.decades() + 2 * beyond) * j / count) / rows.highest());
  const VectorXd moduli = nonnegative_moduli(rows, times);
  PronySeries series{rows.least_rest(), {}};
  if (rows.free_rest()) series.static_modulus += moduli(count + 1);
  for (Index j = 0; j <= count; ++j)
    if (moduli(j) > 0) series.terms.push_back({moduli(j), times[static_cast<std::size_t>(j)]});
  return series;
}

/// Half a decade apart, the largest misfit first.
std::vector<double> worst_frequencies(const MasterCurve& curve, const std::vector<double>& misfits) {
  constexpr std::size_t most = 3;
  const double apart = std::sqrt(10.0);
  std::vector<double> worst;
  for (const std::size_t row : sorted_places(misfits.size(), [&](std::size_t i) { return -misfits[i]; })) {
    const double here = curve.frequencies[row];
    const bool near = std::any_of(worst.begin(), worst.end(),
                                  [&](double other) { return std::max(here, other) < apart * std::min(here, other); });
    if (!near && worst.size() < most) worst.push_back(here);
  }
  return worst;
}

}  // namespace

std::string PassivityTest::in_words() const {
  if (!contradiction) return "";
  constexpr double about_one = 1.25;
  const double ratio = implied_rise / measured_rise;
  std::string rise;
  if (measured_rise <= 0)
    rise = "the storage modulus does not rise as the loss implies, ";
  else if (ratio > about_one || ratio < 1 / about_one)
    rise = message_text<2>("the loss implies ", ratio, " times the measured rise of the storage modulus, ");
  const auto frequency = [](double one) { return message_text<3>(one); };
  return message_text<3>("storage and loss contradict each other (Kramers and Kronig): ", rise,
                         "no passive material comes nearer than ", 100 * misfit, " % (rms); worst at ") +
         joined(worst, ", ", frequency) + " Hz";
}

std::string swapped_moduli(const std::vector<double>& storage, const std::vector<double>& loss) {
  std::size_t above = 0;
  for (std::size_t row = 0; row < storage.size(); ++row) above += loss[row] > storage[row];
  if (2 * above <= storage.size()) return "";
  return message_text<6>("the loss modulus is above the storage modulus in ", above, " of ", storage.size(),
                         " rows: are the two swapped?");
}

PassivityTest passivity_test(const MasterCurve& given) {
  constexpr double noticeable = 0.02, by_chance = 2.5;  // deviations of the products of random neighbours
  MasterCurve curve = given;
  curve.static_modulus = 0;
  const RelativeRows rows(curve);
  const PronySeries series = nearest_passive(rows);
  const std::vector<std::size_t> order = rows_in_order(curve);
  const VectorXd residuals = rows.residuals(series);
  PassivityTest test;
  const std::vector<double> misfits = relative_misfits(curve, series);
  for (const double misfit : misfits) test.misfit += misfit * misfit / static_cast<double>(misfits.size());
  test.misfit = std::sqrt(test.misfit);
  test.worst = worst_frequencies(curve, misfits);
  test.measured_rise = curve.storage[order.back()] - curve.storage[order.front()];

  double products = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const std::size_t a = order[i - 1], b = order[i];
    test.implied_rise +=
        (curve.loss[a] + curve.loss[b]) / std::numbers::pi * std::log(curve.frequencies[b] / curve.frequencies[a]);
    for (const Index part : {Index{0}, rows.rows()})
      products += residuals(part + static_cast<Index>(a)) * residuals(part + static_cast<Index>(b));
  }
  const auto pairs = static_cast<double>(2 * (order.size() - 1));
  const double mean = products / pairs, variance = residuals.squaredNorm() / static_cast<double>(residuals.size());
  test.shared = std::sqrt(std::max(mean, 0.0));
  test.contradiction = test.shared > noticeable && mean > by_chance * variance / std::sqrt(pairs);
  return test;
}

}  // namespace rollres
