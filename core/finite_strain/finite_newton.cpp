#include "core/finite_strain/finite_newton.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/algebra/krylov.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/indenter_shape.hpp"

namespace rollres {

namespace {

using Eigen::Vector2d;

constexpr int most_steps = 20;
/// What a step may make of a cell's volume.
constexpr double least_volume = 0.45, largest_volume = 2.2;
/// All equations at the end, each in its own scale, and the volumes of cells.
constexpr double solved = 1e-9;
/// Of the norm of all equations, for a linear step.
constexpr double solved_linearly = 1e-6;
constexpr int most_vectors = 300;

}  // namespace

FiniteContact::FiniteContact(const ContactModel& model, FlowingLayer& layer)
    : model_(model),
      law_(friction_law(model)),
      layer_(layer),
      nodes_(static_cast<std::size_t>(layer.numbering().columns)),
      local_(layer.mesh().cells_along() + 1, 2 * layer.numbering().stride(), layer.numbering().stride(),
             layer.numbering().stride()) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i].place = layer_.mesh().node_x(static_cast<int>(i));
    nodes_[i].share = layer_.mesh().share(static_cast<int>(i));
  }
}

Vector FiniteContact::residual() const {
  Vector rows = Vector::Zero(size() + 2);
  rows.head(size()) = layer_.forces();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const SurfaceNode& node = nodes_[i];
    const bool contact = node.zone != Zone::free;
    if (i > 0) rows.segment<2>(displacement(i)) -= node.normal * node.outward + node.shear * node.tangent;
    rows(normal(i)) = contact ? node.gap : node.normal;
    if (!sheared()) continue;
    if (node.zone == Zone::free || !with_friction_)
      rows(shear(i)) = node.shear;
    else if (node.zone == Zone::stick)
      rows(shear(i)) = node.slip;
    else  // the bound, continued as a straight line to where an iterate pulls
      rows(shear(i)) = node.shear - node.direction * law_.slope(node.normal) * node.normal;
  }
  rows(size()) = model_.load ? load() - *model_.load : approach_ - *model_.approach;
  if (with_friction_)
    rows(size() + 1) = model_.drive == Drive::rotation
                           ? rotation_ratio_ - *model_.rotation_ratio
                           : drive_row(model_, torque(), driving_force()) - drive_target(model_);
  return rows;
}

void FiniteContact::add_along_tangent(Eigen::Index row, std::size_t node, double factor) {
  const Vector2d& tangent = nodes_[node].tangent;
  for (int c = 0; c < 2; ++c) add(row, displacement(node) + c, factor * tangent(c));
  add(row, size(), factor * tangent.y());
}

void FiniteContact::linearise() {
  entries_.clear();
  const Eigen::Index approach = size(), rotation = size() + 1;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const SurfaceNode& node = nodes_[i];
    const Vector2d turning = (node.normal * node.tangent - node.shear * node.outward) / node.distance;
    const bool loaded = node.normal != 0 || node.shear != 0 || node.zone != Zone::free;
    for (int c = 0; c < 2 && i > 0 && loaded; ++c) {
      const Eigen::Index row = displacement(i) + c;
      add_along_tangent(row, i, -turning(c));
      add(row, normal(i), -node.outward(c));
      if (sheared()) add(row, shear(i), -node.tangent(c));
    }
    if (node.zone == Zone::free) {
      add(normal(i), normal(i), 1);
    } else {
      for (int c = 0; c < 2; ++c) add(normal(i), displacement(i) + c, node.outward(c));
      add(normal(i), approach, node.outward.y());
    }
    if (loaded && model_.load) {
      add_along_tangent(approach, i, -turning.y());
      add(approach, normal(i), -node.outward.y());
      if (sheared()) add(approach, shear(i), -node.tangent.y());
    }
    if (!sheared()) continue;
    if (with_friction_ && node.zone == Zone::stick) {
      const double step = (covered() ? rotation_ratio_ : 1) / (node.place - nodes_[i - 1].place);
      add_along_tangent(shear(i), i, step * node.per_step);
      add_along_tangent(shear(i), i - 1, -step * nodes_[i - 1].per_step);
      add(shear(i), rotation, covered() ? node.stretch : -1);
    } else {
      add(shear(i), shear(i), 1);
      if (with_friction_ && node.zone == Zone::slip)
        add(shear(i), normal(i), -node.direction * law_.slope(node.normal));
    }
    if (model_.drive != Drive::rotation && loaded && with_friction_) linearise_drive(i);
  }
  if (!model_.load) add(approach, approach, 1);
  if (!with_friction_ || model_.drive == Drive::rotation) add(rotation, rotation, 1);
}

void FiniteContact::linearise_drive(std::size_t i) {
  const SurfaceNode& node = nodes_[i];
  const Eigen::Index row = size() + 1;
  const double pushed = model_.drive == Drive::top_force ? 1 : 0;
  if (covered()) {
    add(row, shear(i), lever(node) / model_.radius + pushed);
    add(row, normal(i), node.position.x() / model_.radius);
    add(row, displacement(i), node.normal / model_.radius);
    add(row, displacement(i) + 1, node.shear / model_.radius);
    return;
  }
  add(row, shear(i), -1 - pushed * node.tangent.x());
  add(row, normal(i), -pushed * node.outward.x());
  add_along_tangent(row, i, -pushed * (node.normal * node.tangent - node.shear * node.outward).x() / node.distance);
}

Vector FiniteContact::multiply(const Vector& change) const {
  Vector rows = Vector::Zero(size() + 2);
  rows.head(size()) = layer_.apply(change.head(size()));
  const Numbering& numbers = layer_.numbering();
  for (int column = 0; column < numbers.columns; ++column)
    if (layer_.is_held(column))
      rows.segment(numbers.node(column, 0), 2 * numbers.free_rows) =
          change.segment(numbers.node(column, 0), 2 * numbers.free_rows);
  for (const Entry& entry : entries_) rows(entry.row) += entry.value * change(entry.column);
  return rows;
}

void FiniteContact::prepare() {
  local_.set_zero();
  layer_.add_local(local_);
  border_columns_ = decltype(border_columns_)::Zero(size(), 2);
  border_rows_ = decltype(border_rows_)::Zero(2, size());
  corner_.setZero();
  for (const Entry& entry : entries_) {
    const bool row = entry.row < size(), column = entry.column < size();
    if (row && column)
      local_.add(entry.row, entry.column, entry.value);
    else if (row)
      border_columns_(entry.row, entry.column - size()) += entry.value;
    else if (column)
      border_rows_(entry.row - size(), entry.column) += entry.value;
    else
      corner_(entry.row - size(), entry.column - size()) += entry.value;
  }
  local_.factorise();
  solved_columns_.resize(size(), 2);
  for (int c = 0; c < 2; ++c) solved_columns_.col(c) = local_.solve(border_columns_.col(c));
  corner_inverse_ = (corner_ - border_rows_ * solved_columns_).inverse();
}

Vector FiniteContact::precondition(const Vector& right_side) const {
  Vector x(size() + 2);
  const Vector inside = local_.solve(right_side.head(size()));
  x.tail<2>() = corner_inverse_ * (right_side.tail<2>() - border_rows_ * inside);
  x.head(size()) = inside - solved_columns_ * x.tail<2>();
  return x;
}

double FiniteContact::left(const Vector& missing) const {
  const double force = load(), height = 0.5 / model_.radius;
  double worst = layer_.volume_defect();
  const auto take = [&](double amount, double scale) { worst = std::max(worst, std::abs(amount) / scale); };
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto column = static_cast<int>(i);
    for (Eigen::Index k = 0; k < 2 * layer_.numbering().free_rows; ++k)
      take(missing(layer_.numbering().node(column, 0) + k), force);
    const bool contact = nodes_[i].zone != Zone::free;
    take(missing(normal(i)), contact ? height : force);
    if (sheared()) take(missing(shear(i)), contact && nodes_[i].zone == Zone::stick ? 2 * height : force);
  }
  take(missing(size()), model_.load ? *model_.load : *model_.approach);
  take(missing(size() + 1), model_.drive == Drive::rotation ? 1 : force);
  return worst;
}

double FiniteContact::law_violation() const {
  const Vector missing = residual();
  double worst = left(missing), peak = 0;
  for (const SurfaceNode& node : nodes_) peak = std::max(peak, node.normal / node.share);
  for (const SurfaceNode& node : nodes_) {
    const double force = peak * node.share;
    worst = std::max({worst, -node.normal / force, -node.gap * 2 * model_.radius});
    if (with_friction_ && node.zone == Zone::stick)
      worst = std::max(worst, (std::abs(node.shear) - law_.bound(node.normal)) / law_.bound(force));
    if (with_friction_ && node.zone == Zone::slip)
      worst = std::max(worst, -node.direction * node.slip * model_.radius / 2);
  }
  return std::isnan(worst) ? INFINITY : worst;
}

double FiniteContact::step(const Vector& change, FiniteState& state, FiniteOutcome& outcome) {
  const Vector moved = change.head(size());
  double length = 1;
  for (;; length *= 0.6) {
    const FlowingLayer::Folding folding = layer_.folding(length * moved);
    if (folding.least >= least_volume && folding.largest <= largest_volume) break;
    if (length < 1e-3) {
      outcome.reason = message_text("the mesh folds at x = ", folding.x, ", z = ", folding.z);
      return 0;
    }
  }
  state.pressures += length * layer_.pressure_change(moved);
  state.unknowns += length * moved;
  state.approach += length * change(size());
  state.rotation_ratio += length * change(size() + 1);
  if (layer_.evaluate(state.unknowns, state.pressures)) return length;
  outcome.reason = "the mesh folds";
  return 0;
}

FiniteOutcome FiniteContact::solve(FiniteState& state, bool with_friction, bool sticking) {
  FiniteOutcome outcome;
  with_friction_ = with_friction;
  if (!layer_.evaluate(state.unknowns, state.pressures)) {
    outcome.reason = "the mesh is folded at the start";
    return outcome;
  }
  place_nodes(state);
  choose_zones();
  for (SurfaceNode& node : nodes_)
    if (sticking && node.zone == Zone::slip) node.zone = Zone::stick;
  Vector missing = residual();
  while (outcome.steps < most_steps) {
    ++outcome.steps;
    linearise();
    prepare();
    Vector right_side = -missing;
    right_side.head(size()) -= layer_.pressure_defect();
    const auto solution =
        gmres<double>([&](const Vector& v) { return multiply(v); }, [&](const Vector& v) { return precondition(v); },
                      right_side, solved_linearly, most_vectors);
    if (!solution.x.allFinite()) {
      outcome.reason = "a linear step has no solution";
      return outcome;
    }
    const double length = step(solution.x, state, outcome);
    if (length == 0) return outcome;
    place_nodes(state);
    const bool changed = choose_zones();
    missing = residual();
    if (changed || length < 1 || !(left(missing) <= solved)) continue;
    outcome.converged = true;
    return outcome;
  }
  outcome.reason = message_text("Newton's method has no answer after ", most_steps, " steps");
  return outcome;
}

}  // namespace rollres
