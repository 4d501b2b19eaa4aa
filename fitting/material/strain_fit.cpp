#include "fitting/material/strain_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>

#include "core/material/passivity.hpp"
#include "core/material/strain_softening.hpp"
#include "fitting/material/material_problem.hpp"

namespace rollres {

namespace {

constexpr Quantity storage_modulus{"storage_modulus", "G'lin", "Pa", "G' at small strains", positive},
    loss_modulus{"loss_modulus", "G\"lin", "Pa", "G\" at small strains", positive};

Quantity input_of_material(std::string_view key) {
  std::optional<Quantity> found;
  const MaterialInputs any;
  visit_material_inputs(any, [&](const Quantity& quantity, const auto&) {
    if (quantity.key == key) found.emplace(quantity);
  });
  return found.value();
}

MaterialInputs layer_at(const FitPoint& point) {
  MaterialInputs layer;
  layer.payne_drop = point[2];
  layer.payne_strain = point[3];
  layer.payne_exponent = point[4];
  layer.payne_loss_peak = point[5];
  return layer;
}

/// Where G' has lost half of what it loses within the sweep. @param data  in rising order of their amplitudes
std::size_t row_of_half(const std::vector<MeasuredStrain>& data) {
  const double half = (data.front().storage + data.back().storage) / 2;
  const auto row = find_if(data, [&](const MeasuredStrain& other) { return other.storage <= half; });
  return std::min(static_cast<std::size_t>(row - data.begin()), data.size() - 1);
}

/// The drop within the sweep and a quarter more: a sweep rarely shows all of it.
std::vector<FitParameter> parameters_of(std::vector<MeasuredStrain> data) {
  stable_sort(data, [](const MeasuredStrain& a, const MeasuredStrain& b) { return a.amplitude < b.amplitude; });
  const MeasuredStrain &first = data.front(), &middle = data[row_of_half(data)];
  const double drop = 1.25 * (1 - data.back().storage / first.storage), peak = middle.loss / first.loss;
  return {parameter(storage_modulus, 1.02 * first.storage),
          parameter(loss_modulus, 0.98 * first.loss),
          parameter(input_of_material("payne_drop"), std::clamp(drop, 0.05, 0.95)),
          parameter(input_of_material("payne_strain"), middle.amplitude),
          parameter(input_of_material("payne_exponent"), 0.55),
          parameter(input_of_material("payne_loss_peak"), std::clamp(peak, 0.1, 10.0))};
}

FitProblem sweep_problem(const std::vector<MeasuredStrain>& data, std::vector<FitParameter> parameters) {
  FitProblem problem;
  problem.parameters = std::move(parameters);
  std::vector<double> amplitudes;
  for (const MeasuredStrain& row : data) {
    amplitudes.push_back(row.amplitude);
    problem.data.push_back({row.storage, row.storage_deviation, row.place});
    problem.data.push_back({row.loss, row.loss_deviation, row.place});
  }
  const auto values = [amplitudes](const FitPoint& point) {
    const MaterialInputs layer = layer_at(point);
    Eigen::VectorXd moduli(2 * std::ssize(amplitudes));
    Eigen::Index row = 0;
    for (const double amplitude : amplitudes) {
      const Softening softening = softening_at(layer, amplitude);
      moduli[row++] = point[0] * softening.storage;
      moduli[row++] = point[1] * softening.loss;
    }
    return moduli;
  };
  answer_by(problem, values, 0);
  return problem;
}

std::string beyond_sweep(const StrainFit& found, double lowest, double highest) {
  const double half = found.layer.payne_strain.value();
  if (half >= lowest && half <= highest) return "";
  return std::string("payne_strain lies ") + (half < lowest ? "below" : "above") +
         " all strains of the sweep: half of the drop was not measured, but is what the model makes of the rest";
}

}  // namespace

SweepModuli StrainFit::moduli(double amplitude) const {
  std::vector<FitParameter> parameters;
  for (const FittedParameter& fitted : report.parameters) parameters.push_back(fitted.parameter);
  const FitProblem problem = sweep_problem({{amplitude, 1, 1, 1, 1}}, parameters);
  const FitPoint point = report.point();
  const Prediction here = problem.predict(point);
  const Slopes slopes = problem.differentiate(point, here);
  const auto error = [&](Eigen::Index row) {
    const Eigen::RowVectorXd slope = slopes.derivatives.row(row);
    return std::sqrt(slope.dot(report.errors.covariance * slope.transpose()));
  };
  return {here.values[0], here.values[1], error(0), error(1)};
}

StrainFit fit_strain_sweep(const std::vector<MeasuredStrain>& data, bool deviations_known, const FitOptions& options) {
  constexpr std::size_t fewest = 4;  // G' alone tells four parameters
  std::set<double> amplitudes;
  for (const MeasuredStrain& row : data) amplitudes.insert(row.amplitude);
  if (amplitudes.size() < fewest)
    throw std::invalid_argument("Kraus's model needs moduli at four strains at least; the sweep has " +
                                std::to_string(amplitudes.size()));
  FitProblem problem = sweep_problem(data, parameters_of(data));
  problem.deviations_known = deviations_known;
  StrainFit answer{fit(problem, options)};
  answer.layer = layer_at(answer.report.point());
  warn(answer.report, beyond_sweep(answer, *amplitudes.begin(), *amplitudes.rbegin()));
  std::vector<double> storage, loss;
  for (const MeasuredStrain& row : data) {
    storage.push_back(row.storage);
    loss.push_back(row.loss);
  }
  warn(answer.report, swapped_moduli(storage, loss));
  return answer;
}

}  // namespace rollres
