#include "core/newton/contact_laws.hpp"

#include <algorithm>
#include <cmath>

#include "core/newton/contact_powers.hpp"

namespace rollres {

NaturalMaps natural_maps(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                         const ContactMask& in_contact) {
  NaturalMaps maps;
  maps.moved = influence.apply(x.pressure, x.shear_x, x.shear_y);
  const SurfaceGrid& grid = problem.grid;
  const Eigen::Index size = grid.size();
  maps.gap.resize(size);
  if (problem.friction) {
    maps.slip_x.resize(size);
    if (problem.lateral) maps.slip_y.resize(size);
  }
  const double scale = std::max(x.pressure.cwiseAbs().maxCoeff(), 1e-300);
  // Shear is measured by its bound.
  const double per_friction = 1 / std::min(1.0, std::max(problem.law.slope(0), 1e-300));
  const auto count = [&](double residual) {
    const double relative = std::abs(residual) / scale;
    maps.largest = std::max(maps.largest, relative);
    maps.mean_square += relative * relative;
  };
  for (int row = 0; problem.friction && row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Index i = grid.index(column, row), at = static_cast<Eigen::Index>(row) * (grid.columns + 1) + column;
      maps.slip_x(i) = problem.slip_x(i, (maps.moved.u(at + 1) - maps.moved.u(at)) / grid.spacing_x, x.rotation_ratio);
      if (problem.lateral)
        maps.slip_y(i) =
            problem.slip_y(i, (maps.moved.v(at + 1) - maps.moved.v(at)) / grid.spacing_x, x.rotation_ratio);
    }
  if (problem.friction) problem.edge.add(x.shear_x, x.shear_y, maps.slip_x, maps.slip_y);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Index i = grid.index(column, row), at = static_cast<Eigen::Index>(row) * (grid.columns + 1) + column;
      maps.gap(i) = problem.profile(i) - x.approach - maps.moved.w(at);
      const double gap = maps.gap(i) / influence.self_normal(), pressure = x.pressure(i);
      if (problem.model.adhesion_threshold > 0) {
        if (in_contact[static_cast<std::size_t>(i)]) {
          count(gap);
          count(std::min(0.0, pressure + problem.model.adhesion_threshold));
        } else {
          count(std::min(0.0, gap));
        }
      } else {
        count(pressure - std::max(0.0, pressure - gap));
      }
      if (!problem.friction) continue;
      if (pressure == 0 && x.shear_x(i) == 0) continue;
      const double qx = x.shear_x(i) + maps.slip_x(i) / influence.self_slip();
      const double qy = problem.sheared_across(i) ? x.shear_y(i) + maps.slip_y(i) / influence.self_slip() : 0;
      const FrictionProjection projection = problem.law.project(pressure, qx, qy);
      count((x.shear_x(i) - projection.x()) * per_friction);
      if (problem.lateral) count((x.shear_y(i) - projection.y()) * per_friction);
    }
  if (problem.load_given()) {
    const double missing = *problem.model.load - problem.load(x.pressure, x.shear_x, x.shear_y);
    count(missing / *problem.model.load * scale);
  }
  if (problem.friction && !problem.rotation_given()) {
    const double force = std::max(problem.load(x.pressure, x.shear_x, x.shear_y), 1e-300);
    if (problem.coating_drives()) maps.coating = coating_moments(problem, influence, x);
    count(problem.drive_surplus(x.pressure, x.shear_x, x.shear_y, maps.coating) / force * scale);
  }
  return maps;
}

ContactMask loaded_nodes(const ContactUnknowns& x) {
  ContactMask loaded(static_cast<std::size_t>(x.pressure.size()));
  for (std::size_t i = 0; i < loaded.size(); ++i) loaded[i] = x.pressure(static_cast<Eigen::Index>(i)) != 0;
  return loaded;
}

ContactMask choose_contact(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                           const NaturalMaps& maps, const ContactMask& before) {
  ContactMask now(before.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    const auto node = static_cast<Eigen::Index>(i);
    const double threshold = before[i] ? -problem.model.adhesion_threshold : 0;
    now[i] = x.pressure(node) - maps.gap(node) / influence.self_normal() > threshold;
  }
  return now;
}

namespace {

/// Where all nodes of a cylinder slide: lets that one stick at whose rotation the drive is met, if the nodes that stick
/// at a higher rotation slide forwards and the others backwards; the last one if sliding does not meet the drive.
void let_one_stick(const ContactProblem& problem, const ContactUnknowns& x, const NaturalMaps& maps, ActiveLaws& laws) {
  struct Sliding {
    double rotation;  // at which the node would stick
    double power;     // of its friction in the drive's row, per sign
    std::size_t place;
  };
  std::vector<Sliding> nodes;
  double surplus =
      problem.drive.of_pressure.dot(x.pressure) + problem.coating_in_drive(maps.coating) - problem.drive_target;
  for (std::size_t i = 0; i < laws.contact.size(); ++i) {
    const Eigen::Index node = laws.contact[i];
    const double power = problem.drive.of_shear_x(node) * problem.law.bound(x.pressure(node));
    nodes.push_back({x.rotation_ratio + maps.slip_x(node) / problem.turning(node), power, i});
    surplus += power;  // at a low rotation all slide forwards
  }
  std::sort(nodes.begin(), nodes.end(), [](const Sliding& a, const Sliding& b) { return a.rotation < b.rotation; });
  std::size_t sticking = 0;
  while (sticking + 1 < nodes.size() && (surplus -= 2 * nodes[sticking].power) < 0) ++sticking;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    laws.direction_x(static_cast<Eigen::Index>(nodes[k].place)) = k < sticking ? -1 : 1;
  laws.zone[nodes[sticking].place] = Zone::stick;
}

}  // namespace

ActiveLaws choose_laws(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                       const NaturalMaps& maps, const ContactMask& contact, bool all_stick) {
  ActiveLaws laws;
  for (std::size_t i = 0; i < contact.size(); ++i)
    if (contact[i]) laws.contact.push_back(static_cast<Eigen::Index>(i));
  const auto n = static_cast<Eigen::Index>(laws.contact.size());
  laws.zone.assign(laws.contact.size(), Zone::stick);
  laws.direction_x = laws.direction_y = laws.beta = laws.slope = Vector::Zero(n);
  if (!problem.friction || all_stick) return laws;
  const double per_slip = 1 / influence.self_slip();
  bool sticking = false;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index node = laws.contact[static_cast<std::size_t>(i)];
    const FrictionProjection projection =
        problem.law.project(x.pressure(node), x.shear_x(node) + maps.slip_x(node) * per_slip,
                            problem.lateral ? x.shear_y(node) + maps.slip_y(node) * per_slip : 0);
    if (!projection.slips()) {
      sticking = true;
      continue;
    }
    laws.zone[static_cast<std::size_t>(i)] = Zone::slip;
    laws.direction_x(i) = projection.direction_x();
    laws.direction_y(i) = projection.direction_y();
    laws.beta(i) = projection.beta();
    laws.slope(i) = problem.law.slope(x.pressure(node));
  }
  // Without any sticking node of a cylinder the drive could not determine the rotation; where slip has a component
  // along y, the rotation turns its direction.
  if (!sticking && n > 0 && !problem.rotation_given() && !problem.lateral) let_one_stick(problem, x, maps, laws);
  return laws;
}

LawResiduals law_residuals(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                           const NaturalMaps& maps, const ActiveLaws& laws) {
  const auto n = static_cast<Eigen::Index>(laws.contact.size());
  LawResiduals right;
  right.normal.resize(n);
  if (problem.friction) right.shear_x = right.shear_y = Vector::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index node = laws.contact[static_cast<std::size_t>(i)];
    right.normal(i) = -maps.gap(node) / influence.self_normal();
    if (!problem.friction) continue;
    if (laws.zone[static_cast<std::size_t>(i)] == Zone::stick) {
      right.shear_x(i) = maps.slip_x(node) / influence.self_slip();
      if (problem.lateral) right.shear_y(i) = maps.slip_y(node) / influence.self_slip();
    } else {
      const double bound = problem.law.bound(x.pressure(node));
      right.shear_x(i) = bound * laws.direction_x(i) - x.shear_x(node);
      if (problem.lateral) right.shear_y(i) = bound * laws.direction_y(i) - x.shear_y(node);
    }
    if (problem.lateral && !problem.sheared_across(node)) right.shear_y(i) = -x.shear_y(node);
  }
  if (problem.load_given()) right.load = *problem.model.load - problem.load(x.pressure, x.shear_x, x.shear_y);
  if (problem.friction && !problem.rotation_given())
    right.drive = -problem.drive_surplus(x.pressure, x.shear_x, x.shear_y, maps.coating);
  return right;
}

}  // namespace rollres
