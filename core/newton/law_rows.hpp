#pragma once

/// The rows of the linearised laws of contact, in double precision for factorisation, in single for GMRES.
///
/// For increments (dp, dtau, dd, domega) that vanish outside the contact these are the left sides of
/// core/newton/README.md, (N8), load and drive over a scale of force. Unknowns and rows stand in the same order:
/// pressure, shear_x, shear_y at the nodes in contact, then what the border has of d/kappa and omega/sigma.

#include <vector>

#include "core/newton/contact_problem.hpp"

namespace rollres {

/// A row of the linearised laws, by traction at all nodes; for a straight cylinder without shear_y.
struct TractionRow {
  Vector of_pressure, of_shear_x, of_shear_y;
};

/// Which law holds at each node in contact, and its linearisation. The natural scale of displacements and slips is
/// chosen such that every row is in pascal: normal and stick rows are divided by the response of a node to itself.
struct ActiveLaws {
  std::vector<Eigen::Index> contact;  // nodes in contact
  std::vector<Zone> zone;             // of those nodes: stick or slip (stick if frictionless)
  // At slipping nodes: direction of friction, beta = mu p / |q| of the projection, and what the bound has of p, mu.
  Vector direction_x, direction_y, beta, slope;
  TractionRow coating;  // what the drive's row has of a coating's M and N (N3b, N3e); empty without
};

/// What the tractions of an increment do at the nodes in contact: w/kappa, slip/sigma [Pa].
template <class Real>
struct ScaledResponse {
  Eigen::Matrix<Real, Eigen::Dynamic, 1> w, slip_x, slip_y;
};

template <class Real>
class LawRows {
 public:
  using VectorR = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

  LawRows(const ContactProblem& problem, const ActiveLaws& laws);

  Eigen::Index contacts() const { return contacts_; }
  Eigen::Index components() const { return components_; }  // unknown tractions per node in contact: 1, 2 or 3
  Eigen::Index border() const { return border_; }          // further unknowns: d and omega as far as they are unknown
  Eigen::Index unknowns() const { return components_ * contacts_ + border_; }
  bool approach_unknown() const { return approach_unknown_; }
  bool rotation_unknown() const { return rotation_unknown_; }
  double force_scale() const { return force_scale_; }  // border rows are divided by it [N/Pa]

  /// All rows; `response` is that of x's tractions (the border's share is added here).
  VectorR operator()(const VectorR& x, const ScaledResponse<Real>& response) const;
  /// The rows of load and drive alone.
  VectorR border_rows(const VectorR& x) const;
  bool sheared_across(Eigen::Index contact) const { return sheared_across_[static_cast<std::size_t>(contact)] != 0; }
  bool sticks(Eigen::Index contact) const { return sticks_[static_cast<std::size_t>(contact)] != 0; }
  Real along_x(Eigen::Index contact) const { return slope_(contact) * direction_x_(contact); }
  Real along_y(Eigen::Index contact) const { return slope_(contact) * direction_y_(contact); }

 private:
  Eigen::Index contacts_, components_, border_;
  bool approach_unknown_, rotation_unknown_;
  double force_scale_;
  VectorR direction_x_, direction_y_, beta_, slope_, turning_, turning_y_;
  VectorR load_, load_shear_, drive_, drive_shear_, drive_shear_y_;  // over force_scale
  std::vector<char> sticks_, sheared_across_;
};

}  // namespace rollres
