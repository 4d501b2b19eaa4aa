#include "core/solve/model_answer.hpp"

#include <algorithm>
#include <numbers>
#include <optional>
#include <utility>

#include "core/estimate/assumptions.hpp"
#include "core/estimate/composite_estimate.hpp"
#include "core/finite_strain/finite_strain_contact.hpp"
#include "core/given_pressure/given_pressure.hpp"
#include "core/material/master_curve.hpp"
#include "core/material/material_scale.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/absent_outputs.hpp"
#include "core/model/scene_rules.hpp"
#include "core/model/stated_error.hpp"
#include "core/newton/grid_solution.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/paper_method/paper_solution.hpp"
#include "core/solve/coating_flow.hpp"
#include "core/solve/doubts.hpp"
#include "core/solve/grid_answer.hpp"
#include "core/solve/model_notes.hpp"
#include "core/solve/torque_limit.hpp"
#include "core/solve/turned_axle.hpp"
#include "core/zones/spectral_contact.hpp"

namespace rollres {

namespace {

/// A grid in place of continuous edges where no tolerance is given: nearer to what those would give than the usual
/// grid, as long as it is quick.
RollingSolution solve_in_place_of_edges(ContactModel model) {
  constexpr double tolerance_for_spectral = 3e-4;
  constexpr int most_nodes_for_spectral = 2000;
  if (model.tolerance) return solve_on_grids(model, most_nodes(model));
  model.tolerance = tolerance_for_spectral;
  return solve_on_grids(model, most_nodes_for_spectral);
}

/// @param zones  of much the same model, where they are known; those of this one afterwards
RollingSolution solve_by_method(const ContactModel& model, std::optional<FoundZones>& zones) {
  if (model.loaded) return solve_given_pressure(model);
  if (model.method == Method::active_set) return solve_paper(model);
  if (model.method == Method::finite_strain) return solve_finite_strain(model);
  std::string why_on_grid;
  RollingSolution solution;
  if (model.method == Method::spectral) {
    SpectralOutcome found = solve_spectral(model, zones);
    zones = found.zones;
    if (found.solution) return std::move(*found.solution);
    why_on_grid = found.reason;
    solution = solve_in_place_of_edges(model);
  } else {
    const bool asked = model.asked_method != Method::automatic || model.dimension == 3 || model.spacing;
    if (!asked) why_on_grid = spectral_refusal(model);
    solution = model.skewed() && !asked ? solve_in_place_of_edges(model) : solve_on_grids(model, most_nodes(model));
  }
  if (why_on_grid.empty()) return solution;
  if (solution.status == Status::converged)
    solution.model += "; solved on a grid, not with continuous edges: " + why_on_grid;
  else if (solution.status == Status::not_converged)
    solution.reason += "; no answer with continuous edges either: " + why_on_grid;
  return solution;
}

/// While it lives time does not end: an answer that is there is judged and described, as it may be the best of those
/// for which a tolerance had time. The wish to stop is heard.
struct UntimedWork {
  SolutionLimits limits{usual_memory_limit()};
};

/// What a method answers, if it is an answer.
RollingSolution trusted_answer(const ContactModel& model, std::optional<FoundZones>& zones) {
  std::string refused = unanswered_inertia(model);
  if (refused.empty()) refused = unbearable_torque(model);
  if (!refused.empty()) return without_answer(model.method, Status::no_steady_state, refused);
  RollingSolution solution = solve_by_method(model, zones);
  if (solution.status != Status::converged) return solution;
  const UntimedWork untimed;
  refused = unanswered_inertia(model, solution);
  if (!refused.empty()) return without_answer(model.method, Status::no_steady_state, refused);
  if (std::string why = doubt(model, solution); !why.empty())
    return without_answer(solution.method, Status::not_converged, std::move(why));
  return solution;
}

/// Where the rows of a layer's table end, beside the frequency at which a contact asks for its moduli.
struct AskedOfTable {
  double frequency = 0;            ///< of the contact, at the temperature of the table's rows [Hz]
  double shift = 1;                ///< of that over the contact's own [1]
  double lowest = 0, highest = 0;  ///< of the rows [Hz]
  double temperature = 0;          ///< of the layer [K]; 0: none is given

  /// How far outside the rows, as a factor; at most 1 inside.
  double outside() const { return std::max(frequency / highest, lowest / frequency); }
};

/// What is asked of the table that it leaves farthest, of all layers that have one.
AskedOfTable asked_of_tables(const ContactModel& model, double contact_frequency) {
  AskedOfTable farthest;
  for (const ModelLayer* const layer : model.layers()) {
    if (!is_measured_curve(layer->material)) continue;
    const std::vector<double> rows = measured_curve(*layer).frequencies;
    const auto [lowest, highest] = std::minmax_element(rows.begin(), rows.end());
    const double shift = time_shift(*layer);
    const AskedOfTable asked{shift * contact_frequency, shift, *lowest, *highest, layer->temperature.value_or(0)};
    if (farthest.frequency == 0 || asked.outside() > farthest.outside()) farthest = asked;
  }
  return farthest;
}

/// "its rows end at 1e9 Hz, and the contact asks for about 7e11 Hz (...)", or what else may be wrong with them.
std::string why_left_open(const AskedOfTable& asked) {
  const std::string own = asked.shift == 1
                              ? std::string()
                              : message_text<3>(" (", asked.frequency / asked.shift, " Hz at ",
                                                in_celsius(asked.temperature), ", a_T = ", asked.shift, ")");
  if (asked.outside() <= 1)
    return message_text<3>("rows scatter, are too few or end near the frequencies of the contact, about ",
                           asked.frequency, " Hz") +
           own;
  const bool above = asked.frequency > asked.highest;
  return message_text<3>("its rows ", above ? "end" : "begin", " at ", above ? asked.highest : asked.lowest,
                         " Hz, and the contact asks for about ", asked.frequency, " Hz") +
         own;
}

/// Adds what a master curve leaves open. @return whether a warning says so
bool take_spectrum_error(const ContactModel& model, RollingSolution& solution) {
  const double half_width = 0.5 * (solution.leading_edge - solution.trailing_edge);
  const double error = spectrum_error(model, half_width);
  if (!(error > 0)) return false;
  add_error(error, solution);
  solution.model += message_text("; what the master curve leaves open changes R_r by ", error, " (estimate)");
  if (!(error > std::min(0.05, model.asked_tolerance.value_or(1)))) return false;
  solution.warnings.push_back(
      message_text("master curve: leaves the rolling resistance open by ", 100 * error, " % (estimate): ") +
      why_left_open(asked_of_tables(model, model.speed / (2 * std::numbers::pi * half_width))));
  return true;
}

/// A method's answer with what does not depend on the method: the model in words and the errors of the numbers.
/// @param zones  as above
RollingSolution judged_answer(const ContactModel& model, std::optional<FoundZones>& zones) {
  RollingSolution solution = trusted_answer(model, zones);
  if (solution.status != Status::converged) return solution;
  const UntimedWork untimed;
  const bool said_by_method = misses_tolerance(model, model.tolerance, solution);
  take_evidence(model, solution);
  const std::string note = std::move(solution.model);
  solution.model = model_of(model, solution) + note;
  for (const std::string& decision : model.decisions) solution.model += "; " + decision;
  const double expanded = expansion_share(model, solution);
  if (model.loaded) {
    solution.deflection_error += (model.left_out + expanded) * std::abs(solution.peak_deflection);
    add_error(model.left_out, solution);  // R_r of a given pressure rests on no expansion
  } else {
    add_error(model.left_out + expanded, solution);
  }
  if (std::string why = unknown_resistance(model, solution); !why.empty())
    return without_answer(solution.method, Status::not_converged, std::move(why));
  const bool said_by_material = take_spectrum_error(model, solution);
  if (!said_by_method && !said_by_material && misses_tolerance(model, model.asked_tolerance, solution))
    solution.warnings.push_back(tolerance_missed(*model.asked_tolerance, solution));
  return solution;
}

/// Adds what the model assumes, its error, and warnings.
void describe(const ContactModel& model, RollingSolution& solution) {
  const UntimedWork untimed;
  const std::vector<Assumption> assumed = assumptions(model, solution);
  for (const Assumption& assumption : assumed) solution.assumptions.push_back(in_words(assumption));
  solution.model_error = model_error(assumed).value_or(RollingSolution::absent);
  for (std::string& warning : warnings_for(model, solution, assumed)) solution.warnings.push_back(std::move(warning));
  // A half-space taken as rigid is the model's own choice of the depth that an approach is counted from.
  if (!why_absent(model, "approach").empty()) solution.approach = RollingSolution::absent;
}

RollingSolution solve_at_skew(const ContactModel& full) {
  std::optional<FoundZones> zones;
  std::optional<ContactModel> solved;  // the last one, whose answer is returned
  RollingSolution solution = solve_at_own_flow(full, [&](const ContactModel& model) {
    solved = model;
    return judged_answer(model, zones);
  });
  if (solution.status != Status::converged) {
    warn_of_materials(full, solution.warnings);  // of a table that is no material's there may be no answer
    return solution;
  }
  describe(*solved, solution);
  turn_to_travel(full, solution);
  return solution;
}

}  // namespace

RollingSolution solve_model(const ContactModel& full) { return solve_at_own_skew(full, solve_at_skew); }

}  // namespace rollres
