#include "fitting/fit/closed_form_start.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <tuple>
#include <utility>

#include "core/material/material.hpp"
#include "core/reference/reference_solutions.hpp"
#include "fitting/fit/fit.hpp"

namespace rollres {

namespace {

/// A usual value, and how far from it the search goes either way, as a factor.
struct Placeholder {
  std::string_view key;
  double usual, reach;
};
constexpr std::array<Placeholder, 3> placeholders{
    {{"static_shear_modulus", 1e6, 1e3}, {"stiffening", 2, 100}, {"creep_time", 0.1, 1e4}}};

const Placeholder* find(std::string_view key) {
  const auto* const found = find_if(placeholders, [&](const auto& known) { return known.key == key; });
  return found == placeholders.end() ? nullptr : found;
}

/// Half-width and the factor of tan(delta) a/R P, which of a cylinder is per metre here.
std::pair<double, double> contact(const RollingScene& scene, double modulus) {
  const bool cylinder = dimension_of(scene.indenter) == 2, finite = std::isfinite(scene.layer_thickness);
  const double radius = scene.radius, load = *scene.load / body_length(scene);
  const ConstantLossCoefficients coefficients = constant_loss_coefficients();
  const double thick =
      cylinder ? hertz_line(radius, load, modulus).half_width : hertz_sphere(radius, load, modulus).half_width;
  const double thick_coefficient = cylinder ? coefficients.half_space_cylinder : coefficients.half_space_sphere;
  if (!finite) return {thick, thick_coefficient};
  const double height = scene.layer_thickness;
  const double thin = cylinder ? thin_layer_line(radius, height, load, modulus).half_width
                               : thin_layer_sphere(radius, height, load, modulus).half_width;
  if (thick < thin) return {thick, thick_coefficient};
  return {thin, cylinder ? coefficients.thin_layer_cylinder : coefficients.thin_layer_sphere};
}

/// The rows that closed forms can say something of: resistances under a load, and moduli.
std::vector<MeasuredScene> known_by_closed_forms(const std::vector<MeasuredScene>& scenes, std::string_view output) {
  std::vector<MeasuredScene> known;
  for (const MeasuredScene& row : scenes) {
    const std::string_view own = row.output.empty() ? output : std::string_view(row.output);
    if (is_of_material(own) || (own == "rolling_resistance" && row.scene.load)) known.push_back(row);
  }
  return known;
}

bool concerns_any(const FittedInput& input, const std::vector<MeasuredScene>& scenes) {
  return any_of(scenes, [&](const MeasuredScene& row) { return input.set.empty() || input.set == row.set; });
}

}  // namespace

bool has_closed_form_start(std::string_view key) { return find(key) != nullptr; }

double closed_form_placeholder(std::string_view key) { return find(key)->usual; }

double estimated_resistance(const RollingScene& scene) {
  double half_width = contact(scene, static_modulus(scene)).first, coefficient = 0;
  std::complex<double> modulus;
  constexpr int enough = 8;
  for (int i = 0; i < enough; ++i) {
    modulus = complex_modulus(scene, scene.speed / half_width);
    std::tie(half_width, coefficient) = contact(scene, std::abs(modulus));
  }
  return coefficient * (modulus.imag() / modulus.real()) * half_width / scene.radius * *scene.load;
}

namespace {

RollingSolution estimate(const RollingScene& scene) {
  RollingSolution solution;
  solution.rolling_resistance = estimated_resistance(scene);
  solution.status = Status::converged;
  return solution;
}

}  // namespace

std::vector<FittedInput> with_closed_form_starts(const std::vector<MeasuredScene>& given,
                                                 std::vector<FittedInput> inputs, std::string_view output) {
  const std::vector<MeasuredScene> scenes = known_by_closed_forms(given, output);
  const auto wanted = [](const FittedInput& input) { return !input.start && has_closed_form_start(input.input.key); };
  if (scenes.empty() || none_of(inputs, wanted)) return inputs;
  // Stiffness and stiffening are hard to separate: the latter starts from its usual value.
  std::vector<MeasuredScene> usual = scenes;
  for (FittedInput& input : inputs) {
    if (!wanted(input) || input.input.key != "stiffening") continue;
    const double value = find("stiffening")->usual;
    input.start = std::clamp(value, input.input.lowest.value_or(value), input.input.highest.value_or(value));
    for (MeasuredScene& row : usual) row.scene.stiffening = *input.start;
  }
  std::vector<FittedInput> searched;
  std::vector<FittedInput> terms;
  std::vector<std::size_t> places;
  for (std::size_t j = 0; j < inputs.size(); ++j) {
    if (is_measured_term(inputs[j].input.key) && concerns_any(inputs[j], scenes)) terms.push_back(inputs[j]);
    if (!wanted(inputs[j])) continue;
    FittedInput input = inputs[j];
    input.prior.reset();
    const Placeholder& known = *find(input.input.key);
    input.input.lowest = std::max(input.input.lowest.value_or(0), known.usual / known.reach);
    input.input.highest = std::min(input.input.highest.value_or(1e300), known.usual * known.reach);
    input.start = std::clamp(known.usual, *input.input.lowest, *input.input.highest);
    input.input.logarithmic = true;
    searched.push_back(input);
    places.push_back(j);
  }
  if (searched.empty() || scenes.size() <= searched.size() + terms.size()) return inputs;
  for (FittedInput& term : terms) {
    term.prior.reset();
    searched.push_back(std::move(term));
  }
  const FitProblem problem = resistance_problem(usual, searched, estimate, {.jobs = 1});
  const FitReport found = fit(problem, {.starts = 16, .reach = 1e4, .profiles = false});
  for (std::size_t k = 0; k < places.size(); ++k) inputs[places[k]].start = found.parameters[k].value;
  return inputs;
}

void add_closed_forms(FitProblem& problem, const std::vector<MeasuredScene>& scenes,
                      const std::vector<FittedInput>& inputs, std::string_view output) {
  const bool one_layer = all_of(scenes, [](const MeasuredScene& row) {
    return row.scene.coating_layers.empty() && row.scene.lower_layers.empty();
  });
  const std::size_t known = known_by_closed_forms(scenes, output).size();
  if (!one_layer || known == 0) return;
  if (known == scenes.size())
    problem.estimate =
        resistance_problem(scenes, inputs, problem.parameters, estimate, {.output = std::string(output), .jobs = 1})
            .model.predict;
  std::vector<FittedInput> unstarted = inputs;
  for (FittedInput& input : unstarted) {
    if (has_closed_form_start(input.input.key)) input.start.reset();
    if (!input.set.empty()) return;
  }
  const std::vector<FittedInput> started = with_closed_form_starts(scenes, unstarted, output);
  FitPoint suggestion;
  for (std::size_t j = 0; j < problem.size(); ++j) {
    const Variable& variable = problem.parameters[j].variable;
    const double value = started[j].start.value_or(problem.parameters[j].start);
    suggestion.push_back(std::clamp(value, variable.lowest, variable.highest));
  }
  problem.suggestions.push_back(std::move(suggestion));
}

}  // namespace rollres
