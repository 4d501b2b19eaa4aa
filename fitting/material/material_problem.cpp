#include "fitting/material/material_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "core/messages/message_text.hpp"

namespace rollres {

namespace {

constexpr Quantity wlf_c1{"wlf_c1", "c1", "1", "first constant of WLF", positive};
constexpr Quantity wlf_c2{"wlf_c2", "c2", "K", "second constant of WLF", positive};
constexpr Quantity energy{"activation_energy", "E", "J/mol", "of Arrhenius' law", not_negative};
constexpr Quantity vft_b{"vft_b", "B", "K", "of VFT's law", positive};
constexpr Quantity vft_temperature{"vft_temperature", "T∞", "K", "of VFT's law", positive};
constexpr Quantity log_shift{"log10_a_T", "log a_T", "1", "shift of one temperature", any_number};
constexpr Quantity log_vertical{"log10_b_T", "log b_T", "1", "vertical shift of one temperature", any_number};

}  // namespace

std::size_t nearest_step(const std::vector<double>& temperatures, double temperature) {
  const auto nearest = min_element(
      temperatures, [&](double a, double b) { return std::abs(a - temperature) < std::abs(b - temperature); });
  return static_cast<std::size_t>(nearest - temperatures.begin());
}

FitParameter parameter(const Quantity& quantity, double start, std::string name) {
  const double lowest =
      quantity.range.lowest_excluded ? std::nextafter(quantity.range.lowest, 1.0) : quantity.range.lowest;
  const bool logarithmic = quantity.range.lowest == 0 && quantity.range.highest > 1;
  return {name.empty() ? std::string(quantity.key) : std::move(name),
          {quantity, lowest, quantity.range.highest, logarithmic ? Scaling::logarithmic : Scaling::linear,
           logarithmic ? 1 : start},
          start};
}

std::vector<FitParameter> shift_parameters(const TemperatureShift& shift, bool free) {
  if (free) {
    constexpr double farthest = 100;  // decades
    const std::size_t reference = nearest_step(shift.table.temperatures, shift.reference);
    std::vector<FitParameter> parameters;
    for (const auto& [quantity, list] :
         {std::pair(&log_shift, &shift.table.factors), std::pair(&log_vertical, &shift.table.moduli)})
      for (std::size_t i = 0; i < list->size(); ++i)
        if (i != reference)
          parameters.push_back({message_text(quantity->key, " (", in_celsius<4>(shift.table.temperatures[i]), ")"),
                                {*quantity, -farthest, farthest, Scaling::linear, 1},
                                std::log10((*list)[i])});
    return parameters;
  }
  if (shift.law == ShiftLaw::wlf)
    return {parameter(wlf_c1, shift.c1 > 0 ? shift.c1 : 8.86), parameter(wlf_c2, shift.c2 > 0 ? shift.c2 : 101.6)};
  if (shift.law == ShiftLaw::arrhenius)
    return {parameter(energy, shift.activation_energy > 0 ? shift.activation_energy : 1e5)};
  if (shift.law == ShiftLaw::vft)
    return {parameter(vft_b, shift.vft_b > 0 ? shift.vft_b : 2000),
            parameter(vft_temperature,
                      shift.vft_temperature > 0 ? shift.vft_temperature : std::max(1.0, shift.reference - 100))};
  return {};
}

TemperatureShift shift_at(TemperatureShift shift, const FitPoint& point, bool free) {
  const std::size_t n = point.size();
  if (free) {
    const std::size_t reference = nearest_step(shift.table.temperatures, shift.reference);
    const std::size_t others = shift.table.factors.size() - 1;
    std::size_t next = n - (shift.table.moduli.empty() ? 1 : 2) * others;
    for (std::vector<double>* const list : {&shift.table.factors, &shift.table.moduli})
      for (std::size_t i = 0; i < list->size(); ++i) (*list)[i] = i == reference ? 1 : std::pow(10, point[next++]);
    return shift;
  }
  if (shift.law == ShiftLaw::wlf) shift.c1 = point[n - 2], shift.c2 = point[n - 1];
  if (shift.law == ShiftLaw::arrhenius) shift.activation_energy = point[n - 1];
  if (shift.law == ShiftLaw::vft) shift.vft_b = point[n - 2], shift.vft_temperature = point[n - 1];
  return shift;
}

void answer_by(FitProblem& problem, std::function<Eigen::VectorXd(const FitPoint&)> values, double least_size) {
  problem.model.predict = [values = std::move(values), log = problem.log](const FitPoint& point, const DataRows&) {
    Prediction prediction;
    try {
      prediction.values = values(point);
      log->answered();
    } catch (const std::invalid_argument& error) {
      prediction.reason = error.what();
      log->failed("", error.what());
    }
    return prediction;
  };
  const FitProblem plain = problem;
  problem.model.differentiate = [plain, least_size](const FitPoint& point, const Prediction& prediction) {
    constexpr double step = 1e-3, rounding = 1e-15;
    return differences(plain, point, prediction, step, rounding * prediction.values.cwiseAbs().cwiseMax(least_size));
  };
}

FitProblem material_problem(const std::vector<MeasuredModulus>& data, std::vector<FitParameter> parameters,
                            const MaterialFitOptions& options, const ModulusAt& modulus) {
  FitProblem problem;
  problem.parameters = std::move(parameters);
  for (FitParameter& added : shift_parameters(options.shift, options.free_shifts))
    problem.parameters.push_back(std::move(added));
  problem.deviations_known = options.deviations_known;
  for (const MeasuredModulus& row : data) {
    problem.data.push_back({row.storage, row.storage_deviation, row.place});
    problem.data.push_back({row.loss, row.loss_deviation, row.place});
  }
  const auto values = [data, modulus, shift = options.shift, free = options.free_shifts](const FitPoint& point) {
    Eigen::VectorXd moduli(2 * std::ssize(data));
    const TemperatureShift here = shift_at(shift, point, free);
    const ShiftFactors factors(here);
    Eigen::Index row = 0;
    for (const MeasuredModulus& measured : data) {
      const auto value = modulus(point, measured.angular_frequency * factors.time(measured.temperature)) /
                         factors.modulus(measured.temperature);
      moduli[row++] = value.real();
      moduli[row++] = value.imag();
    }
    return moduli;
  };
  answer_by(problem, values, 0);
  return problem;
}

MaterialFit material_answer(FitReport report, const MaterialFitOptions& options, const ModulusAt& modulus) {
  MaterialFit answer{.report = std::move(report), .zener = {}, .prony = {}, .shift = {}};
  answer.shift = shift_at(options.shift, answer.report.point(), options.free_shifts);
  answer.modulus_at = [modulus, shift = options.shift, free = options.free_shifts](const FitPoint& point, double omega,
                                                                                   double temperature) {
    const TemperatureShift here = shift_at(shift, point, free);
    return modulus(point, omega * shift_factor(here, temperature)) / modulus_factor(here, temperature);
  };
  return answer;
}

MaterialFit fitted_material(const std::vector<MeasuredModulus>& data, const std::vector<FitParameter>& parameters,
                            const MaterialFitOptions& options, const ModulusAt& modulus) {
  return material_answer(fit(material_problem(data, parameters, options, modulus), options.options), options, modulus);
}

MasterCurve master_curve_of(const std::vector<MeasuredModulus>& data, const TemperatureShift& shift) {
  MasterCurve curve;
  const ShiftFactors factors(shift);
  for (const MeasuredModulus& row : data) {
    const double omega = row.angular_frequency * factors.time(row.temperature);
    curve.frequencies.push_back(omega / (2 * std::numbers::pi));
    const double factor = factors.modulus(row.temperature);
    curve.storage.push_back(factor * row.storage);
    curve.loss.push_back(factor * row.loss);
  }
  return curve;
}

void warn(FitReport& report, const std::string& warning) {
  if (warning.empty()) return;
  report.warnings.push_back(warning);
  report.status = std::min(report.status, FitStatus::usable_with_warnings);
}

}  // namespace rollres
