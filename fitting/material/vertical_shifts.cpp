#include "fitting/material/vertical_shifts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/algebra/dense_algebra.hpp"
#include "core/messages/message_text.hpp"
#include "fitting/errors/information_criteria.hpp"
#include "fitting/material/material_problem.hpp"

namespace rollres {

namespace {

double aicc_of(const FitReport& report, double chi_squared, std::size_t parameters) {
  constexpr double exact = 1e-4;  // a relative misfit that counts as none
  const auto values = static_cast<double>(report.values.size());
  if (!report.deviations_known) chi_squared = std::max(chi_squared, values * exact * exact);
  return information_criteria(chi_squared, report.values.size(), static_cast<int>(parameters), report.deviations_known)
      .aicc;
}

double aicc_of(const FitReport& report) { return aicc_of(report, report.chi_squared, report.parameters.size()); }

/// By how much AICc would fall with b_T, to first order in all parameters and log b_T: d ln G* / d ln b = -1.
double linear_gain(const FitReport& report, const std::vector<MeasuredModulus>& data, const TemperatureShift& shift) {
  const std::vector<double>& temperatures = shift.table.temperatures;
  const Eigen::Index rows = std::ssize(report.values), parameters = report.slopes.derivatives.cols();
  const auto others = static_cast<Eigen::Index>(temperatures.size()) - 1;
  const auto reference = static_cast<Eigen::Index>(nearest_step(temperatures, shift.reference));
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows, parameters + others);
  Eigen::VectorXd residuals(rows);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const FittedValue& value = report.values[static_cast<std::size_t>(row)];
    residuals[row] = value.residual;
    a.row(row).head(parameters) = report.slopes.derivatives.row(row) / value.measured.deviation;
    const auto step =
        static_cast<Eigen::Index>(nearest_step(temperatures, data[static_cast<std::size_t>(row / 2)].temperature));
    if (step != reference)
      a(row, parameters + step - (step > reference ? 1 : 0)) = -value.predicted / value.measured.deviation;
  }
  const double left = (residuals - a * least_squares(a, residuals)).squaredNorm();
  return aicc_of(report, residuals.squaredNorm(), report.parameters.size()) -
         aicc_of(report, left, report.parameters.size() + static_cast<std::size_t>(others));
}

/// "with them AICc would rise by 22"
std::string gain_in_words(double gain, const char* would) {
  if (!std::isfinite(gain)) return "the values are too few for them";
  const std::string verb = gain >= 0 ? "fall" : "rise";
  return message_text<3>("with them AICc ", would, verb, *would ? "" : "s", " by ", std::abs(gain));
}

std::string asked_from() { return message_text<3>("; the data ask for them from a fall of ", wanted_gain); }

}  // namespace

MaterialFit with_vertical_shifts(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options,
                                 const std::function<MaterialFit(const MaterialFitOptions&)>& fit_with) {
  MaterialFit plain = fit_with(options);
  if (options.vertical == VerticalShift::none || !plain.report.slopes.found()) return plain;
  const std::string left_out = "vertical shifts b_T are left out: ";
  if (options.vertical == VerticalShift::automatic)
    if (const double gain = linear_gain(plain.report, data, plain.shift); !(gain >= wanted_gain)) {
      plain.notes.push_back(left_out + gain_in_words(gain, "would ") + asked_from());
      return plain;
    }
  MaterialFitOptions wanted = options;
  wanted.shift = plain.shift;
  wanted.shift.table.moduli.assign(plain.shift.table.temperatures.size(), 1);
  MaterialFit scaled = fit_with(wanted);
  const double gain = aicc_of(plain.report) - aicc_of(scaled.report);
  const bool converged = scaled.report.slopes.found() && scaled.report.status != FitStatus::not_converged;
  if (options.vertical == VerticalShift::free || (converged && gain >= wanted_gain)) {
    scaled.notes.push_back("vertical shifts b_T are taken, moduli are those of the data times b_T: " +
                           gain_in_words(gain, "") + (gain >= wanted_gain ? "" : asked_from()));
    return scaled;
  }
  plain.notes.push_back(left_out + gain_in_words(gain, "") +
                        (converged ? asked_from() : ", but that fit did not converge"));
  return plain;
}

}  // namespace rollres
