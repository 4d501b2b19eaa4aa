#include "fitting/fit/resistance_fit.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/material/material.hpp"
#include "core/material/material_functions.hpp"
#include "core/model/scene_rules.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/scene/scene_input.hpp"
#include "fitting/fit/scene_model.hpp"

namespace rollres {

namespace {

bool concerns(const FittedInput& input, const std::string& set) { return input.set.empty() || input.set == set; }

/// Evaluates until the fit is over, and enters it in the log. @throws Interrupted once it is over
Evaluate logging(const Evaluate& evaluate, const FitProblem& problem, const std::string& place,
                 const std::shared_ptr<std::atomic<bool>>& on_grid) {
  return [evaluate, log = problem.log, ending = problem.ending, place, on_grid](const RollingScene& scene) {
    if (ending->reached()) throw Interrupted();
    ending->count_solution();
    const Interruptible interruptible([&] { return ending->reached(); });
    const RollingSolution solution = evaluate(scene);
    if (solution.status == Status::converged && rollres::on_grid(solution.method)) *on_grid = true;
    if (solution.status == Status::converged)
      log->answered();
    else
      log->failed(place, solution.reason.empty() ? std::string(name_of(solution.status)) : solution.reason);
    return solution;
  };
}

/// What the model says, or that it was interrupted.
template <class Answer, class Work>
Answer unless_interrupted(const Work& work) {
  try {
    return work();
  } catch (const Interrupted& interrupted) {
    Answer none;
    none.reason = interrupted.what();
    return none;
  }
}

/// What a material does, as a measurement says.
double material_value(const RollingScene& scene, const MeasuredScene& measured, const std::string& output) {
  const double over_shear = measured.listed_moduli == ListedModuli::young ? 2 * (1 + scene.poisson_ratio) : 1;
  if (output == relaxation_modulus_key)
    return over_shear * relaxation_modulus(relaxation_spectrum(creep_spectrum(scene)), measured.time);
  if (output == creep_compliance_key) return creep_compliance(creep_spectrum(scene), measured.time) / over_shear;
  const std::complex<double> found = over_shear * complex_modulus(scene, measured.angular_frequency);
  return output == storage_modulus_key ? found.real() : found.imag();
}

/// What a measurement is of: an output by `evaluate`, or of the material, which costs nothing.
Objective objective_of(const MeasuredScene& measured, const std::string& usual, Evaluate evaluate) {
  const std::string& output = measured.output.empty() ? usual : measured.output;
  Objective objective{measured.scene, {}, measured_quantity(output), std::move(evaluate)};
  if (is_of_material(output))
    objective.value_of = [measured, output](const RollingScene& scene) {
      return material_value(scene, measured, output);
    };
  return objective;
}

/// An offset or a scale as a parameter. A tenth of a middle measured value is a large offset.
FitParameter term_parameter(const std::vector<MeasuredScene>& scenes, const FittedInput& input,
                            const std::string& name) {
  std::vector<double> sizes;
  std::string_view output;
  for (const MeasuredScene& row : scenes) {
    if (!concerns(input, row.set)) continue;
    if (!sizes.empty() && row.output != output && input.input.key == offset_key)
      throw std::invalid_argument(name + ": concerns values of different kinds: name its data set");
    output = row.output;
    sizes.push_back(std::abs(row.measured.value));
  }
  std::nth_element(sizes.begin(), sizes.begin() + std::ssize(sizes) / 2, sizes.end());
  const double middle = sizes[sizes.size() / 2], start = input.start.value_or(input.input.key == offset_key ? 0 : 1);
  Variable variable = term_variable(input.input.key, measured_quantity(output.empty() ? "rolling_resistance" : output),
                                    std::max({0.1 * middle, std::abs(start), std::numeric_limits<double>::min()}));
  variable.lowest = std::max(variable.lowest, input.input.lowest.value_or(variable.lowest));
  variable.highest = std::min(variable.highest, input.input.highest.value_or(variable.highest));
  return {name, variable, start};
}

/// What helps where nodes that enter and leave the contact make a scene's answers jump.
std::string noise_remedy(const std::vector<MeasuredScene>& scenes) {
  const auto fixed = find_if(scenes, [](const MeasuredScene& row) {
    return on_grid(resolved_method(row.scene)) && (row.scene.spacing || dimension_of(row.scene.indenter) == 2);
  });
  if (fixed == scenes.end()) return "";
  const RollingScene& scene = fixed->scene;
  RollingScene smooth = scene;
  smooth.spacing.reset();
  if (smooth.method == Method::newton) smooth.method = Method::automatic;
  const std::string jumps = "answers on a fixed grid jump where nodes enter and leave the contact";
  if (dimension_of(scene.indenter) == 2 && on_grid(resolved_method(smooth))) return jumps + ": take a smaller spacing";
  std::string keys;
  if (scene.spacing) keys = "spacing";
  if (dimension_of(scene.indenter) == 2 && scene.method != Method::automatic)
    keys += keys.empty() ? "method" : " and method";
  return jumps + ": leave out " + keys + " for smooth ones";
}

/// Where a quantity of bodies that roll usually lies; nothing where that may be anywhere.
struct UsualValues {
  std::string_view key;
  double lowest, highest;
  bool friction = false;
};
constexpr std::array<UsualValues, 3> usual_values{
    {{"friction_coefficient", 0.02, 1, true}, {"fractional_order", 0.2, 1}, {"poisson_ratio", 0.3, 0.5}}};

void add_usual_values(FitParameter& parameter) {
  const Quantity& quantity = parameter.variable.quantity;
  const std::string_view key = quantity.key;
  for (const UsualValues& usual : usual_values)
    if (key == usual.key || key.ends_with("." + std::string(usual.key))) {
      parameter.usual_lowest = usual.lowest;
      parameter.usual_highest = usual.highest;
      parameter.saturates = parameter.has_least = usual.friction;
    }
  constexpr double measured_badly = 1.5;  // lengths and loads are known to that at least
  if (quantity.unit == "m" || key == "load" || key == "speed") {
    parameter.usual_lowest = parameter.start / measured_badly;
    parameter.usual_highest = parameter.start * measured_badly;
  }
}

}  // namespace

Quantity measured_quantity(std::string_view output) {
  if (output == creep_compliance_key) return {creep_compliance_key, "", "1/Pa", "strain over the stress of a step"};
  for (const std::string_view modulus : {storage_modulus_key, loss_modulus_key, relaxation_modulus_key})
    if (output == modulus) return {modulus, "", "Pa", "modulus of the material"};
  return real_output(output);
}

std::vector<FitParameter> fit_parameters(const std::vector<MeasuredScene>& scenes,
                                         const std::vector<FittedInput>& inputs) {
  std::vector<FitParameter> parameters;
  for (const FittedInput& input : inputs) {
    const auto first = find_if(scenes, [&](const MeasuredScene& scene) { return concerns(input, scene.set); });
    if (first == scenes.end())
      throw std::invalid_argument(input.input.key + ": concerns no measured value of a data set \"" + input.set + '"');
    const std::string name = input.input.key + (input.set.empty() ? "" : " (" + input.set + ")");
    if (is_measured_term(input.input.key)) {
      parameters.push_back(term_parameter(scenes, input, name));
      continue;
    }
    RollingScene base = first->scene;
    if (input.start) assign_real(base, input.input.key, *input.start);
    const Variable variable = variables_of(base, {input.input}).front();
    const double start = base_point({base, {variable}, {}, {}}).front();
    parameters.push_back({name, variable, start});
    add_usual_values(parameters.back());
  }
  return parameters;
}

FitProblem resistance_problem(const std::vector<MeasuredScene>& scenes, const std::vector<FittedInput>& inputs,
                              const std::vector<FitParameter>& parameters, const Evaluate& evaluate,
                              const ResistanceFitOptions& options) {
  FitProblem problem;
  problem.parameters = parameters;
  const auto grid_seen = std::make_shared<std::atomic<bool>>(false);
  std::vector<SceneRow> rows;
  std::vector<std::string> sets;
  for (const MeasuredScene& measured : scenes) {
    SceneRow row{objective_of(measured, options.output, logging(evaluate, problem, measured.measured.place, grid_seen)),
                 {},
                 measured.measured.place};
    for (std::size_t j = 0; j < inputs.size(); ++j)
      if (concerns(inputs[j], measured.set) && !is_measured_term(inputs[j].input.key)) {
        row.objective.variables.push_back(problem.parameters[j].variable);
        row.columns.push_back(j);
      }
    rows.push_back(std::move(row));
    const auto set = std::find(sets.begin(), sets.end(), measured.set);
    problem.data.push_back(measured.measured);
    problem.data.back().set = static_cast<int>(set - sets.begin());
    problem.data.back().unit =
        measured_quantity(measured.output.empty() ? options.output : measured.output).unit_for(body_of(measured.scene));
    problem.data.back().along = is_curve(measured.output)         ? measured.time
                                : is_of_material(measured.output) ? measured.angular_frequency
                                                                  : measured.scene.speed;
    if (set == sets.end()) sets.push_back(measured.set);
  }
  const auto model = std::make_shared<SceneModel>(std::move(rows), inputs.size(), grid_seen, options.jobs);
  problem.model.by_rows = true;
  problem.model.predict = [model](const FitPoint& point, const DataRows& some) {
    return unless_interrupted<Prediction>([&] { return model->predict(point, some); });
  };
  problem.noise_remedy = noise_remedy(scenes);
  if (!options.step) {
    problem.model.differentiate = [model](const FitPoint& point, const Prediction& prediction) {
      return unless_interrupted<Slopes>([&] { return model->differentiate(point, prediction); });
    };
  } else {
    const FitProblem plain = problem;
    problem.model.differentiate = [model, plain, step = *options.step](const FitPoint& point,
                                                                       const Prediction& prediction) {
      return unless_interrupted<Slopes>([&] {
        model->calibrate_at(point);
        return differences(plain, point, prediction, step, model->noise_of(prediction));
      });
    };
  }
  std::vector<MeasuredTerm> terms;
  std::vector<KnownBefore> known;
  for (std::size_t j = 0; j < inputs.size(); ++j) {
    if (inputs[j].prior) known.push_back(known_before(*inputs[j].prior, j, parameters[j].name));
    if (inputs[j].smooth && j > 0) known.push_back(smooth_step(j - 1, j, *inputs[j].smooth, parameters[j].name));
    if (!is_measured_term(inputs[j].input.key)) continue;
    MeasuredTerm term{inputs[j].input.key == offset_key ? offset_key : scale_key, j, {}};
    for (const MeasuredScene& measured : scenes) term.acts.push_back(concerns(inputs[j], measured.set));
    terms.push_back(std::move(term));
  }
  return with_priors(with_terms(problem, std::move(terms)), known);
}

}  // namespace rollres
