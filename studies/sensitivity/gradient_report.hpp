#pragma once

/// The gradient of an output by some inputs with all that is known of it, as table, JSON and text. For sources only: it
/// needs nlohmann_json.

#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>

#include "core/derivatives/gradient.hpp"
#include "db/queries/table.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// What is known of one input.
struct InputReport {
  const Variable& variable;
  double value;  ///< [SI]
  const InputCalibration& calibration;
  const InputGradient& gradient;
  double output;  ///< [SI]

  int evaluations() const { return calibration.evaluations + gradient.evaluations; }
  double relative_noise() const;
  double elasticity_error() const;
};

struct GradientReport {
  Objective objective;
  Calibration calibration;
  Gradient gradient;  ///< without inputs if the centre has no value
  double seconds;

  Body body() const { return body_of(objective.base); }
  std::string_view output_unit() const { return objective.output.unit_for(body()); }
  std::size_t size() const { return gradient.inputs.size(); }
  InputReport operator[](std::size_t i) const;
  int evaluations() const;
  std::string derivative_unit(const Variable& variable) const;
};

/// Calibrates and differentiates at the base scene.
GradientReport gradient_report(Objective objective, const GradientOptions& options);

/// Puts the inputs with the largest elasticities first, those without one last.
void sort_by_elasticity(GradientReport& report);

Table table_of(const GradientReport& report);
Json json_of(const GradientReport& report);
/// The table, or why there is none; to `err` what failed on the way.
void print_text(const GradientReport& report, std::ostream& out, std::ostream& err);

}  // namespace rollres
