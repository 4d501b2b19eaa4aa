#include "core/derivatives/objective.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "core/material/material.hpp"
#include "core/messages/require.hpp"
#include "core/scene/friction_law.hpp"
#include "core/scene/scene_input.hpp"

namespace rollres {

namespace {

template <class Value>
constexpr bool is_real = std::is_same_v<Value, double> || std::is_same_v<Value, std::optional<double>>;

[[noreturn]] void refuse_key(std::string_view kind, std::string_view key, const std::vector<std::string_view>& known) {
  const std::string nearest = nearest_name(known, key);
  throw std::invalid_argument(std::string(key) + ": unknown " + std::string(kind) +
                              (nearest.empty() ? "; see rollres quantities" : "; did you mean " + nearest + "?"));
}

/// What an input that is zero is compared with.
double natural_size(const RollingScene& scene, const Quantity& quantity) {
  const std::string_view unit = quantity.unit_for(body_of(scene));
  if (unit == "Pa") return static_modulus(scene);
  if (unit == "s") return scene.radius / scene.speed;
  if (quantity.key == "driving_torque" && scene.load) return *scene.load * scene.radius;
  return 1;
}

/// Over which an input changes an answer [SI], where its value says nothing of that: Poisson's ratio ends at 1/2,
/// creepage counts from rolling, temperature from the origin of its law, a torque from free rolling.
std::optional<double> length_of_change(const RollingScene& scene, std::string_view key, double value) {
  constexpr double least_of_ratio = 0.05, least_creepage = 0.01, kelvins = 10, of_friction = 0.2;
  if (key.ends_with("poisson_ratio")) return std::max(0.5 - value, least_of_ratio);
  if (key == "rotation_ratio") return std::clamp(std::abs(1 - value), least_creepage, std::max(std::abs(value), 1.0));
  if (is_temperature(key)) return kelvins;
  const double torque = of_friction * friction_law(scene).slope(0) * scene.load.value_or(0) * scene.radius;
  if (key == "driving_torque" && torque > 0) return std::max(std::abs(value), torque);
  return std::nullopt;
}

Variable variable_of(const RollingScene& base, const Quantity& quantity, const std::optional<double>& value,
                     const InputChoice& choice) {
  if (!value) throw std::invalid_argument(choice.key + ": must be in the scene to be varied");
  if (std::isinf(*value)) throw std::invalid_argument(choice.key + " = \"infinite\": must be finite to be varied");
  const Range& range = quantity.range;
  require(range.contains(*value), choice.key, *value, range.rule());
  for (const std::optional<double>& bound : {choice.lowest, choice.highest})
    if (bound) require(!std::isnan(*bound), choice.key, *bound, "a bound must be a number");

  Variable variable{quantity, range.lowest, range.highest, Scaling::linear, 1};
  if (range.lowest_excluded) variable.lowest = std::nextafter(range.lowest, range.highest);
  if (choice.lowest) variable.lowest = std::max(variable.lowest, *choice.lowest);
  if (choice.highest) variable.highest = std::min(variable.highest, *choice.highest);
  require(*value >= variable.lowest && *value <= variable.highest, choice.key, *value, "must be inside its bounds");
  require(variable.lowest != variable.highest, choice.key, *value, "must have room between its bounds");

  const bool positive_quantity = range.lowest == 0 && (range.lowest_excluded || quantity.unit != "1");
  const bool logarithmic = choice.logarithmic.value_or(positive_quantity && *value > 0);
  if (logarithmic) variable.scaling = Scaling::logarithmic;
  require(!logarithmic || (*value > 0 && variable.lowest >= 0), choice.key, *value,
          "must be > 0 within its bounds to be varied in its logarithm");
  variable.size = *value != 0 ? std::abs(*value) : natural_size(base, quantity);
  variable.own_length = length_of_change(base, quantity.key, *value);
  return variable;
}

}  // namespace

double Variable::scaled(double value) const {
  switch (scaling) {
    case Scaling::linear:
      return value / size;
    case Scaling::logarithmic:
      return std::log(value);
    case Scaling::reciprocal:
      return -size / value;
  }
  return RollingSolution::absent;
}

double Variable::value(double scaled) const {
  if (scaling == Scaling::reciprocal) return scaled < 0 ? std::clamp(-size / scaled, lowest, highest) : highest;
  return std::clamp(scaling == Scaling::logarithmic ? std::exp(scaled) : scaled * size, lowest, highest);
}

double Variable::scaled_step(double from, double value) const {
  switch (scaling) {
    case Scaling::linear:
      return (value - from) / size;
    case Scaling::logarithmic:
      return std::log1p((value - from) / from);
    case Scaling::reciprocal:
      return (value - from) / from * (size / value);
  }
  return RollingSolution::absent;
}

double Variable::slope(double value) const {
  switch (scaling) {
    case Scaling::linear:
      return size;
    case Scaling::logarithmic:
      return value;
    case Scaling::reciprocal:
      return value * value / size;
  }
  return RollingSolution::absent;
}

std::vector<Variable> variables_of(const RollingScene& base, const std::vector<InputChoice>& inputs) {
  std::vector<Variable> variables;
  for (const InputChoice& choice : inputs) {
    for (const Variable& earlier : variables)
      if (earlier.quantity.key == choice.key) throw std::invalid_argument(choice.key + ": input given twice");
    const bool known = visit_input(base, choice.key, [&](const Quantity& quantity, const auto& value) {
      if constexpr (is_real<std::decay_t<decltype(value)>>)
        variables.push_back(variable_of(base, quantity, value, choice));
      else
        throw std::invalid_argument(choice.key + ": must be an input that is a real number");
    });
    if (known) continue;
    if (const std::string why = absent_layer(base, choice.key); !why.empty())
      throw std::invalid_argument(choice.key + ": " + why);
    refuse_key("input", choice.key, keys_like(choice.key));
  }
  return variables;
}

Quantity real_output(std::string_view key) {
  const std::optional<Quantity> output = output_quantity(key);
  const RollingSolution none;
  visit_outputs(none, [&](const Quantity& quantity, const auto& value) {
    if constexpr (!std::is_same_v<std::decay_t<decltype(value)>, double>)
      if (quantity.key == key)
        throw std::invalid_argument(std::string(key) + ": must be an output that is a real number");
  });
  if (!output) refuse_key("output", key, output_keys());
  return *output;
}

Objective objective(const RollingScene& base, const std::vector<InputChoice>& inputs, std::string_view output,
                    Evaluate evaluate) {
  return {base, variables_of(base, inputs), real_output(output), std::move(evaluate)};
}

double real_input(const RollingScene& scene, std::string_view key) {
  double number = RollingSolution::absent;
  visit_input(scene, key, [&](const Quantity&, const auto& value) {
    if constexpr (is_real<std::decay_t<decltype(value)>>)
      number = std::optional<double>(value).value_or(RollingSolution::absent);
  });
  return number;
}

void assign_real(RollingScene& scene, std::string_view key, double number) {
  visit_input(scene, key, [&](const Quantity&, auto& value) {
    if constexpr (is_real<std::decay_t<decltype(value)>>) value = number;
  });
}

std::vector<double> base_point(const Objective& objective) {
  std::vector<double> point;
  for (const Variable& variable : objective.variables)
    point.push_back(real_input(objective.base, variable.quantity.key));
  return point;
}

RollingScene scene_at(const Objective& objective, std::span<const double> point) {
  assert(point.size() == objective.variables.size());
  RollingScene scene = objective.base;
  for (std::size_t i = 0; i < point.size(); ++i) assign_real(scene, objective.variables[i].quantity.key, point[i]);
  const auto varies = [&](std::string_view key) {
    return std::any_of(objective.variables.begin(), objective.variables.end(),
                       [key](const Variable& variable) { return variable.quantity.key == key; });
  };
  // One method for all points: under a coating the spectral one takes incompressible surfaces only, and without one it
  // solves other equations at a ratio of 1/2, which differ by the error of either.
  if (!scene.coating_layers.empty()) {
    if (scene.method == Method::automatic && (varies("poisson_ratio") || varies("coating_layers[0].poisson_ratio")))
      scene.method = Method::newton;
  } else if (dimension_of(scene.indenter) == 2 && !scene.spacing && varies("poisson_ratio")) {
    constexpr double nearly_incompressible = 0.5 - 1e-13;
    scene.poisson_ratio = std::min(scene.poisson_ratio, nearly_incompressible);
  }
  return scene;
}

void require_inside(const Objective& objective, std::span<const double> point) {
  require(point.size() == objective.variables.size(), "size of the point", static_cast<double>(point.size()),
          "must be the number of inputs that vary");
  for (std::size_t i = 0; i < point.size(); ++i) {
    const Variable& variable = objective.variables[i];
    const std::string_view key = variable.quantity.key;
    require(std::isfinite(point[i]) && point[i] >= variable.lowest && point[i] <= variable.highest, key, point[i],
            "must be inside its bounds");
    require(variable.scaling != Scaling::logarithmic || point[i] > 0, key, point[i],
            "must be > 0 to be varied in its logarithm");
  }
}

ObjectiveValue value_at(const Objective& objective, std::span<const double> point) {
  ObjectiveValue answer;
  try {
    const RollingScene scene = scene_at(objective, point);
    if (objective.value_of) {
      answer.value = objective.value_of(scene);
      answer.status = Status::converged;
      if (!std::isfinite(answer.value)) answer.reason = std::string(objective.output.key) + ": has no value";
      return answer;
    }
    const RollingSolution solution = objective.evaluate(scene);
    answer.status = solution.status;
    answer.reason = solution.reason;
    if (std::isfinite(solution.error_estimate)) answer.relative_error = solution.error_estimate;
    if (solution.status == Status::converged) {
      answer.value = output_number(solution, objective.output.key);
      answer.reason = std::isfinite(answer.value) ? "" : std::string(objective.output.key) + ": absent from the answer";
    } else if (answer.reason.empty()) {
      answer.reason = name_of(solution.status);
    }
  } catch (const std::invalid_argument& error) {
    answer = {.reason = error.what()};
  }
  return answer;
}

std::optional<SampledLine::Sample> SampledLine::at(double offset) {
  if (offset == 0) return Sample{0, centre_, centre_error_};
  if (const auto found = known_.find(offset); found != known_.end()) return found->second;
  std::vector<double> point = point_;
  double& input = point[input_];
  input = variable().value(variable().scaled(centre_input()) + offset * length_);
  ++evaluations_;
  const ObjectiveValue answer = value_at(objective_, point);
  std::optional<Sample>& sample = known_[offset];
  if (answer.found())
    sample = {distance_to(input), answer.value, answer.relative_error};
  else
    failures_.push_back({input, answer.status, answer.reason});
  return sample;
}

}  // namespace rollres
