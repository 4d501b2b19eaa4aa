#include "fitting/material/series_slopes.hpp"

#include <cmath>
#include <random>

#include "fitting/material/even_series.hpp"
#include "fitting/material/material_problem.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// Rows of a fractional solid with 3 % noise, at three temperatures.
std::vector<MeasuredModulus> drawn_rows(const TemperatureShift& shift) {
  const FractionalZener material{1e6, 100, 1e-2, 0.5};
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<MeasuredModulus> data;
  for (const double temperature : {273.15, 283.15, 293.15})
    for (double omega = 0.1; omega < 2e2; omega *= 3) {
      const std::complex<double> modulus =
          complex_modulus(material, omega * shift_factor(shift, temperature)) / modulus_factor(shift, temperature);
      const double storage = modulus.real() * (1 + 0.03 * normal(random)),
                   loss = modulus.imag() * (1 + 0.03 * normal(random));
      data.push_back({omega, temperature, storage, loss, 0.03 * storage, 0.05 * loss});
    }
  return data;
}

}  // namespace

TEST_CASE("a series that follows its shift changes as the series of neighbouring shifts differ",
          "[fitting][material_fit]") {
  const TemperatureShift wlf{ShiftLaw::wlf, 293.15, 9, 90, 0};
  TemperatureShift table{.law = ShiftLaw::table, .reference = 293.15};
  table.table.temperatures = {273.15, 283.15, 293.15};
  for (const double temperature : table.table.temperatures) {
    table.table.factors.push_back(shift_factor(wlf, temperature));
    table.table.moduli.push_back(std::pow(10, 1e-3 * (293.15 - temperature)));
  }
  for (const TemperatureShift& shift : {wlf, table})
    for (const int terms : {3, 6}) {
      CAPTURE(static_cast<int>(shift.law), terms);
      const auto data = drawn_rows(shift);
      MaterialFitOptions options;
      options.shift = shift;
      options.free_shifts = shift.law == ShiftLaw::table;
      const std::vector<FitParameter> constants = shift_parameters(shift, options.free_shifts);
      FitPoint at;
      for (const FitParameter& constant : constants) at.push_back(constant.start + 0.01 * std::abs(constant.start));
      const auto predicted = [&](const FitPoint& point, const PronySeries* fixed) {
        const TemperatureShift here = shift_at(shift, point, options.free_shifts);
        const PronySeries series = fixed ? *fixed : even_series(data, here, terms).series;
        Eigen::VectorXd moduli(modulus_slopes(data, here, series).cols());
        Eigen::Index next = 0;
        if (series.static_modulus > 0) moduli[next++] = series.static_modulus;
        for (const PronySeries::Term& term : series.terms) moduli[next++] = term.modulus;
        return Eigen::VectorXd(modulus_slopes(data, here, series) * moduli);
      };
      const PronySeries series = even_series(data, shift_at(shift, at, options.free_shifts), terms).series;
      const Eigen::MatrixXd stays = shift_slopes(data, series, options, constants, at),
                            follows = following_slopes(data, series, predicted(at, nullptr), options, constants, at);
      const TemperatureShift here = shift_at(shift, at, options.free_shifts);
      const Eigen::MatrixXd by_time = time_slopes(data, here, series);
      for (std::size_t j = 0; j < series.terms.size(); ++j) {
        constexpr double step = 1e-4;
        PronySeries below = series, above = series;
        below.terms[j].time *= std::exp(-step);
        above.terms[j].time *= std::exp(step);
        const Eigen::VectorXd differences = (predicted(at, &above) - predicted(at, &below)) / (2 * step);
        CHECK((by_time.col(static_cast<Eigen::Index>(j)) - differences).norm() < 1e-5 * differences.norm());
      }
      for (std::size_t k = 0; k < constants.size(); ++k) {
        constexpr double step = 1e-4;
        const Variable& variable = constants[k].variable;
        FitPoint below = at, above = at;
        below[k] = variable.value(variable.scaled(at[k]) - step);
        above[k] = variable.value(variable.scaled(at[k]) + step);
        const auto column = static_cast<Eigen::Index>(k);
        for (const auto& [slopes, fixed] : {std::pair(&stays, &series), {&follows, nullptr}}) {
          const Eigen::VectorXd differences = (predicted(above, fixed) - predicted(below, fixed)) / (2 * step);
          CAPTURE(k, fixed == nullptr);
          CHECK((slopes->col(column) - differences).norm() < 1e-5 * differences.norm());
        }
      }
    }
}
