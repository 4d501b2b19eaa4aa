#include "core/newton/contact_laws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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
    if (problem.sphere) maps.slip_y.resize(size);
  }
  const double scale = std::max(x.pressure.cwiseAbs().maxCoeff(), 1e-300);
  const double friction = problem.scene.friction_coefficient;
  const double per_friction = 1 / std::min(1.0, std::max(friction, 1e-300));  // shear is measured by mu p
  const auto count = [&](double residual) {
    const double relative = std::abs(residual) / scale;
    maps.largest = std::max(maps.largest, relative);
    maps.mean_square += relative * relative;
  };
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Index i = grid.index(column, row), at = static_cast<Eigen::Index>(row) * (grid.columns + 1) + column;
      maps.gap(i) = problem.profile(i) - x.approach - maps.moved.w(at);
      const double gap = maps.gap(i) / influence.self_normal(), pressure = x.pressure(i);
      if (problem.scene.adhesion_threshold > 0) {
        if (in_contact[static_cast<std::size_t>(i)]) {
          count(gap);
          count(std::min(0.0, pressure + problem.scene.adhesion_threshold));
        } else {
          count(std::min(0.0, gap));
        }
      } else {
        count(pressure - std::max(0.0, pressure - gap));
      }
      if (!problem.friction) continue;
      maps.slip_x(i) =
          1 + (maps.moved.u(at + 1) - maps.moved.u(at)) / grid.spacing_x - x.rotation_ratio * problem.rolling_radius(i);
      if (problem.sphere) maps.slip_y(i) = (maps.moved.v(at + 1) - maps.moved.v(at)) / grid.spacing_x;
      const double bound = friction * std::abs(pressure);
      if (bound == 0 && x.shear_x(i) == 0) continue;
      const double qx = x.shear_x(i) + maps.slip_x(i) / influence.self_slip();
      const double qy =
          problem.sphere && grid.first_row + row > 0 ? x.shear_y(i) + maps.slip_y(i) / influence.self_slip() : 0;
      const double length = std::hypot(qx, qy), factor = length > bound ? bound / length : 1;
      count((x.shear_x(i) - factor * qx) * per_friction);
      if (problem.sphere) count((x.shear_y(i) - factor * qy) * per_friction);
    }
  const Vector none = Vector::Zero(size);
  const Vector& shear = problem.friction ? x.shear_x : none;
  if (problem.load_given()) {
    const double missing = *problem.scene.load - problem.load(x.pressure, shear);
    count(missing / *problem.scene.load * scale);
  }
  if (problem.friction && !problem.rotation_given()) {
    const double force = std::max(problem.load(x.pressure, shear), 1e-300);
    count((problem.drive_target - problem.drive(x.pressure, shear)) / force * scale);
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
    const double threshold = before[i] ? -problem.scene.adhesion_threshold : 0;
    now[i] = x.pressure(node) - maps.gap(node) / influence.self_normal() > threshold;
  }
  return now;
}

ActiveLaws choose_laws(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                       const NaturalMaps& maps, const ContactMask& contact, bool all_stick) {
  ActiveLaws laws;
  for (std::size_t i = 0; i < contact.size(); ++i)
    if (contact[i]) laws.contact.push_back(static_cast<Eigen::Index>(i));
  const auto n = static_cast<Eigen::Index>(laws.contact.size());
  laws.zone.assign(laws.contact.size(), Zone::stick);
  laws.direction_x = laws.direction_y = laws.beta = Vector::Zero(n);
  if (!problem.friction || all_stick) return laws;
  const double per_slip = 1 / influence.self_slip();
  bool sticking = false;
  Eigen::Index closest = 0;  // to sticking
  double least_excess = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index node = laws.contact[static_cast<std::size_t>(i)];
    const double qx = x.shear_x(node) + maps.slip_x(node) * per_slip;
    const double qy = problem.sphere ? x.shear_y(node) + maps.slip_y(node) * per_slip : 0;
    const double size = std::hypot(qx, qy);
    const double bound = problem.scene.friction_coefficient * std::abs(x.pressure(node));
    if (size <= bound) {
      sticking = true;
      continue;
    }
    if (size - bound < least_excess) {
      least_excess = size - bound;
      closest = i;
    }
    laws.zone[static_cast<std::size_t>(i)] = Zone::slip;
    laws.direction_x(i) = qx / size;
    laws.direction_y(i) = qy / size;
    laws.beta(i) = bound / size;
  }
  // Without any sticking node of a cylinder the drive could not determine the rotation; a sphere's slip also has a
  // direction, which the rotation turns.
  if (!sticking && n > 0 && !problem.rotation_given() && !problem.sphere)
    laws.zone[static_cast<std::size_t>(closest)] = Zone::stick;
  return laws;
}

LawResiduals law_residuals(const ContactProblem& problem, const InfluenceOperator& influence, const ContactUnknowns& x,
                           const NaturalMaps& maps, const ActiveLaws& laws) {
  const auto n = static_cast<Eigen::Index>(laws.contact.size());
  LawResiduals right;
  right.normal.resize(n);
  const double friction = problem.scene.friction_coefficient;
  if (problem.friction) right.shear_x = right.shear_y = Vector::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index node = laws.contact[static_cast<std::size_t>(i)];
    right.normal(i) = -maps.gap(node) / influence.self_normal();
    if (!problem.friction) continue;
    if (laws.zone[static_cast<std::size_t>(i)] == Zone::stick) {
      right.shear_x(i) = maps.slip_x(node) / influence.self_slip();
      if (problem.sphere) right.shear_y(i) = maps.slip_y(node) / influence.self_slip();
    } else {
      const double bound = friction * std::abs(x.pressure(node));
      right.shear_x(i) = bound * laws.direction_x(i) - x.shear_x(node);
      if (problem.sphere) right.shear_y(i) = bound * laws.direction_y(i) - x.shear_y(node);
    }
    if (problem.sphere && problem.grid.first_row + node / problem.grid.columns == 0)
      right.shear_y(i) = -x.shear_y(node);
  }
  const Vector none = Vector::Zero(x.pressure.size());
  const Vector& shear = problem.friction ? x.shear_x : none;
  if (problem.load_given()) right.load = *problem.scene.load - problem.load(x.pressure, shear);
  if (problem.friction && !problem.rotation_given())
    right.drive = problem.drive_target - problem.drive(x.pressure, shear);
  return right;
}

}  // namespace rollres
