#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numerics/solution_limits.hpp"

#include "core/paper_method/stick_slip.hpp"

namespace rollres {

LineStickSlip::LineStickSlip(const ContactModel& model, const InfluenceTable& table, const SurfaceGrid& grid)
    : problem_(model, table, grid),
      resticking_(model.resticking == Resticking::on),
      sense_(grid.size(), 0),
      system_(problem_.rotation_index() + 1, [this](int row, int column) { return problem_.element(row, column); }) {}

/// With limiting friction at every node the rotation is free, and the moment misses something. As the rotation moves
/// the way that mends this, the first node whose slip vanishes sticks. False if there is none.
bool LineStickSlip::let_one_stick(StickSlip& state) {
  const auto& contact = problem_.contact;
  for (const int node : contact) state.force_x[node] = sense_[node] * problem_.limit[node];
  const double wanted = problem_.moment - problem_.moment_arm.dot(state.force_x) < 0 ? -1 : 1;
  const Eigen::VectorXd slip = problem_.slip(0, contact, contact, state.force_x, state.force_y, true);
  int first = -1;
  double nearest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < contact.size(); ++k)
    if (sense_[contact[k]] * wanted < 0 && wanted * slip[k] > nearest) {
      nearest = wanted * slip[k];
      first = contact[k];
    }
  if (first >= 0) sense_[first] = 0;
  return first >= 0;
}

StickSlip LineStickSlip::solve(const std::vector<int>& contact, const Eigen::VectorXd& normal_force,
                               double /*tolerance*/, double coating) {
  problem_.set_normal(contact, normal_force, coating);
  if (const auto needed = problem_.friction_needed()) {
    std::fill(sense_.begin(), sense_.end(), 0);
    return problem_.all_sliding(*needed);
  }
  const int size = problem_.grid.size();
  std::vector<int> sense(size, 0);
  if (resticking_)
    for (const int node : contact) sense[node] = sense_[node];
  sense_ = sense;

  StickSlip state;
  state.force_x.setZero(size);
  state.zone.assign(size, Zone::free);
  std::size_t fewest = contact.size() + 1;
  int patience = 10;
  const int iteration_limit = 100 + 20 * static_cast<int>(contact.size());
  std::vector<int> stick, slip_nodes, opposed;
  while (true) {
    require_time();
    auto sort_nodes = [&] {
      stick.clear();
      slip_nodes.clear();
      for (const int node : contact) (sense_[node] == 0 ? stick : slip_nodes).push_back(node);
    };
    sort_nodes();
    if (stick.empty() && !problem_.given_rotation) {
      if (!resticking_ || !let_one_stick(state)) {
        state.reason = "no sticking node is left, though friction could bear the moment";
        break;
      }
      sort_nodes();
    }
    for (const int node : slip_nodes) state.force_x[node] = sense_[node] * problem_.limit[node];
    if (!problem_.solve_sticking(system_, stick, slip_nodes, state)) {
      state.reason = "the stick-slip system is singular";
      break;
    }
    std::vector<int> broken;
    for (const int node : stick)
      if (exceeds(problem_.limit[node], state.force_x[node])) broken.push_back(node);
    opposed.clear();
    const Eigen::VectorXd slip = problem_.slip(0, slip_nodes, contact, state.force_x, state.force_y, false);
    for (std::size_t k = 0; k < slip_nodes.size(); ++k)
      if (sense_[slip_nodes[k]] * (slip[k] - state.rotation_ratio * problem_.turning[slip_nodes[k]]) <
          -problem_.slip_threshold)
        opposed.push_back(slip_nodes[k]);
    if (resticking_) broken.insert(broken.end(), opposed.begin(), opposed.end());
    if (broken.empty()) {
      state.status = Status::converged;
      break;
    }
    if (state.iterations >= iteration_limit) {
      state.reason = std::to_string(broken.size()) + " of " + std::to_string(contact.size()) +
                     " nodes still break a law of friction after " + std::to_string(state.iterations) + " iterations";
      break;
    }
    if (resticking_) {
      if (broken.size() < fewest) {
        fewest = broken.size();
        patience = 10;
      } else if (--patience < 0) {
        broken = {*std::max_element(broken.begin(), broken.end())};
      }
    }
    for (const int node : broken) sense_[node] = sense_[node] != 0 ? 0 : (state.force_x[node] < 0 ? -1 : 1);
  }
  for (const int node : contact) state.zone[node] = sense_[node] == 0 ? Zone::stick : Zone::slip;
  if (state.status == Status::converged && !opposed.empty()) {
    state.status = Status::not_converged;
    state.reason = "friction points against the slip at " + std::to_string(opposed.size()) + " of " +
                   std::to_string(slip_nodes.size()) + " slipping nodes, and none may stick again";
  }
  return state;
}

}  // namespace rollres
