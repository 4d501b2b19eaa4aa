#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/numerics/solution_limits.hpp"

#include "core/paper_method/stick_slip.hpp"

namespace rollres {

SurfaceStickSlip::SurfaceStickSlip(const ContactModel& model, const InfluenceTable& table, const SurfaceGrid& grid)
    : problem_(model, table, grid),
      rule_(model.slip_rule),
      slips_(grid.size(), 0),
      along_x_(Eigen::VectorXd::Zero(grid.size())),
      along_y_(Eigen::VectorXd::Zero(grid.size())),
      system_(problem_.rotation_index() + 1, [this](int row, int column) { return problem_.element(row, column); }) {}

StickSlip SurfaceStickSlip::solve(const std::vector<int>& contact, const Eigen::VectorXd& normal_force,
                                  double tolerance, double coating) {
  problem_.set_normal(contact, normal_force, coating);
  if (const auto needed = problem_.friction_needed()) return problem_.all_sliding(*needed);
  if (rule_ == SlipRule::printed) std::fill(slips_.begin(), slips_.end(), 0);
  StickSlip state;
  state.force_x.setZero(problem_.grid.size());
  state.force_y.setZero(problem_.grid.size());
  largest_limit_ = problem_.limit.maxCoeff();
  weight_ = 0.5 / problem_.scale;
  double least = std::numeric_limits<double>::infinity();
  int since_least = 0;
  const int iteration_limit = rule_ == SlipRule::printed ? 50 : 1000;
  while (true) {
    require_time();
    std::vector<int> stick, slip_nodes;
    for (const int node : contact) (slips_[node] ? slip_nodes : stick).push_back(node);
    for (const int node : slip_nodes) {
      state.force_x[node] = problem_.limit[node] * along_x_[node];
      state.force_y[node] = problem_.limit[node] * along_y_[node];
    }
    if (stick.empty() && !problem_.given_rotation) {
      balance_rotation(slip_nodes, state);
    } else if (!problem_.solve_sticking(system_, stick, slip_nodes, state)) {
      state.reason = "the stick-slip system is singular";
      break;
    }
    const Change change =
        rule_ == SlipRule::printed ? printed_rule(stick, slip_nodes, state) : projected_rule(stick, slip_nodes, state);
    if (change.released + change.caught == 0 && change.largest < tolerance) {
      if (change.beyond_limit == 0)
        state.status = Status::converged;
      else
        state.reason = std::to_string(change.beyond_limit) + " of " + std::to_string(stick.size()) +
                       " sticking nodes bear more than the limit of friction";
      break;
    }
    if (state.iterations >= iteration_limit || weight_ * problem_.scale < 1e-3) {
      std::ostringstream text;
      text << "after " << state.iterations << " iterations " << change.beyond_limit << " of " << stick.size()
           << " sticking nodes bear more than the limit of friction, and at " << slip_nodes.size()
           << " slipping nodes friction still changes by up to " << change.largest << " of its largest limit";
      state.reason = text.str();
      break;
    }
    if (change.largest < 0.9 * least) {
      least = change.largest;
      since_least = 0;
    } else if (++since_least >= 12) {
      weight_ *= 0.6;
      since_least = 0;
      least = change.largest;
    }
  }
  state.zone.assign(problem_.grid.size(), Zone::free);
  for (const int node : contact) state.zone[node] = slips_[node] ? Zone::slip : Zone::stick;
  return state;
}

SurfaceStickSlip::Change SurfaceStickSlip::projected_rule(const std::vector<int>& stick,
                                                          const std::vector<int>& slip_nodes, const StickSlip& state) {
  Change change;
  for (const int node : stick) {
    if (!exceeds(problem_.limit[node], state.force_x[node], state.force_y[node])) continue;
    const FrictionProjection force(problem_.limit[node], state.force_x[node], state.force_y[node]);
    slips_[node] = 1;
    ++change.released;
    along_x_[node] = force.direction_x();
    along_y_[node] = force.direction_y();
    change.largest = std::max(change.largest, force.excess() / largest_limit_);
  }
  change.beyond_limit = change.released;
  Eigen::VectorXd slip_x, slip_y;
  slip_of(slip_nodes, state, slip_x, slip_y);
  for (std::size_t k = 0; k < slip_nodes.size(); ++k) {
    const int node = slip_nodes[k];
    const double limit = problem_.limit[node];
    if (limit == 0) continue;
    const FrictionProjection next(limit, state.force_x[node] + weight_ * slip_x[k],
                                  state.force_y[node] + weight_ * slip_y[k]);
    if (!next.slips()) {
      slips_[node] = 0;
      ++change.caught;
      change.largest = std::max(change.largest, -next.excess() / largest_limit_);
    } else {
      turn(node, next.direction_x(), next.direction_y(), change);
    }
  }
  return change;
}

/// Gives the friction of a slipping node another direction.
void SurfaceStickSlip::turn(int node, double along_x, double along_y, Change& change) {
  const double turned = std::hypot(along_x - along_x_[node], along_y - along_y_[node]);
  change.largest = std::max(change.largest, turned * problem_.limit[node] / largest_limit_);
  along_x_[node] = along_x;
  along_y_[node] = along_y;
}

SurfaceStickSlip::Change SurfaceStickSlip::printed_rule(const std::vector<int>& stick,
                                                        const std::vector<int>& slip_nodes, const StickSlip& state) {
  Change change;
  std::vector<int> nodes = stick;
  nodes.insert(nodes.end(), slip_nodes.begin(), slip_nodes.end());
  Eigen::VectorXd slip_x, slip_y;
  slip_of(nodes, state, slip_x, slip_y);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const int node = nodes[k];
    const double slip = std::hypot(slip_x[k], slip_y[k]);
    const bool moves = slip > problem_.slip_threshold;
    if (slips_[node] == 0) {
      if (!exceeds(problem_.limit[node], state.force_x[node], state.force_y[node])) continue;
      ++change.beyond_limit;
      if (!moves) continue;
      slips_[node] = 1;
      ++change.released;
    } else if (!moves) {
      slips_[node] = 0;
      ++change.caught;
      continue;
    } else {
      turn(node, slip_x[k] / slip, slip_y[k] / slip, change);
      continue;
    }
    along_x_[node] = slip_x[k] / slip;
    along_y_[node] = slip_y[k] / slip;
  }
  return change;
}

void SurfaceStickSlip::slip_of(const std::vector<int>& nodes, const StickSlip& state, Eigen::VectorXd& slip_x,
                               Eigen::VectorXd& slip_y) const {
  slip_x = problem_.slip(0, nodes, problem_.contact, state.force_x, state.force_y, false);
  slip_x -= state.rotation_ratio * problem_.turning(nodes);
  slip_y = problem_.slip(1, nodes, problem_.contact, state.force_x, state.force_y, false);
  slip_y -= state.rotation_ratio * problem_.turning_y(nodes);
}

/// Without a sticking node the system says nothing about the rotation: it is set so that the forces after the next
/// projection bear the moment, which falls as the rotation grows.
void SurfaceStickSlip::balance_rotation(const std::vector<int>& slip_nodes, StickSlip& state) {
  ++state.iterations;
  state.rotation_ratio = 0;
  Eigen::VectorXd slip_x, slip_y;
  slip_of(slip_nodes, state, slip_x, slip_y);
  auto excess = [&](double rotation) {
    double sum = -problem_.moment;
    for (std::size_t k = 0; k < slip_nodes.size(); ++k) {
      const int node = slip_nodes[k];
      const FrictionProjection next(problem_.limit[node],
                                    state.force_x[node] + weight_ * (slip_x[k] - rotation * problem_.turning[node]),
                                    state.force_y[node] + weight_ * (slip_y[k] - rotation * problem_.turning_y[node]));
      sum += problem_.moment_arm[node] * next.x() + problem_.moment_arm_y[node] * next.y();
    }
    return sum;
  };
  double low = 0, high = 2;
  for (double step = 1; excess(low) < 0 && step < 1e9; step *= 2) low -= step;
  for (double step = 1; excess(high) > 0 && step < 1e9; step *= 2) high += step;
  for (int halving = 0; halving < 200 && high - low > 1e-15 * std::max(std::abs(low), std::abs(high)); ++halving) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0 ? low : high) = middle;
  }
  state.rotation_ratio = 0.5 * (low + high);
}

}  // namespace rollres
