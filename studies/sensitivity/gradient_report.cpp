#include "studies/sensitivity/gradient_report.hpp"

#include <chrono>
#include <cmath>
#include <ostream>

#include "core/numerics/sorted_places.hpp"
#include "core/scene/scene_input.hpp"
#include "studies/run/progress.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

double InputReport::relative_noise() const { return calibration.size.noise / std::abs(output); }

double InputReport::elasticity_error() const {
  return std::isnan(gradient.elasticity) ? RollingSolution::absent : gradient.error() * std::abs(value / output);
}

InputReport GradientReport::operator[](std::size_t i) const {
  return {objective.variables[i], gradient.point[i], calibration.inputs[i], gradient.inputs[i], gradient.centre.value};
}

int GradientReport::evaluations() const {
  int sum = 1;
  for (std::size_t i = 0; i < size(); ++i) sum += (*this)[i].evaluations();
  return sum;
}

std::string GradientReport::derivative_unit(const Variable& variable) const {
  const std::string unit(variable.quantity.unit_for(body()));
  if (unit == "1") return std::string(output_unit());
  return std::string(output_unit()) + " / " + (unit.find('/') == std::string::npos ? unit : '(' + unit + ')');
}

GradientReport gradient_report(Objective objective, const GradientOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  GradientReport report{std::move(objective), {}, {}, 0};
  const std::vector<double> point = base_point(report.objective);
  report.calibration = calibrate(report.objective, point, options.jobs);
  report.gradient = report.calibration.centre.found() ? gradient(report.objective, point, report.calibration, options)
                                                      : Gradient{point, report.calibration.centre, {}};
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

void sort_by_elasticity(GradientReport& report) {
  const std::vector<std::size_t> order = sorted_places(report.size(), [&](std::size_t i) {
    const double elasticity = std::abs(report.gradient.inputs[i].elasticity);
    return std::isnan(elasticity) ? 1 : -elasticity;
  });
  const auto sort = [&](auto& list) {
    auto sorted = list;
    for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = list[order[i]];
    list = std::move(sorted);
  };
  if (order.empty()) return;
  sort(report.objective.variables);
  sort(report.calibration.point);
  sort(report.calibration.inputs);
  sort(report.gradient.point);
  sort(report.gradient.inputs);
}

Table table_of(const GradientReport& report) {
  Table table{{"input", "value", "elasticity", "+-", "derivative", "+-", "unit", "noise", "scale", "step", "scheme",
               "evaluations"},
              {}};
  const auto number = [](double value) { return std::isfinite(value) ? Cell(value) : Cell(); };
  const auto rough = [](double value) { return std::isfinite(value) ? Cell(short_number(value, 2)) : Cell(); };
  for (std::size_t i = 0; i < report.size(); ++i) {
    const InputReport input = report[i];
    const InputGradient& gradient = input.gradient;
    const Quantity& quantity = input.variable.quantity;
    table.rows.push_back({std::string(quantity.key), readable(quantity, input.value, quantity.unit_for(report.body())),
                          number(gradient.elasticity), rough(input.elasticity_error()), number(gradient.derivative),
                          rough(gradient.error()), report.derivative_unit(input.variable),
                          rough(input.relative_noise()), std::string(name_of(input.variable.scaling)),
                          rough(gradient.step), std::string(name_of(gradient.scheme)),
                          static_cast<std::int64_t>(input.evaluations())});
  }
  return table;
}

Json json_of(const GradientReport& report) {
  const ObjectiveValue& centre = report.gradient.centre;
  Json object = json_object("output", report.objective.output.key, "unit", report.output_unit(), "value", centre.value,
                            "status", name_of(centre.status), "reason", centre.reason, "evaluations",
                            report.evaluations(), "seconds", report.seconds, "inputs", Json::array());
  for (std::size_t i = 0; i < report.size(); ++i) {
    const InputReport input = report[i];
    const Variable& variable = input.variable;
    const InputGradient& gradient = input.gradient;
    Json failures = Json::array();
    for (const auto* const points : {&input.calibration.failures, &gradient.failures})
      for (const FailedPoint& point : *points)
        failures.push_back({{"value", point.value}, {"status", name_of(point.status)}, {"reason", point.reason}});
    object["inputs"].push_back(json_object(
        "key", variable.quantity.key, "unit", variable.quantity.unit_for(report.body()), "value", input.value, "lowest",
        variable.lowest, "highest", variable.highest, "scale", name_of(variable.scaling), "derivative",
        gradient.derivative, "derivative_unit", report.derivative_unit(variable), "error", gradient.error(),
        "truncation_error", gradient.truncation_error, "noise_error", gradient.noise_error, "solution_error",
        gradient.solution_error, "elasticity", gradient.elasticity, "elasticity_error", input.elasticity_error(),
        "noise", input.calibration.size.noise, "relative_noise", input.relative_noise(), "step", gradient.step,
        "scheme", name_of(gradient.scheme), "evaluations", input.evaluations(), "failures", failures));
  }
  return object;
}

void print_text(const GradientReport& report, std::ostream& out, std::ostream& err) {
  const ObjectiveValue& centre = report.gradient.centre;
  const std::string key(report.objective.output.key);
  if (!centre.found()) {
    out << "status   " << name_of(centre.status) << "\nreason   " << centre.reason << '\n';
    return;
  }
  out << key << " = " << readable(centre.value, report.output_unit()) << ", " << report.evaluations()
      << " evaluations in " << duration_in_words(report.seconds) << "\n\n";
  write_aligned(out, table_of(report));
  for (std::size_t i = 0; i < report.size(); ++i) {
    const InputReport input = report[i];
    const auto& first = input.calibration.failures.empty() ? input.gradient.failures : input.calibration.failures;
    if (first.empty()) continue;
    err << input.variable.quantity.key << ": " << input.calibration.failures.size() + input.gradient.failures.size()
        << " points without an answer, the first at " << short_number(first.front().value) << ": "
        << first.front().reason << '\n';
  }
}

}  // namespace rollres
