#include "core/paper_method/active_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/model/indenter_shape.hpp"
#include "core/paper_method/normal_contact.hpp"
#include "core/paper_method/stick_slip.hpp"

namespace rollres {

namespace {

bool touches_border(const SurfaceGrid& grid, const std::vector<int>& contact) {
  for (const int node : contact) {
    const int column = node % grid.columns, row = node / grid.columns;
    if (column == 0 || column == grid.columns - 1) return true;
    if (grid.rows > 1 && (row == 0 || row == grid.rows - 1)) return true;
  }
  return false;
}

bool touches_rim(const ContactModel& model, const SurfaceGrid& grid, const std::vector<int>& contact) {
  const double margin = std::max(grid.spacing_x, grid.rows > 1 ? grid.spacing_y : 0);
  for (const int node : contact) {
    const double y = grid.rows > 1 ? grid.y(node / grid.columns) : 0;
    if (std::hypot(grid.x(node % grid.columns), y) + margin >= model.radius) return true;
  }
  return false;
}

/// M and N of core/newton/README.md, (N3b) and (N3e), of a scene with a coating.
class MomentsOfCoating {
 public:
  MomentsOfCoating(const ContactModel& model, const InfluenceTable& table, const SurfaceGrid& grid)
      : over_radius_(model.ring() ? 1 / model.radius : 0) {
    if (!table.coating) return;
    for (const Direction force : {Direction::w, Direction::u, Direction::v})
      if (force != Direction::v || model.dimension == 3) {
        heights_.push_back(displacement_kernel(*table.coating, grid, Direction::w, force));
        slopes_.push_back(slope_kernel(*table.coating, grid, Direction::w, force, SlipStencil::central));
      }
  }
  CoatingMoments operator()(const NormalContact& normal, const Eigen::VectorXd& force_x,
                            const Eigen::VectorXd& force_y) const {
    if (slopes_.empty()) return {};
    const auto moved = [&](const std::vector<OffsetKernel>& kernels) {
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(normal.contact.size()));
      kernels[0].add(normal.contact, normal.contact, normal.force, sum);
      kernels[1].add(normal.contact, normal.contact, force_x, sum);
      if (kernels.size() > 2) kernels[2].add(normal.contact, normal.contact, force_y, sum);
      return sum;
    };
    CoatingMoments moments{-normal.force(normal.contact).dot(moved(slopes_)), 0};
    if (over_radius_ > 0) moments.sheared = over_radius_ * force_x(normal.contact).dot(moved(heights_));
    return moments;
  }

 private:
  double over_radius_;                          // of a ring, else 0
  std::vector<OffsetKernel> heights_, slopes_;  // of w for each force
};

/// What keeps a normal contact from being an answer; empty where nothing does.
std::string fault_of(const ContactModel& model, const SurfaceGrid& grid, const NormalContact& normal, bool at_border) {
  if (!normal.converged) return normal.reason;
  if (at_border) return "the contact reached the border of the grid";
  return touches_rim(model, grid, normal.contact) ? "the contact is as wide as the body" : "";
}

std::string unsettled(int passes, double change, bool same_zones) {
  std::ostringstream text;
  text << "normal and tangential problem did not settle in " << passes << " passes: forces still change by " << change
       << " of the largest, zones " << (same_zones ? "stay" : "change");
  return text.str();
}

/// Tractions, zones and motion of a state from the forces of both problems.
void take_forces(const NormalContact& normal, const StickSlip& tangential, bool frictionless, ContactState& state) {
  state.approach = normal.approach;
  state.rotation_ratio = frictionless ? std::numeric_limits<double>::quiet_NaN() : tangential.rotation_ratio;
  const double area = state.grid.cell_area();
  state.pressure = -normal.force / area;
  state.shear_x = tangential.force_x / area;
  if (tangential.force_y.size() > 0) state.shear_y = tangential.force_y / area;
  state.zone.assign(state.grid.size(), Zone::free);
  for (const int node : normal.contact)
    state.zone[node] = frictionless || tangential.zone.empty() ? Zone::slip : tangential.zone[node];
}

template <class StickSlipSolver>
ContactState combined_loop(const ContactModel& model, const InfluenceTable& table, const SurfaceGrid& grid) {
  const bool frictionless = model.friction_coefficient == 0, lateral = model.dimension == 3;
  NormalContactSolver normal_solver(model, table, grid);
  std::optional<StickSlipSolver> stick_slip_solver;
  if (!frictionless) stick_slip_solver.emplace(model, table, grid);

  const MomentsOfCoating coating(model, table, grid);
  ContactState state;
  state.grid = grid;
  NormalContact normal;
  StickSlip tangential;
  tangential.force_x.setZero(grid.size());
  if (lateral) tangential.force_y.setZero(grid.size());

  constexpr int pass_limit = 60;
  int failures = 0;               // of the tangential problem, in a row
  double inner_tolerance = 1e-4;  // of the tangential problem; follows the change from pass to pass
  for (int pass = 1;; ++pass) {
    NormalContact next = normal_solver.solve(tangential.force_x, tangential.force_y, normal.contact);
    state.iterations += next.iterations;
    double change = pass == 1 ? 1 : (next.force - normal.force).cwiseAbs().maxCoeff();
    bool same = next.contact == normal.contact;
    normal = std::move(next);
    state.reached_border = touches_border(grid, normal.contact);
    state.reason = fault_of(model, grid, normal, state.reached_border);
    if (!state.reason.empty()) break;
    if (frictionless) {
      state.status = Status::converged;
      break;
    }
    const CoatingMoments moments = coating(normal, tangential.force_x, tangential.force_y);
    StickSlip found =
        stick_slip_solver->solve(normal.contact, normal.force, inner_tolerance, coating_in_drive(model, moments));
    state.iterations += found.iterations;
    change = std::max(change, (found.force_x - tangential.force_x).cwiseAbs().maxCoeff());
    if (lateral) change = std::max(change, (found.force_y - tangential.force_y).cwiseAbs().maxCoeff());
    same = same && found.zone == tangential.zone;
    tangential = std::move(found);
    const double largest = normal.force.cwiseAbs().maxCoeff();
    inner_tolerance = std::clamp(1e-3 * change / largest, 1e-11, inner_tolerance);
    if (same && change < 1e-10 * largest) {
      state.status = tangential.status;
      state.reason = tangential.reason;
      state.friction_needed = tangential.friction_needed;
      break;
    }
    failures = tangential.status == Status::not_converged ? failures + 1 : 0;
    if (failures == 3) {
      state.reason = tangential.reason;
      break;
    }
    if (pass == pass_limit) {
      state.reason = unsettled(pass, change / largest, same);
      break;
    }
  }
  take_forces(normal, tangential, frictionless, state);
  return state;
}

}  // namespace

ContactState solve_active_set(const ContactModel& model, const InfluenceTable& table, const SurfaceGrid& candidate) {
  return model.dimension == 3 ? combined_loop<SurfaceStickSlip>(model, table, candidate)
                              : combined_loop<LineStickSlip>(model, table, candidate);
}

}  // namespace rollres
