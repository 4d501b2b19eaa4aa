#include <algorithm>
#include <array>
#include <cmath>

#include "core/derivatives/objective.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/scene_rules.hpp"
#include "core/solve/doubts.hpp"
#include "studies/relations/relations.hpp"
#include "studies/scene_io/solution_json.hpp"

namespace rollres {

namespace {

/// What an output is measured against where it may vanish, and what discretisation may do to it beyond the stated
/// errors of R_r.
struct ComparedOutput {
  std::string_view key;
  enum { own, resistance, force, torque, length, rotation, shear, bond, power, temperature } scale = own;
  double cells = 0;   ///< of a cell's share of the contact, where cells differ [1]
  double smooth = 0;  ///< of its power of 3/2: what edges between nodes do to integrals over the contact [1]
  double points = 0;  ///< with continuous edges, of a peak that is looked for between the points of a solution [1]
};

constexpr std::array<ComparedOutput, 41> compared_outputs{{{"rolling_resistance", ComparedOutput::resistance},
                                                           {"driving_force", ComparedOutput::force, 0, 1},
                                                           {"driving_torque", ComparedOutput::torque, 0, 1},
                                                           {"rotation_ratio", ComparedOutput::rotation, 5},
                                                           {"axial_force", ComparedOutput::force, 1},
                                                           {"lateral_force", ComparedOutput::force, 1},
                                                           {"spin_moment", ComparedOutput::torque, 1},
                                                           {"creepage_y", ComparedOutput::rotation, 1},
                                                           {"approach", ComparedOutput::own, 0, 1},
                                                           {"load", ComparedOutput::own, 0, 1},
                                                           {"leading_edge", ComparedOutput::length, 1.5},
                                                           {"trailing_edge", ComparedOutput::length, 1.5},
                                                           {"half_width", ComparedOutput::own, 3},
                                                           {"contact_area", ComparedOutput::own, 3},
                                                           {"mean_pressure", ComparedOutput::own, 3},
                                                           {"peak_pressure", ComparedOutput::own, 2, 0, 3e-4},
                                                           {"peak_shear_x", ComparedOutput::shear, 5, 0, 1e-3},
                                                           {"peak_shear_y", ComparedOutput::shear, 5, 0, 1e-3},
                                                           {"viscous_loss", ComparedOutput::power, 1},
                                                           {"frictional_loss", ComparedOutput::power, 1},
                                                           {"deflection"},
                                                           {"peak_deflection"},
                                                           {"peak_shear_strain"},
                                                           {"strain_amplitude"},
                                                           {"peak_strain_amplitude"},
                                                           {"bond_shear", ComparedOutput::bond},
                                                           {"bond_tension", ComparedOutput::bond},
                                                           {"interior_loss", ComparedOutput::power},
                                                           {"softening"},
                                                           {"mean_temperature", ComparedOutput::temperature},
                                                           {"peak_temperature", ComparedOutput::temperature},
                                                           {"bond_temperature", ComparedOutput::temperature},
                                                           {"surface_temperature", ComparedOutput::temperature},
                                                           {"temperatures[1]", ComparedOutput::temperature},
                                                           {"temperatures[2]", ComparedOutput::temperature},
                                                           {"sublayer_temperatures[0]", ComparedOutput::temperature},
                                                           {"sublayer_temperatures[1]", ComparedOutput::temperature},
                                                           {"heat_to_air", ComparedOutput::power},
                                                           {"heat_to_ground", ComparedOutput::power},
                                                           {"heat_to_core", ComparedOutput::power},
                                                           {"fourier"}}};

/// The error that an answer states for an output, in its unit; NaN where it states none.
double own_error(const RollingSolution& solution, std::string_view key) {
  if (key == "leading_edge" || key == "trailing_edge" || key == "half_width") return solution.edge_error;
  if (key == "contact_area") return solution.contact_area_error;
  if (key == "mean_pressure") return solution.mean_pressure * solution.contact_area_error / solution.contact_area;
  if (key == "peak_pressure") return solution.peak_pressure_error;
  if (key == "deflection" || key == "peak_deflection") return solution.deflection_error;
  return RollingSolution::absent;
}

/// Load times the longer half of the contact over the radius [N].
double lever(const RollingScene& scene, const RollingSolution& s) {
  return s.load * std::max(std::abs(s.leading_edge), std::abs(s.trailing_edge)) / scene.radius;
}

/// What R_r is measured against [N].
double resistance_scale(const RollingScene& scene, const RollingSolution& s) {
  constexpr double least_share = 1e-2;
  return std::max(std::abs(s.rolling_resistance), least_share * lever(scene, s));
}

double scale_of(const ComparedOutput& output, const RollingScene& scene, const RollingSolution& s, double value) {
  const double own = std::abs(value), resistance = resistance_scale(scene, s);
  switch (output.scale) {
    case ComparedOutput::resistance:
      return resistance;
    case ComparedOutput::force:
      return std::max(own, resistance);
    case ComparedOutput::torque:
      return std::max(own, resistance * scene.radius);
    case ComparedOutput::length:
      return s.leading_edge - s.trailing_edge;
    case ComparedOutput::rotation:
      return std::max(std::abs(value - 1), 0.5 * (s.leading_edge - s.trailing_edge) / scene.radius);
    case ComparedOutput::shear:
      return std::max(own, 1e-3 * scene.friction_coefficient * s.peak_pressure);
    case ComparedOutput::bond:  // far below the pressure it is a difference of its waves
      return std::max(own, 1e-6 * s.peak_pressure);
    case ComparedOutput::power:
      return std::max(own, resistance * scene.speed);
    case ComparedOutput::temperature:  // by what the layers are warmed, and a kelvin at least
      return std::max(1.0, std::abs(s.peak_temperature - *scene.ambient_temperature));
    default:
      return own;
  }
}

/// An output of the mirror image across the motion.
double value_turned_back(const RollingSolution& solution, std::string_view key) {
  constexpr std::array<std::string_view, 4> odd{"axial_force", "lateral_force", "spin_moment", "creepage_y"};
  return (contains(odd, key) ? -1 : 1) * output_number(solution, key);
}

/// A mirror image changes the sign of what points along x, and its edges change places.
double mirrored_value(const RollingSolution& solution, std::string_view key) {
  if (key == "leading_edge") return -solution.trailing_edge;
  if (key == "trailing_edge") return -solution.leading_edge;
  const double value = output_number(solution, key);
  return key == "driving_force" || key == "driving_torque" ? -value : value;
}

/// The answers as the comparison needs them.
struct Compared {
  const RelatedScenes& scenes;
  const RollingSolution &one, &other;

  /// Whether both solved as many equations of the same layers on the same cells, and summed them up alike: memories
  /// shorter than a cell are added to one layer's resistance, and not to that of several; what grids tend to takes the
  /// place of what they have where changes halve.
  bool same_cells() const {
    for (const char* added : {"slow rolling", "that the grids tend to", "taken as rigid"})
      if ((one.model.find(added) == std::string::npos) != (other.model.find(added) == std::string::npos)) return false;
    const double spacing = one.spacing * scenes.factors.length;
    return on_grid(one.method) && one.method == other.method && one.contact_nodes == other.contact_nodes &&
           one.slip_nodes == other.slip_nodes && std::abs(other.spacing - spacing) <= 1e-9 * spacing;
  }
  double factor_of(std::string_view key) const {
    const Quantity output = real_output(key);
    return scenes.factors.of(output.unit_for(body_of(scenes.one))) * (output.grows_with_width() ? scenes.width : 1);
  }
  /// The larger share of a cell in the contact; 0 without a grid.
  static double cell_share(const RollingSolution& solution) {
    if (solution.method == Method::finite_strain) return 1.0 / solution.contact_nodes;
    return on_grid(solution.method) ? solution.spacing / (solution.leading_edge - solution.trailing_edge) : 0;
  }
  /// What either left out for its tolerance's sake, of which errors of edges, areas and peaks know nothing [1].
  double simplified() const {
    const auto left_out = [](const RollingSolution& solution) {
      return solution.model.find("which changes R_r by") != std::string::npos;
    };
    return left_out(one) || left_out(other) ? scenes.one.tolerance.value_or(0) : 0;
  }
  /// What both state as errors of R_r, over what it is measured against [1].
  double stated() const {
    return (one.rolling_resistance_error + other.rolling_resistance_error / factor_of("rolling_resistance")) /
           resistance_scale(scenes.one, one);
  }
  /// What discretisation leaves of an output whose errors are not stated: `share` of a cell in the contact.
  double unstated(const ComparedOutput& output, double share) const {
    constexpr double of_tolerance = 3;
    // A creepage that is given is met as well as one that is found, and hands that on to what friction makes of it.
    const bool drives = output.scale == ComparedOutput::force || output.scale == ComparedOutput::torque;
    const double cells = drives && scenes.one.drive == Drive::rotation && scenes.one.friction_coefficient > 0;
    // Losses are summed by themselves: they miss by what their balance with R_r does.
    const double balance = output.scale == ComparedOutput::power ? one.energy_residual + other.energy_residual : 0;
    return of_tolerance * scenes.one.tolerance.value_or(1e-8) + (output.cells + cells) * share +
           output.smooth * std::pow(share, 1.5) + output.points + (balance > 0 ? balance : 0);
  }
  /// What discretisation leaves of an output, relative to its scale.
  double left(const ComparedOutput& output, double scale) const {
    constexpr double beyond_stated = 1.5;
    const double resistance = beyond_stated * stated();
    if (output.scale == ComparedOutput::resistance) return std::max(resistance, scenes.resistance);
    const double first = own_error(one, output.key), second = own_error(other, output.key) / factor_of(output.key);
    const bool known = !std::isnan(first), both = known && !std::isnan(second);
    if (both) return beyond_stated * (first + second) / scale + simplified();
    if (!known && std::isnan(second))
      return resistance + unstated(output, std::max(cell_share(one), cell_share(other)));
    return resistance + unstated(output, cell_share(known ? other : one)) +
           beyond_stated * (known ? first : second) / scale;
  }
  double allowed(const ComparedOutput& output, double scale) const {
    // The direction of shear is that of the slip, which vanishes at the border of the zone that sticks. A temperature
    // is found to 1e-8 of itself, not of the warming.
    const bool loose = output.scale == ComparedOutput::shear || output.scale == ComparedOutput::temperature;
    const double exact = scenes.exact * (loose ? 30 : 1);
    if (scenes.strict) return scenes.sensitivity * exact;
    return scenes.sensitivity * (exact + of_shared_yield() + (same_cells() ? 0 : left(output, scale)));
  }
  /// Of two yielding sides the terms of second order in a/R are shared out by an estimate of the contact, which rests
  /// on the load or on the approach.
  double of_shared_yield() const {
    constexpr double per_square = 1e-3;
    const double half_length = 0.5 * (one.leading_edge - one.trailing_edge) / scenes.one.radius;
    return scenes.one.coating_layers.empty() ? 0 : per_square * half_length * half_length;
  }
};

/// Whether an answer says itself that an output may be off: "peak_pressure may be off by 10 % or more".
bool doubted(const RollingSolution& solution, std::string_view key) {
  return any_of(solution.warnings,
                [&](const std::string& warning) { return warning.starts_with(std::string(key) + " may be off"); });
}

/// Compares one output, and keeps it if it is the worst until now.
void compare_output(const Compared& compared, const ComparedOutput& output, RelationFinding& finding) {
  const RelatedScenes& scenes = compared.scenes;
  const double factor = compared.factor_of(output.key);
  const double one = output_number(compared.one, output.key);
  const double other = (scenes.mirrored      ? mirrored_value(compared.other, output.key)
                        : scenes.turned_back ? value_turned_back(compared.other, output.key)
                                             : output_number(compared.other, output.key)) /
                       factor;
  if (std::isnan(one) && std::isnan(other)) return;
  // Further states of a balance that is even for some kelvin are there by a thousandth of a kelvin, or not.
  if (output.key.starts_with("temperatures[") && !scenes.strict && std::isnan(one) != std::isnan(other)) return;
  if (doubted(compared.one, output.key) || doubted(compared.other, output.key)) return;
  const double scale = scale_of(output, scenes.one, compared.one, one);
  const double difference = scale > 0 ? std::abs(other - one) / scale : one == other ? 0 : INFINITY;
  const double allowed = compared.allowed(output, scale);
  const double ratio = std::isnan(difference) ? INFINITY : difference / allowed;
  if (ratio < finding.worst) return;
  finding.worst = ratio;
  finding.output = output.key;
  finding.difference = difference;
  finding.words = message_text<8>(output.key, ": ", one, " and ", other) +
                  message_text(", ", difference, " apart where ", allowed, " is allowed");
}

RelationFinding without_answer(RelationOutcome outcome, const std::string& which, const RollingSolution& without) {
  RelationFinding finding;
  finding.outcome = outcome;
  finding.words = message_text(which, name_of(without.status), ": ", without.reason);
  return finding;
}

RelationFinding compare_statuses(const RelatedScenes& scenes, const RollingSolution& one,
                                 const RollingSolution& other) {
  const bool first = one.status == Status::converged;
  if (first && other.status == Status::converged) return compare(scenes, one, other);
  if (!first && other.status != Status::converged) return without_answer(RelationOutcome::unanswered, "both: ", one);
  const RelationOutcome outcome = scenes.strict ? RelationOutcome::broken : RelationOutcome::one_sided;
  return first ? without_answer(outcome, "the first scene alone has an answer; the other: ", other)
               : without_answer(outcome, "the other scene alone has an answer; the first: ", one);
}

/// What memories expanded in fixed times leave of the influence coefficients of composite surfaces on a grid, as it
/// acts on what is a difference of phases [1].
double expansion_left(const RollingScene& scene, const RollingSolution& solution) {
  return solution.status == Status::converged ? expansion_share(ContactModel(scene), solution) : 0;
}

/// What is left of the speed at which a coating flows where the drive leaves it open: it is found to a hundredth of the
/// stated error (core/solve/coating_flow.hpp) [1].
double flow_left(const RollingScene& scene, const RollingSolution& solution) {
  const bool found = !scene.coating_layers.empty() && scene.friction_coefficient > 0 && scene.drive != Drive::rotation;
  constexpr double share_of_error = 0.01;
  return found && solution.status == Status::converged ? share_of_error * solution.error_estimate : 0;
}

/// Whether a limit ended an answer before its tolerance, or before there was one. How far it came is luck of the clock,
/// and so is whether another one took the same steps.
bool cut_short(const RollingSolution& solution) {
  const auto told = [](const std::string& words) {
    return words.find("was not reached") != std::string::npos || words.find("the time_limit of ") != std::string::npos;
  };
  return told(solution.reason) || any_of(solution.warnings, told);
}

RelationFinding solve_and_compare(const RelatedScenes& scenes, const Evaluate& evaluate, RollingScene& second) {
  const RollingSolution one = evaluate(scenes.one);
  second = scenes.other(one);
  // Without a first answer there may be nothing to give to the second.
  if (!check(second).empty()) return without_answer(RelationOutcome::unanswered, "the first: ", one);
  const RollingSolution other = evaluate(second);
  RelatedScenes related = scenes;
  related.strict = scenes.strict && !cut_short(one) && !cut_short(other);
  if (!related.strict)
    related.exact += expansion_left(scenes.one, one) + expansion_left(second, other) + flow_left(scenes.one, one) +
                     flow_left(second, other);
  return compare_statuses(related, one, other);
}

}  // namespace

RelationFinding compare(const RelatedScenes& scenes, const RollingSolution& one, const RollingSolution& other) {
  RelationFinding finding;
  const Compared compared{scenes, one, other};
  for (const ComparedOutput& output : compared_outputs)
    if (!contains(scenes.left_out, output.key)) compare_output(compared, output, finding);
  finding.outcome = finding.worst <= 1 ? RelationOutcome::kept : RelationOutcome::broken;
  return finding;
}

RelationFinding try_relation(const RelatedScenes& scenes, const Evaluate& evaluate) noexcept {
  RelationFinding finding;
  finding.outcome = RelationOutcome::broken;
  finding.worst = INFINITY;
  RollingScene second;
  try {
    finding = solve_and_compare(scenes, evaluate, second);
  } catch (const std::exception& error) {
    finding.words = error.what();
  } catch (...) {
    finding.words = "an exception of unknown type";
  }
  if (finding.outcome != RelationOutcome::kept) {
    finding.one = scene_json(scenes.one);
    finding.other = scene_json(second);
  }
  return finding;
}

}  // namespace rollres
