#include <cmath>
#include <limits>

#include "core/estimate/grid_choice.hpp"
#include "core/model/contact_surface.hpp"
#include "core/paper_method/stick_slip.hpp"

namespace rollres {

TangentialProblem::TangentialProblem(const ContactModel& model, const InfluenceTable& table, const SurfaceGrid& on_grid)
    : components(model.dimension - 1),
      grid(on_grid),
      law(friction_law(model)),
      slip_threshold(model.slip_threshold),
      drive_target_(drive_target(model)) {
  const IndenterShape shape(model, share_of_coating(model));
  if (model.drive == Drive::rotation) given_rotation = shape.law_ratio(*model.rotation_ratio);
  const Direction directions[] = {Direction::w, Direction::u, Direction::v};
  for (int i = 0; i < components; ++i)
    for (int j = 0; j < components + 1; ++j) {
      forward_[i][j] = slope_kernel(table, grid, directions[i + 1], directions[j], SlipStencil::forward);
      chosen_[i][j] = slope_kernel(table, grid, directions[i + 1], directions[j], model.slip_stencil);
    }
  scale = std::abs(forward_[0][1](0, 0));
  normal_arm_.resize(grid.size());
  for (Eigen::VectorXd* field :
       {&forward_slip_[0], &forward_slip_[1], &turning, &turning_y, &moment_arm, &moment_arm_y})
    field->resize(grid.size());
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const int node = grid.index(column, row);
      const double x = grid.x(column), y = grid.y(row);
      const LeverArm torque = shape.torque(x, y), force = shape.driving_force(x, y);
      const RigidSlip rigid = shape.law_slip(x + 0.5 * grid.spacing_x, y);  // where the forward difference is centred
      forward_slip_[0][node] = rigid.forward;
      forward_slip_[1][node] = rigid.forward_y;
      turning[node] = rigid.turning;
      turning_y[node] = rigid.turning_y;
      normal_arm_[node] = -drive_row(model, torque.of_pressure, force.of_pressure);
      moment_arm[node] = -drive_row(model, torque.of_shear_x, force.of_shear_x);
      moment_arm_y[node] = -drive_row(model, torque.of_shear_y, force.of_shear_y);
    }
}

void TangentialProblem::set_normal(const std::vector<int>& in_contact, const Eigen::VectorXd& normal_force,
                                   double coating) {
  contact = in_contact;
  normal_force_ = normal_force;
  limit = normal_force.unaryExpr([&](double force) { return law.bound(force); });
  moment = normal_arm_.dot(normal_force) + coating - drive_target_;
}

double TangentialProblem::element(int row, int column) const {
  const int size = grid.size(), rotation = rotation_index();
  const auto at = [size](const Eigen::VectorXd& x, const Eigen::VectorXd& y, int index) {
    return index < size ? x[index] : y[index - size];
  };
  if (row == rotation) return column == rotation ? 0 : scale * at(moment_arm, moment_arm_y, column);
  if (column == rotation) return -scale * at(turning, turning_y, row);
  return forward_[row / size][1 + column / size](row % size, column % size);
}

Eigen::VectorXd TangentialProblem::slip(int component, const std::vector<int>& nodes, const std::vector<int>& loaded,
                                        const Eigen::VectorXd& force_x, const Eigen::VectorXd& force_y,
                                        bool forward) const {
  const auto& kernels = forward ? forward_[component] : chosen_[component];
  Eigen::VectorXd values = forward_slip_[component](nodes);
  kernels[0].add(nodes, contact, normal_force_, values);
  kernels[1].add(nodes, loaded, force_x, values);
  if (components == 2) kernels[2].add(nodes, loaded, force_y, values);
  return values;
}

bool TangentialProblem::solve_sticking(SubsetSolver& system, const std::vector<int>& stick,
                                       const std::vector<int>& slip_nodes, StickSlip& state) const {
  const auto n = static_cast<Eigen::Index>(stick.size());
  std::vector<int> unknowns;
  for (int component = 0; component < components; ++component)
    for (const int node : stick) unknowns.push_back(component * grid.size() + node);
  if (!given_rotation) unknowns.push_back(rotation_index());
  Eigen::VectorXd rhs(static_cast<Eigen::Index>(unknowns.size()));
  for (int component = 0; component < components; ++component)
    rhs.segment(component * n, n) = -slip(component, stick, slip_nodes, state.force_x, state.force_y, true);
  if (given_rotation) {
    rhs.head(n) += *given_rotation * turning(stick);
    if (components == 2) rhs.segment(n, n) += *given_rotation * turning_y(stick);
  } else {
    double borne = 0;
    for (const int node : slip_nodes) {
      borne += moment_arm[node] * state.force_x[node];
      if (components == 2) borne += moment_arm_y[node] * state.force_y[node];
    }
    rhs[rhs.size() - 1] = scale * (moment - borne);
  }
  const Eigen::VectorXd solution = system.solve(unknowns, rhs);
  ++state.iterations;
  if (!solution.allFinite()) return false;
  for (Eigen::Index k = 0; k < n; ++k) {
    state.force_x[stick[k]] = solution[k];
    if (components == 2) state.force_y[stick[k]] = solution[n + k];
  }
  state.rotation_ratio = given_rotation ? *given_rotation : scale * solution[solution.size() - 1];
  return true;
}

std::optional<double> TangentialProblem::friction_needed() const {
  if (given_rotation) return {};
  const double bearable = moment_arm.dot(limit);
  if (std::abs(moment) < bearable) return {};
  return law.coefficient * std::abs(moment) / bearable;
}

StickSlip TangentialProblem::all_sliding(double needed) const {
  StickSlip state;
  const double sense = moment < 0 ? -1 : 1;
  state.force_x = sense * limit;
  if (components == 2) state.force_y.setZero(grid.size());
  state.zone.assign(grid.size(), Zone::free);
  for (const int node : contact) state.zone[node] = Zone::slip;
  state.rotation_ratio = std::numeric_limits<double>::quiet_NaN();
  state.status = Status::no_steady_state;
  state.friction_needed = needed;
  state.reason = "the drive asks for more traction than friction can give: a friction coefficient of about " +
                 std::to_string(needed) + " is needed";
  return state;
}

}  // namespace rollres
