#include "core/newton/grid_error.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/material/material.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/contact_surface.hpp"
#include "core/newton/contact_powers.hpp"

namespace rollres {

namespace {

/// Moments of the creep spectrum, relative to the compliance at rest: tau' [s] and m [s2] of core/newton/README.md,
/// (N16), without memories that are long beside the contact: one that it cannot see would fill m.
struct CreepMoments {
  double rest = 0, first = 0, second = 0;
  double long_first = 0, long_second = 0;  // of memories that are not short: what tau' would have, what m has
};

/// @param longest  time in which the contact passes its half-length [s]
CreepMoments creep_moments(const CreepSpectrum& creep, double longest) {
  CreepMoments moments{.rest = creep.instantaneous};
  for (const CreepSpectrum::Term& term : creep.terms) moments.rest += term.compliance;
  for (const CreepSpectrum::Term& term : creep.terms) {
    const double over = std::pow(term.time / longest, 2), beyond = over / (1 + over);
    const double slow = term.compliance * term.time / moments.rest, near = slow / (1 + std::pow(over, 4));
    moments.first += near;
    moments.second += near * term.time;
    moments.long_first += beyond * slow;
    moments.long_second += beyond * near * term.time;
  }
  return moments;
}

/// Slopes of the squared pressure at the ends of a row's contact, summed [Pa2/m]: extrapolated from inside, as memories
/// distort the pressure beside the edge, and nodes there share the load of an edge that lies between them.
double edge_slopes(const Vector& pressure, Eigen::Index first, Eigen::Index last, double spacing) {
  const auto square = [&](Eigen::Index i) { return pressure(i) * pressure(i); };
  const Eigen::Index count = last - first + 1, step = std::max<Eigen::Index>(1, count / 8);
  if (count < 6) {  // as of an ellipse
    double largest = 0;
    for (Eigen::Index i = first; i <= last; ++i) largest = std::max(largest, square(i));
    return 8 * largest / (static_cast<double>(count) * spacing);
  }
  const auto end = [&](Eigen::Index edge, Eigen::Index inward) {
    const double near = square(edge + 2 * inward) - square(edge + inward);
    const double far = square(edge + 3 * inward) - square(edge + 2 * inward);
    const double steps_to_edge = 1.5 + 0.25 / static_cast<double>(step);
    return std::max(0.0, near + steps_to_edge * (near - far)) / (static_cast<double>(step) * spacing);
  };
  return end(first, step) + end(last, -step);
}

/// Integrals over the contact that the estimates are made of.
struct ContactIntegrals {
  double edge_slopes = 0;  // int sum |d(p^2)/dx| cos(alpha) dy, of W (N18), (N19)
  double roughness = 0;    // int int (dp/dx)^2 dx dy (N21)
  double half_length = 0;  // [m]
  double pressure = 0;     // int int p dx dy [N]
  double curved = 0;       // the same times the body's curvature, P/R of (N17) [N/m]
  double unbalanced = 0;   // what R_r has beyond that, with printed kinematics [N/m]
};

ContactIntegrals contact_integrals(const ContactProblem& problem, const Vector& pressure,
                                   const std::vector<Zone>& zone) {
  ContactIntegrals sums;
  const SurfaceGrid& grid = problem.grid;
  const double spacing = grid.spacing_x;
  struct Row {
    double y, half_length, edge_slopes;
  };
  std::vector<Row> rows;  // of the contact
  for (int row = 0; row < grid.rows; ++row) {
    const double width = grid.spacing_y * problem.images(grid.index(0, row));
    const Eigen::Index start = grid.index(0, row), end = start + grid.columns - 1;
    Eigen::Index first = -1, last = -1;
    for (Eigen::Index i = start; i <= end; ++i) {
      if (zone[static_cast<std::size_t>(i)] == Zone::free) continue;
      if (first < 0) first = i;
      last = i;
      const double force = width * spacing * pressure(i);
      sums.pressure += force;
      const double x = grid.x(static_cast<int>(i - start)), y = grid.y(row), curved = problem.shape.curvature(x, y);
      sums.curved += force * curved;
      sums.unbalanced += force * (problem.shape.resisting_curvature(x, y) - curved);
    }
    if (first < 0) continue;
    rows.push_back({grid.y(row) - grid.origin_y, 0.5 * static_cast<double>(last - first + 1) * spacing,
                    width * edge_slopes(pressure, first, last, spacing)});
    sums.half_length = std::max(sums.half_length, rows.back().half_length);
    for (Eigen::Index i = std::max(first, start + 1); i <= std::min(last + 1, end); ++i)
      sums.roughness += width * std::pow(pressure(i) - pressure(i - 1), 2) / spacing;
  }
  // The angle between the motion and the edge's normal, as of an ellipse.
  const double farthest = rows.empty() ? 0 : std::max(std::abs(rows.front().y), std::abs(rows.back().y));
  const double half_width = farthest + 0.5 * grid.spacing_y;
  for (const Row& row : rows) {
    const double across = row.y / half_width, along = std::sqrt(1 - across * across);
    sums.edge_slopes += row.edge_slopes * along / std::hypot(along, across * sums.half_length / half_width);
  }
  return sums;
}

/// Share of friction in the loss up to which the viscous loss alone is mended: beyond, errors of both balance.
constexpr double negligible_friction = 0.01;
constexpr double least_share = 0.05;    // of the slow limit, below which the grid is left alone
constexpr double largest_second = 0.5;  // second term of (N18) over the first, beyond which it is not used

/// Warns where a memory shorter than a cell may cost more than a hundredth of the rolling resistance.
void warn_of_memory(const GridError& error, RollingSolution& solution) {
  const double lost = (1 - error.slow_share) * error.unresolved / std::abs(solution.rolling_resistance);
  if (lost > 0.01)
    solution.warnings.push_back("unresolved memory: the memory length Vτ = " + message_text(error.memory_length) +
                                " m is short against the spacing " + message_text(solution.spacing) +
                                " m, and may cost " + message_text(lost) + " of the rolling resistance");
}

}  // namespace

double open_friction(int dimension, const ContactPowers& powers) {
  constexpr double of_sphere = 0.3, of_line = 0.8, where_all_stick = 4;
  const double open = dimension == 3 ? powers.open_shear() : powers.sticking;
  const double told =
      (powers.by_law == 0 ? where_all_stick : 1) * (powers.share + (1 - powers.share) * std::sqrt(open));
  return (dimension == 3 ? of_sphere : of_line) * told * powers.half_cell();
}

double open_load(int dimension, const ContactPowers& powers) {
  constexpr double of_load = 0.05, load_order = 1.5;
  if (dimension == 2 || !powers.load_found) return 0;
  return of_load * std::abs(powers.resistance()) * std::pow(powers.cells, -load_order);
}

double expected_change(int dimension, double last, double before) {
  if (dimension == 3) return last;
  constexpr double part = 0.15;
  if (std::isnan(last)) return part * before;
  return std::isnan(before) ? last : std::hypot(last, part * before);
}

namespace {

/// Of a sphere (N22a): what cells at the edge and friction's one-sided differences are known to do on such a grid, and
/// what the last change is beyond that.
double sphere_change(double last, const ContactPowers& powers, const EdgeTrust& trust) {
  constexpr double of_edge = 2e-4, edge_order = 2.5, usual_cells = 18, of_friction = 0.8, friction_order = 1.2;
  const double lever = (1 - powers.share) * powers.halves + powers.share * 10 * std::abs(powers.resistance());
  const double edge = of_edge * lever * std::pow(usual_cells / powers.cells, edge_order), open = powers.open_shear();
  // Slip zones narrower than a few cells are told by the half cell alone.
  const double friction =
      std::hypot(of_friction * std::sqrt(open) * std::abs(powers.friction) * std::pow(powers.cells, -friction_order),
                 open_friction(3, powers));
  const double load = open_load(3, powers);
  const double beyond = std::max(0.0, last - 2.5 * (edge + friction));
  // The edge's correction leaves less of both: of friction's where nodes stick and memories are resolved.
  constexpr double edge_corrected = 0.6, friction_corrected = 0.8;
  const double lost = GridError::of_unresolved * trust.unresolved, sliding = 1 - powers.sticking;
  const double resolved = friction > 0 ? friction / (friction + lost) : 0;
  const double edge_left = (1 - edge_corrected * trust.pressure) * edge;
  const double friction_left = (1 - friction_corrected * trust.slip * (1 - sliding * sliding) * resolved) * friction;
  return std::hypot(std::hypot(edge_left, friction_left, (0.36 + 0.64 * powers.share) * beyond), load);
}

}  // namespace

EdgeTrust edge_trust(const ContactModel& model, double trust, const GridError& error) {
  const auto incompressible = [](const MaterialInputs& layer) {
    return std::max(0.0, 1 - 2 * (1 - 2 * layer.poisson_ratio) / (1 - layer.poisson_ratio));
  };
  double slip = trust * incompressible(model.top());
  if (!model.coating.empty()) slip *= incompressible(model.coating.front());
  return {trust, slip, error.unresolved};
}

double expected_change(int dimension, double last, double before, const ContactPowers& powers, const EdgeTrust& edge) {
  const double missing = powers.missing(), open = open_friction(dimension, powers);
  if (std::isnan(last)) return std::max(5 * missing, dimension == 3 ? sphere_change(0, powers, edge) : open);
  if (dimension == 3) return sphere_change(last, powers, edge);
  if (std::isnan(before)) return std::max({2 * last, 0.5 * missing, open});
  constexpr double all = 0.42, of_before = 0.3, of_missing = 0.75;  // calibrated, as (N22) says
  return std::hypot(all * std::hypot(last, of_before * before), all * of_missing * missing, open);
}

double expected_change_of_tied_line(double last, double before, const ContactPowers& powers) {
  if (std::isnan(last) || std::isnan(before)) return expected_change(2, last, before, powers);
  // Where changes fall quickly, what is still to come is less than the last one; luck may lessen one.
  constexpr double all = 0.75, quickest = 0.4, slowest = 0.7, of_missing = 0.12;
  const double falling = before > 0 ? std::clamp(last / before, quickest, slowest) : slowest;
  return std::hypot(all * std::sqrt(falling) * expected_change(2, last, before), all * of_missing * powers.missing(),
                    open_friction(2, powers));
}

double GridError::estimate(double resistance, double change, double open_still) const {
  const double mended = slow_share * std::min(1.0, std::abs(slow_loss / resistance));
  constexpr double of_steps = 0.7;  // of thin incompressible layers under spheres, of what was mended, at most
  return 1.25 * std::hypot((1 - mended) * change, mended * open_still) + of_unresolved * (1 - slow_share) * unresolved +
         slow_share * slow_error + of_steps * steps * std::abs(resistance);
}

namespace {

/// Resistance of memories that a grid answers too weakly [N], and the length of the one that counts most [m].
struct UnresolvedMemory {
  double resistance = 0, length = 0;
};

/// (N21), over the memories of what the contact sees on either side.
UnresolvedMemory unresolved_memory(const ContactModel& model, double spacing, const ContactIntegrals& sums) {
  constexpr double of_grid = 0.7;
  UnresolvedMemory sum;
  double largest = 0;
  const auto add = [&](const ModelLayer& layer, double flow) {
    for (const CreepSpectrum::Term& term : layer.creep.terms) {
      const double memory = model.speed * flow * term.time, over = memory / sums.half_length, cells = memory / spacing;
      const double lost = of_grid * (1 - layer.poisson_ratio) * term.compliance * memory * spacing * sums.roughness /
                          (1 + over * over) / (1 + cells * (3 + 4 * cells));
      if (lost > largest) sum.length = memory;
      largest = std::max(largest, lost);
      sum.resistance += lost;
    }
  };
  add(model.foundation.front(), 1);
  if (!model.coating.empty()) add(model.coating.front(), std::abs(model.flow));
  return sum;
}

}  // namespace

GridError grid_error(const ContactProblem& problem, const Vector& pressure, const std::vector<Zone>& zone,
                     const ContactPowers& powers) {
  const ContactModel& model = problem.model;
  const CreepSpectrum& creep = model.top().creep;
  const ContactIntegrals sums = contact_integrals(problem, pressure, zone);
  const CreepMoments moments = creep_moments(creep, sums.half_length / model.speed);
  GridError error;
  for (const CreepSpectrum::Term& term : creep.terms)
    if (term.compliance > 0) error.memory_length = std::max(error.memory_length, model.speed * term.time);
  if (moments.first == 0 && model.coating.empty()) return error;

  error.slow_time = moments.first;
  // The two terms of (N17) and (N18).
  const double limit = model.speed * moments.first * sums.curved;
  const double modulus = 2 / (moments.rest * (1 - model.top().poisson_ratio));
  const auto of_second_moment = [&](double moment) {
    return model.speed * model.speed * moment * M_PI / (4 * modulus) * sums.edge_slopes;
  };
  const double second = of_second_moment(moments.second - 0.5 * moments.first * moments.first) / limit;
  const bool composite = model.composite();  // which has no moments of one material
  if (!composite) error.slow_loss = limit * (1 - std::min(second, largest_second));
  error.slow_pushed = model.speed * moments.first * sums.unbalanced;

  const UnresolvedMemory lost = unresolved_memory(model, problem.grid.spacing_x, sums);
  error.unresolved = lost.resistance;
  if (!model.coating.empty()) error.memory_length = lost.length;
  if (composite || second >= largest_second || model.adhesion_threshold > 0) return error;
  // Memories that are short beside those of the second term have crept at once.
  double softening = 0;
  for (const CreepSpectrum::Term& term : creep.terms)
    softening += term.compliance / moments.rest * std::min(1.0, term.time * moments.first / moments.second);
  // Measured against exact solutions: the slopes at the edges are known to a twentieth (less over a thin layer), and
  // change with the memory; the rest is what friction adds at steep edges.
  const double edges = std::clamp(0.2 * sums.half_length / model.top().layer_thickness, 0.05, 2.0);
  const double slope = model.friction_coefficient > 0 ? sums.half_length / model.radius : 0;
  // What both terms have of memories that are not short against the contact is no part of slow rolling.
  const double not_slow = model.speed * moments.long_first * sums.curved + of_second_moment(moments.long_second);
  error.slow_error =
      not_slow + limit * (1e-5 + second * (edges + second * (1 + 12 * softening * softening)) + 0.1 * slope * slope);
  const double square = error.unresolved * error.unresolved;
  // None where the grid resolves the memories well: the edges' slopes jump with the nodes, which a smooth answer must
  // not.
  error.slow_share =
      std::max(0.0, square / (square + error.slow_error * error.slow_error) - least_share) / (1 - least_share);
  const double friction = std::abs(powers.friction / powers.resistance());
  if (friction > 0) error.slow_share *= std::clamp(2 - friction / negligible_friction, 0.0, 1.0);
  return error;
}

void take_slow_rolling(const ContactModel& model, const GridError& error, const ContactPowers& powers,
                       RollingSolution& solution) {
  warn_of_memory(error, solution);
  if (error.slow_share <= 0) return;
  const SurfaceFields& fields = solution.fields;
  const SurfaceGrid& grid = fields.grid;
  double sheared = 0;  // (N20)
  if (model.friction_coefficient > 0)
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 1; column + 1 < grid.columns; ++column) {
        const auto i = static_cast<std::size_t>(grid.index(column, row));
        if (fields.zone[i - 1] == Zone::free || fields.zone[i] == Zone::free || fields.zone[i + 1] == Zone::free)
          continue;
        const auto bend = [&](const std::vector<double>& moved) {
          return (moved[i + 1] - 2 * moved[i] + moved[i - 1]) / (grid.spacing_x * grid.spacing_x);
        };
        sheared += fields.shear_x[i] * bend(fields.u);
        if (!fields.v.empty()) sheared += fields.shear_y[i] * bend(fields.v);
      }
  const double loss = error.slow_loss - model.speed * error.slow_time * grid.cell_area() * sheared;
  const double viscous = solution.viscous_loss / model.speed;
  const double losses = powers.losses() + loss - viscous + error.slow_pushed - powers.pushed;
  add_resistance(model, error.slow_share * (losses - powers.resistance()), solution);
  solution.viscous_loss += error.slow_share * (loss - viscous) * model.speed;
  solution.energy_residual = (1 - error.slow_share) * powers.missing() / powers.scale(solution.rolling_resistance);
  if (error.slow_share > 0.01)
    solution.model += "; slow rolling: viscous loss from the elastic fields (V τ' P/R and its next term), share " +
                      message_text(error.slow_share) +
                      ", as Vτ/spacing = " + message_text(error.memory_length / solution.spacing);
}

}  // namespace rollres
