#include "core/solve/rolling_contact.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "core/estimate/composite_estimate.hpp"
#include "core/estimate/grid_choice.hpp"
#include "core/estimate/linearity_error.hpp"
#include "core/finite_strain/finite_strain_contact.hpp"
#include "core/interior/interior_summary.hpp"
#include "core/messages/message_text.hpp"
#include "core/newton/grid_error.hpp"
#include "core/newton/grid_solution.hpp"
#include "core/newton/nested_newton.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/paper_method/active_set.hpp"
#include "core/scene/indenter_shape.hpp"
#include "core/solve/model_choice.hpp"
#include "core/solve/strain_iteration.hpp"
#include "core/solve/torque_limit.hpp"
#include "core/surface/contact_surface.hpp"
#include "core/surface/scene_rules.hpp"
#include "core/zones/spectral_contact.hpp"

namespace rollres {

namespace {

/// Nodes in contact beyond which a tolerance is given up.
constexpr int most_nodes_2d = 20000, most_nodes_3d = 250000;

/// Cells on the half-width of a sphere's contact, by steps of sqrt(2). No sum of two squares lies within 1.2 % of the
/// square of the usual number (step 0), nor of half and of a quarter of it (steps -1 and -2): where the contact is an
/// ellipse, no node is near its edge.
double tied_cells(int step) {
  constexpr double usual = 19.532;
  return usual * std::exp2(0.5 * step);
}
constexpr int coarsest_step = -2, most_steps = 3;  // where a tolerance begins; at a time, as coarse grids tell little

/// The same of a cylinder.
constexpr double cells_of_line = 60;

/// @param error of the rolling resistance [N] (per metre for a cylinder)
void set_error(double error, RollingSolution& solution) {
  solution.rolling_resistance_error = error;
  solution.error_estimate = error / std::abs(solution.rolling_resistance);
}

GridSeries grids_of(const RollingScene& scene) {
  if (dimensions(scene) == 3 && !scene.spacing) return tied_grids(scene, tied_cells(0));
  if (!scene.spacing && scene.adhesion_threshold == 0) return tied_lines(scene, cells_of_line);
  return fixed_grids(scene, scene.spacing.value_or(default_spacing(scene)));
}

/// A larger violation of the laws, in scenes far from any layer's, is mended by factorising systems of up to so many
/// nodes.
constexpr double trusted_violation = 1e-8;
constexpr int factorisable_nodes = 1000;

/// Of a solution on one grid beyond which no finer one is tried for a tolerance: GMRES vectors times unknowns, some
/// seconds.
constexpr double most_work = 2e7;

/// How many times finer in nodes than its finest grid a solution can be had for a tolerance's sake.
double room_for_nodes(const NestedOutcome& nested, int most_nodes) {
  const NewtonOutcome& outcome = nested.finest.outcome;
  const std::vector<Zone>& zone = outcome.zone;
  const int images = dimensions(nested.finest.problem->scene) - 1;
  const auto nodes =
      static_cast<double>(images * (zone.end() - zone.begin() - std::count(zone.begin(), zone.end(), Zone::free)));
  if (nodes * outcome.krylov_iterations > most_work) return 0;
  return most_nodes / nodes;
}

/// A sphere whose grid is tied to its contact: as many cells as the estimate on a coarser grid asks for.
NestedOutcome solve_sphere_to_tolerance(const RollingScene& scene, int most_nodes) {
  int step = coarsest_step;
  NestedOutcome found = solve_nested(scene, tied_grids(scene, tied_cells(step)));
  if (found.status != Status::converged) {
    step = 0;
    found = solve_nested(scene, tied_grids(scene, tied_cells(step)));
  }
  NestedOutcome best;  // of the grids before, where a finer one does not always tell more
  while (found.status == Status::converged) {
    const double room = room_for_nodes(found, most_nodes), missed = found.error_estimate() / *scene.tolerance;
    if (missed <= 1 || room < 2) break;
    // Nodes double with each step, and the error falls about as they grow.
    const double wanted = std::min(std::ceil(std::log2(missed)), std::floor(std::log2(room)));
    step += static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(most_steps)));
    try {
      NestedOutcome finer = solve_nested(scene, tied_grids(scene, tied_cells(step)));
      if (finer.status != Status::converged) break;
      best = better_of(std::move(found), std::move(best));
      found = std::move(finer);
    } catch (const BeyondLimits& limit) {
      found.reason = limit.what();
      break;
    }
  }
  return better_of(std::move(found), std::move(best));
}

/// @param most_nodes in contact; beyond, a tolerance is given up
NestedOutcome solve_on_grids(const RollingScene& scene, int most_nodes) {
  if (!scene.tolerance) return solve_nested(scene, grids_of(scene));
  if (dimensions(scene) == 3) return solve_sphere_to_tolerance(scene, most_nodes);
  return solve_nested(scene, grids_of(scene), [&](const NestedOutcome& nested) {
    return !(nested.error_estimate() <= *scene.tolerance) && room_for_nodes(nested, most_nodes) >= 2;
  });
}

RollingSolution answer_from(const NestedOutcome& nested, const RollingScene& scene) {
  RollingSolution solution;
  if (nested.status == Status::converged) {
    const ContactLevel& level = nested.finest;
    const auto summed = [&](const InfluenceOperator& influence) {
      return summarise(*level.problem, influence, level.outcome.unknowns, level.outcome.zone, level.edge);
    };
    GridSolution answer = level.problem->friction
                              ? summed(*level.influence)
                              : summed(InfluenceOperator(scene, *level.table, level.problem->grid, true));
    solution = std::move(answer.solution);
    take_slow_rolling(scene, level.error, answer.powers, solution);
    set_error(nested.error_estimate(level.error, solution.rolling_resistance), solution);
    if (scene.tolerance && !(solution.rolling_resistance_error <= *scene.tolerance * answer.powers.scale())) {
      std::ostringstream text;
      text << "the tolerance " << *scene.tolerance << " was not reached with " << solution.contact_nodes
           << " nodes: estimated error " << solution.error_estimate;
      if (!nested.reason.empty()) text << "; " << nested.reason;
      solution.warnings.push_back(text.str());
    }
  }
  solution.status = nested.status;
  if (nested.status != Status::converged) solution.reason = nested.reason;
  if (nested.status == Status::not_converged && scene.period && nested.finest.problem) {
    // Without waves as short as two cells the nodes do not tell neighbours apart.
    const double shortest = *scene.period / scene.series_terms, spacing = nested.finest.problem->grid.spacing_x;
    if (shortest > 2 * spacing)
      solution.reason += message_text("; series_terms = ", scene.series_terms, " keeps waves down to ", shortest,
                                      " m, longer than two cells of ", spacing, " m");
  }
  solution.friction_needed = nested.friction_needed;
  solution.friction_borne = nested.friction_borne;
  solution.iterations = nested.finest.outcome.iterations;
  return solution;
}

/// Unknowns on rows y >= 0 from those on the whole grid; `asymmetry` is the largest difference to the mirror image over
/// the largest pressure.
ContactUnknowns upper_half(const ContactState& state, const SurfaceGrid& half, double& asymmetry) {
  ContactUnknowns unknowns;
  unknowns.approach = state.approach;
  unknowns.rotation_ratio = std::isnan(state.rotation_ratio) ? 0 : state.rotation_ratio;
  const double scale = state.pressure.cwiseAbs().maxCoeff();
  const auto keep = [&](const Vector& whole, double parity) {
    if (whole.size() == 0) return whole;
    const Eigen::Index size = half.size();
    const Vector upper = whole.tail(size);
    asymmetry = std::max(asymmetry, (mirrored(half, upper, parity) - whole).cwiseAbs().maxCoeff() / scale);
    return upper;
  };
  unknowns.pressure = keep(state.pressure, 1);
  unknowns.shear_x = keep(state.shear_x, 1);
  unknowns.shear_y = keep(state.shear_y, -1);
  return unknowns;
}

/// An answer of the paper's method on one grid.
struct PaperAnswer {
  RollingSolution solution;
  ContactPowers powers;
  GridError error;
};

/// The paper's method on one grid, which grows until the contact keeps clear of its border.
PaperAnswer solve_paper(const RollingScene& scene, double spacing) {
  double half_width = std::min(1.3 * estimate_contact(scene).half_width + 2 * spacing, widest_window(scene));
  for (;; half_width = std::min(1.4 * half_width, widest_window(scene))) {
    const SurfaceGrid half = window(scene.indenter, spacing, half_width);
    const InfluenceTable table = influence_table(scene, mirrored(half));
    const ContactState state = solve_active_set(scene, table, mirrored(half));
    if (state.reached_border && half_width < widest_window(scene)) continue;
    PaperAnswer answer;
    RollingSolution& solution = answer.solution;
    if (state.status == Status::converged) {
      double asymmetry = 0;
      const ContactUnknowns unknowns = upper_half(state, half, asymmetry);
      const std::vector<Zone> zone(state.zone.end() - half.size(), state.zone.end());
      const ContactProblem problem(scene, half);
      const InfluenceOperator influence(scene, table, half, true);
      GridSolution summed = summarise(problem, influence, unknowns, zone);
      solution = std::move(summed.solution);
      answer.powers = summed.powers;
      solution.law_violation = std::max(solution.law_violation, asymmetry);
      answer.error = grid_error(problem, unknowns.pressure, zone, answer.powers);
    }
    solution.status = state.status;
    solution.reason = state.reason;
    solution.friction_needed = state.friction_needed;
    solution.iterations = state.iterations;
    solution.method = Method::active_set;
    return answer;
  }
}

/// The paper's method, and its error by a second solution at twice the spacing.
RollingSolution solve_paper(const RollingScene& scene) {
  const double spacing = scene.spacing.value_or(default_spacing(scene));
  auto [solution, powers, error] = solve_paper(scene, spacing);
  if (solution.status != Status::converged) return solution;
  const RollingSolution coarser = solve_paper(scene, 2 * spacing).solution;
  const double change = coarser.status == Status::converged
                            ? std::abs(coarser.rolling_resistance - solution.rolling_resistance)
                            : RollingSolution::absent;
  take_slow_rolling(scene, error, powers, solution);
  const double to_come = expected_change(dimensions(scene), change, RollingSolution::absent, powers);
  set_error(error.estimate(solution.rolling_resistance, to_come), solution);
  return solution;
}

void require_valid(const RollingScene& scene) {
  const std::vector<std::string> broken = check(scene);
  if (broken.empty()) return;
  std::string message = broken.front();
  for (std::size_t i = 1; i < broken.size(); ++i) message += "; " + broken[i];
  throw std::invalid_argument(message);
}

/// Of a grid that stands in for continuous edges where no tolerance is given: nearer to what those would give than the
/// usual grid, as long as it is quick.
constexpr double tolerance_for_spectral = 3e-4;
constexpr int most_nodes_for_spectral = 2000;

/// @param zones  of much the same scene, where they are known; those of this one afterwards
RollingSolution solve_by_method(const RollingScene& scene, std::optional<FoundZones>& zones) {
  const Method method = resolved_method(scene);
  std::string note;
  if (method == Method::spectral) {
    SpectralOutcome found = solve_spectral(scene, zones);
    zones = found.zones;
    if (found.solution) return std::move(*found.solution);
    note = found.reason;
  }
  if (method == Method::active_set) return solve_paper(scene);
  if (method == Method::finite_strain) return solve_finite_strain(scene);
  const bool asked = scene.method != Method::automatic || scene.indenter == Indenter::sphere || scene.spacing;
  if (const std::string refusal = asked ? "" : spectral_refusal(scene); !refusal.empty()) note = refusal;
  RollingScene gridded = scene;
  int most_nodes = dimensions(scene) == 3 ? most_nodes_3d : most_nodes_2d;
  if (method == Method::spectral && !scene.tolerance) {
    gridded.inertia = inertia_included(scene) ? Inertia::on : Inertia::off;  // not for this tolerance's sake
    gridded.tolerance = tolerance_for_spectral;
    most_nodes = most_nodes_for_spectral;
  }
  RollingSolution solution = answer_from(solve_on_grids(gridded, most_nodes), scene);
  if (solution.status == Status::converged && !(solution.law_violation <= trusted_violation) &&
      solution.contact_nodes <= factorisable_nodes) {
    gridded.method = Method::newton_dense;
    solution = answer_from(solve_on_grids(gridded, std::min(most_nodes, factorisable_nodes)), scene);
  }
  solution.method = method == Method::newton_dense ? method : Method::newton;
  if (note.empty()) return solution;
  if (solution.status == Status::converged)
    solution.model += "; solved on a grid, not with continuous edges: " + note;
  else if (solution.status == Status::not_converged)
    solution.reason += "; no answer with continuous edges either: " + note;
  return solution;
}

/// Load times the longer half of the contact over the radius [N]: what a resistance is small or large against.
double lever_of_load(const RollingScene& scene, const RollingSolution& solution) {
  return solution.load * std::max(std::abs(solution.leading_edge), std::abs(solution.trailing_edge)) / scene.radius;
}

/// What an elastic layer resists with is rounding and the grid's, of the lever of the load.
bool resists(const RollingScene& scene, const RollingSolution& solution) {
  return std::abs(solution.rolling_resistance) >= negligible_resistance * lever_of_load(scene, solution);
}

/// Whether the error stated is more than a tolerance asks for; an elastic layer resists with nothing.
bool misses_tolerance(const RollingScene& scene, const RollingSolution& solution) {
  const double scale = std::max(std::abs(solution.rolling_resistance), 1e-6 * lever_of_load(scene, solution));
  return scene.tolerance && solution.rolling_resistance_error > *scene.tolerance * scale;
}

/// From the first node in contact along x to the last [m].
double length_of_nodes(const SurfaceFields& fields) {
  int first = fields.grid.columns, last = -1;
  for (std::size_t i = 0; i < fields.zone.size(); ++i) {
    const auto column = static_cast<int>(i) % fields.grid.columns;
    if (fields.zone[i] == Zone::free) continue;
    first = std::min(first, column);
    last = std::max(last, column);
  }
  return (last - first) * fields.grid.spacing_x;
}

/// Why an answer that its method calls converged is none; empty if it is one.
std::string doubt(const RollingScene& scene, const RollingSolution& solution) {
  if (!(solution.law_violation <= trusted_violation))
    return message_text("a law of contact is violated by ", solution.law_violation, ", more than ", trusted_violation);
  if (!(solution.rolling_resistance_error >= 0)) return "the error of the rolling resistance cannot be estimated";
  const double length =
      on_grid(solution.method) ? length_of_nodes(solution.fields) : solution.leading_edge - solution.trailing_edge;
  if (on_grid(solution.method) && !(length >= 1.5 * solution.spacing))
    return message_text("the contact has only ", solution.contact_nodes, " nodes: take a spacing below ",
                        std::min(solution.spacing, length + solution.spacing) / 8, " m");
  if (!resists(scene, solution)) return {};
  const double resistance = solution.rolling_resistance, lever = lever_of_load(scene, solution);
  // Printed kinematics leave a power of this order in the balance of a driven body.
  const double reach = scene.kinematics == Kinematics::printed ? lever / solution.load : 0;
  const double unbalanced = std::abs(solution.driving_torque) / scene.radius * reach * reach;
  if (resistance < -unbalanced - solution.rolling_resistance_error)
    return message_text("the body would gain power: rolling resistance ", resistance, " with an estimated error of ",
                        solution.error_estimate);
  // What the edges of the contact take between nodes (core/newton/README.md, (N15)); on random scenes a third of this.
  const double cells = on_grid(solution.method) ? 0.5 * length / solution.spacing : INFINITY;
  const double balanced =
      std::max({trusted_balance, solution.error_estimate, lever / std::abs(resistance) / std::pow(cells, 1.5)});
  if (solution.energy_residual > balanced)
    return message_text("the power balance misses ", solution.energy_residual, " of it, more than ", balanced);
  return {};
}

/// @param error relative to the rolling resistance
void add_error(double error, RollingSolution& solution) {
  solution.error_estimate += error;
  solution.rolling_resistance_error += error * std::abs(solution.rolling_resistance);
}

/// Why an answer that holds the laws says nothing of the rolling resistance; empty if it does, or where the resistance
/// is none beside the lever of the load, as an elastic layer's.
std::string unknown_resistance(const RollingScene& scene, const RollingSolution& solution) {
  const double resistance = std::abs(solution.rolling_resistance), error = solution.rolling_resistance_error;
  if (error <= resistance || !resists(scene, solution)) return {};
  const char* advice = scene.spacing     ? "give a smaller spacing, or a tolerance in its place"
                       : scene.tolerance ? "give a larger time_limit or memory_limit"
                                         : "give a tolerance, such as 0.01";
  return message_text("the rolling resistance, ", solution.rolling_resistance, ", has an estimated error of ", error,
                      ", more than itself: ", advice);
}

/// An answer that is none, for a reason.
RollingSolution without_answer(Method method, std::string reason) {
  RollingSolution solution;
  solution.method = method;
  solution.reason = std::move(reason);
  return solution;
}

/// What the expansion of memories in fixed times, on grids of composite surfaces, changes R_r by at most [1].
double expansion_share(const RollingScene& scene, const RollingSolution& solution) {
  constexpr double amplified = 3;  // phases, of which R_r is made, are worse than compliances
  if (!is_composite(scene) || scene.period || !on_grid(solution.method)) return 0;
  return amplified * expansion_error(scene);
}

/// Adds to a method's answer what does not depend on the method.
RollingSolution solve_in_flow(const RollingScene& given, std::optional<FoundZones>& zones) {
  const ModelChoice choice = choose_model(given);
  RollingScene model = choice.scene;
  model.tolerance = given.tolerance;
  RollingSolution solution;
  std::string refused = unanswered_inertia(model);
  if (refused.empty()) refused = unbearable_torque(model);
  if (refused.empty()) {
    solution = solve_by_method(choice.scene, zones);
    if (solution.status == Status::converged) refused = unanswered_inertia(model, solution);
  }
  if (!refused.empty()) {
    solution = {};
    solution.status = Status::no_steady_state;
    solution.method = resolved_method(model);
    solution.reason = refused;
  }
  if (const std::string why = solution.status == Status::converged ? doubt(model, solution) : ""; !why.empty())
    solution = without_answer(solution.method, why);
  if (solution.status == Status::converged) {
    bool missed_said = misses_tolerance(choice.scene, solution);  // by the method
    // No passive layer gives power: what is negative is error.
    if (-solution.rolling_resistance > solution.rolling_resistance_error)
      set_error(-solution.rolling_resistance, solution);
    if (solution.energy_residual > trusted_balance && resists(model, solution)) {
      const double missed = solution.energy_residual * std::abs(solution.rolling_resistance);
      solution.error_estimate = std::max(solution.error_estimate, solution.energy_residual);
      solution.rolling_resistance_error = std::max(solution.rolling_resistance_error, missed);
    }
    const std::string note = std::move(solution.model);
    solution.model = model_of(choice.scene, solution) + note;
    for (const std::string& decision : choice.decisions) solution.model += "; " + decision;
    add_error(choice.left_out + expansion_share(choice.scene, solution), solution);
    if (std::string why = unknown_resistance(given, solution); !why.empty())
      return without_answer(solution.method, std::move(why));
    const double half_width = 0.5 * (solution.leading_edge - solution.trailing_edge);
    if (const double error = spectrum_error(choice.scene, half_width); error > 0) {
      add_error(error, solution);
      solution.model += message_text("; what the master curve leaves open changes R_r by ", error, " (estimate)");
      if (error > std::min(0.05, given.tolerance.value_or(1))) {
        missed_said = true;
        solution.warnings.push_back(
            message_text("master curve: leaves the rolling resistance open by ", 100 * error,
                         " % (estimate): rows scatter, are too few or end near the frequencies of the contact, about ",
                         choice.scene.speed / (2 * std::numbers::pi * half_width), " Hz"));
      }
    }
    if (!missed_said && misses_tolerance(given, solution))
      solution.warnings.push_back(message_text("the tolerance ", *given.tolerance, " was not reached: estimated error ",
                                               solution.error_estimate));
    const auto missed = linearity_error(choice.scene, solution);
    if (missed) solution.model_error = missed->value;
    for (std::string& warning : warnings_for(choice.scene, solution, missed))
      solution.warnings.push_back(std::move(warning));
    // A half-space taken as rigid is the model's own choice of the depth that an approach is counted from.
    if (const std::string why = why_absent(given, "approach"); !why.empty() && std::isfinite(solution.approach)) {
      solution.approach = RollingSolution::absent;
      solution.model += "; no approach: " + why;
    }
  }
  return solution;
}

/// Whether the drive decides how fast a coating flows through the contact, and the answer depends on it.
bool flow_is_unknown(const RollingScene& scene) {
  return scene.friction_coefficient > 0 && scene.drive != Drive::rotation && coating_flow_counts(scene) &&
         coating_flow_counts(choose_model(scene).scene);
}

/// A coating flows at R Omega, which may only be known with the answer: R Omega/V = f is the root of ratio(f) - f,
/// found by secants. ratio(f) hardly depends on f; the first solution takes R_r to change no more than in proportion to
/// f.
RollingSolution solve_freely(RollingScene scene) {
  const bool searched = flow_is_unknown(scene);
  if (searched && !scene.coating_flow) scene.coating_flow = 1;
  std::optional<FoundZones> zones;
  RollingSolution solution = solve_in_flow(scene, zones);
  if (!searched) return solution;
  constexpr int most_solutions = 8;
  constexpr double share_of_error = 0.01;
  double response = 0, sensitivity = std::abs(solution.rolling_resistance);
  for (int solutions = 1; solution.status == Status::converged; ++solutions) {
    const double step = (solution.rotation_ratio - *scene.coating_flow) / (1 - response);
    const double left = sensitivity * std::abs(step);
    if (left <= share_of_error * solution.rolling_resistance_error || solutions == most_solutions) {
      if (left > solution.rolling_resistance_error)
        solution.warnings.push_back(
            message_text("the speed at which the coating flows was found to ", std::abs(step), " of V only"));
      add_error(left / std::abs(solution.rolling_resistance), solution);
      break;
    }
    const RollingSolution before = solution;
    *scene.coating_flow += step;
    if (!(*scene.coating_flow > 0)) {
      solution = {};
      solution.method = before.method;
      solution.reason =
          "this drive stops the coated body or turns it backwards; give rotation_ratio, with drive "
          "\"rotation\"";
      break;
    }
    solution = solve_in_flow(scene, zones);
    response = std::clamp((solution.rotation_ratio - before.rotation_ratio) / step, -2.0, 0.8);
    sensitivity = std::abs((solution.rolling_resistance - before.rolling_resistance) / step);
  }
  return solution;
}

/// What the scene asks for is part of the answer as it was asked for: methods meet it to their own rounding.
void take_over_what_was_asked(const RollingScene& scene, RollingSolution& solution) {
  if (scene.load) solution.load = *scene.load;
  if (scene.approach) solution.approach = *scene.approach;
  // Without friction a coating takes the torque that turns it, whatever drives the body.
  const bool felt = scene.friction_coefficient > 0 || scene.coating_layers.empty();
  if (felt && scene.drive == Drive::torque && scene.driving_torque) solution.driving_torque = *scene.driving_torque;
  if (felt && scene.drive == Drive::free && std::isfinite(solution.driving_torque)) solution.driving_torque = 0;
  if (scene.drive == Drive::rotation && scene.rotation_ratio) solution.rotation_ratio = *scene.rotation_ratio;
}

}  // namespace

RollingSolution solve(const RollingScene& scene) {
  const auto begin = std::chrono::steady_clock::now();
  const SolutionLimits limits(scene.memory_limit.value_or(usual_memory_limit()),
                              scene.time_limit.value_or(usual_time_limit));
  RollingSolution solution;
  const auto refused = [&](const std::string& reason) {
    solution.method = resolved_method(scene);
    solution.reason = reason;
  };
  try {
    require_valid(scene);
    solution = softens(scene) ? solve_softening(scene, solve_freely) : solve_freely(scene);
    if (scene.interior == Interior::on && solution.status == Status::converged) add_interior(scene, solution);
  } catch (const BeyondLimits& limit) {
    refused(limit.what());
  } catch (const std::domain_error& error) {
    refused(error.what());
  } catch (const std::bad_alloc&) {
    refused("this scene needs more memory than there is; give a larger spacing or tolerance");
  }
  take_over_what_was_asked(scene, solution);
  solution.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return solution;
}

}  // namespace rollres
