#include "core/newton/law_rows.hpp"

#include <cmath>
#include <tuple>

namespace rollres {

template <class Real>
LawRows<Real>::LawRows(const ContactProblem& problem, const ActiveLaws& laws)
    : contacts_(static_cast<Eigen::Index>(laws.contact.size())),
      components_(problem.components()),
      approach_unknown_(problem.load_given()),
      rotation_unknown_(problem.friction && !problem.rotation_given()),
      force_scale_(problem.load.of_pressure.maxCoeff() * std::sqrt(static_cast<double>(laws.contact.size()))) {
  border_ = (approach_unknown_ ? 1 : 0) + (rotation_unknown_ ? 1 : 0);
  const auto gathered = [&](const Vector& field, double factor) {
    VectorR values(contacts_);
    for (Eigen::Index i = 0; i < contacts_; ++i)
      values(i) = static_cast<Real>(field(laws.contact[static_cast<std::size_t>(i)]) * factor);
    return values;
  };
  const double per_force = 1 / force_scale_;
  load_ = gathered(problem.load.of_pressure, per_force);
  if (components_ == 1) return;
  load_shear_ = gathered(problem.load.of_shear_x, per_force);
  drive_ = gathered(problem.drive.of_pressure, per_force);
  drive_shear_ = gathered(problem.drive.of_shear_x, per_force);
  if (components_ > 2) drive_shear_y_ = gathered(problem.drive.of_shear_y, per_force);
  if (laws.coating.of_pressure.size() > 0) {
    drive_ += gathered(laws.coating.of_pressure, per_force);
    drive_shear_ += gathered(laws.coating.of_shear_x, per_force);
    if (components_ > 2) drive_shear_y_ += gathered(laws.coating.of_shear_y, per_force);
  }
  turning_ = gathered(problem.turning, 1);
  if (components_ > 2) turning_y_ = gathered(problem.turning_y, 1);
  direction_x_ = laws.direction_x.cast<Real>();
  direction_y_ = laws.direction_y.cast<Real>();
  beta_ = laws.beta.cast<Real>();
  slope_ = laws.slope.cast<Real>();
  for (Eigen::Index i = 0; i < contacts_; ++i) {
    const auto c = static_cast<std::size_t>(i);
    sticks_.push_back(laws.zone[c] == Zone::stick);
    sheared_across_.push_back(problem.sheared_across(laws.contact[c]));
  }
}

template <class Real>
auto LawRows<Real>::border_rows(const VectorR& x) const -> VectorR {
  VectorR rows(border_);
  const auto pressure = x.head(contacts_);
  Eigen::Index at = 0;
  if (components_ == 1) {
    if (approach_unknown_) rows(at) = load_.dot(pressure);
    return rows;
  }
  const auto shear = x.segment(contacts_, contacts_);
  if (approach_unknown_) rows(at++) = load_.dot(pressure) + load_shear_.dot(shear);
  if (rotation_unknown_) {
    rows(at) = drive_.dot(pressure) + drive_shear_.dot(shear);
    if (components_ > 2) rows(at) += drive_shear_y_.dot(x.segment(2 * contacts_, contacts_));
  }
  return rows;
}

template <class Real>
auto LawRows<Real>::operator()(const VectorR& x, const ScaledResponse<Real>& response) const -> VectorR {
  const Eigen::Index n = contacts_, first = components_ * n;
  VectorR rows(unknowns());
  const Real approach = approach_unknown_ ? x(first) : Real(0);
  rows.head(n) = -(response.w.array() + approach).matrix();
  if (border_ > 0) rows.tail(border_) = border_rows(x);
  if (components_ == 1) return rows;

  const Real rotation = rotation_unknown_ ? x(unknowns() - 1) : Real(0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Real slip_x = response.slip_x(i) - turning_(i) * rotation;
    const Real slip_y = components_ > 2 ? response.slip_y(i) - turning_y_(i) * rotation : Real(0);
    const Real tx = x(n + i), ty = components_ > 2 ? x(2 * n + i) : Real(0);
    Real row_x = -slip_x, row_y = -slip_y;
    if (!sticks(i))
      std::tie(row_x, row_y) =
          slip_row(slope_(i), direction_x_(i), direction_y_(i), beta_(i), x(i), tx, ty, tx + slip_x, ty + slip_y);
    rows(n + i) = row_x;
    // On the axis of symmetry tau_y vanishes.
    if (components_ > 2) rows(2 * n + i) = sheared_across(i) ? row_y : ty;
  }
  return rows;
}

template class LawRows<double>;
template class LawRows<float>;

}  // namespace rollres
