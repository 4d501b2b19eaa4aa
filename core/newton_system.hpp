#pragma once

/// One linearised step of the contact problem: the active laws at the nodes in contact, bordered by the load and the
/// drive. Solved by dense factorisation or by preconditioned GMRES; both see the same rows.

#include <vector>

#include "core/contact_problem.hpp"
#include "core/influence.hpp"
#include "core/influence_operator.hpp"

namespace rollres {

/// Unknowns of the contact problem on the whole (half) grid.
struct ContactUnknowns {
  Vector pressure, shear_x, shear_y;  // [Pa]; shear_y empty for a cylinder, both empty without friction
  double approach = 0;                // d [m]
  double rotation_ratio = 0;          // omega [1]

  ContactUnknowns& add(double factor, const ContactUnknowns& other);
};

/// Which law holds at each node in contact, and its linearisation. The natural scale of displacements and slips is
/// chosen such that every row is in pascal: normal and stick rows are divided by the response of a node to itself.
struct ActiveLaws {
  std::vector<Eigen::Index> contact;  // nodes in contact
  std::vector<Zone> zone;             // of those nodes: stick or slip (stick if frictionless)
  // At slipping nodes: direction of friction, and beta = mu p / |q| of the projection.
  Vector direction_x, direction_y, beta;
};

/// Right-hand sides of the rows, on the contact nodes in the order of ActiveLaws::contact, and of the border.
struct LawResiduals {
  Vector normal, shear_x, shear_y;  // [Pa]
  double load = 0, drive = 0;       // [N] (per metre for a cylinder)
};

struct LinearStep {
  ContactUnknowns step;
  int iterations = 0;  // of GMRES
  bool solved = false;
};

/// Rows of the linearised laws for increments (dp, dtau, dd, domega) that vanish outside the contact:
///   normal: -(dw + dd)/kappa,   stick: -dslip/sigma,
///   slip:   dtau - mu n dp - beta (I - n n^T)(dtau + dslip/sigma)
class NewtonSystem {
 public:
  NewtonSystem(const ContactProblem& problem, const InfluenceOperator& influence, const ActiveLaws& laws);

  /// Factorises the dense matrix built from the coefficients themselves.
  LinearStep solve_dense(const InfluenceTable& table, const LawResiduals& residuals) const;
  /// Right-preconditioned GMRES to a relative residual.
  LinearStep solve_krylov(const LawResiduals& residuals, double tolerance, int most_iterations) const;

 private:
  Eigen::Index contacts() const { return static_cast<Eigen::Index>(laws_.contact.size()); }
  Eigen::Index unknowns() const { return components_ * contacts() + border_; }
  Vector pack(const LawResiduals& residuals) const;
  ContactUnknowns unpack(const Vector& x) const;
  Vector apply(const Vector& x) const;
  Vector rows_from(const ContactUnknowns& increment, const Displacements& moved) const;
  Vector precondition(const Vector& right_side) const;
  Vector precondition_laws(const Vector& right_side) const;

  const ContactProblem& problem_;
  const InfluenceOperator& influence_;
  const ActiveLaws& laws_;
  Eigen::Index components_;  // unknown tractions per node in contact: 1, 2 or 3
  Eigen::Index border_;      // further unknowns: d and omega as far as they are unknown
  bool approach_unknown_, rotation_unknown_;
  double force_scale_;                       // border rows are divided by it [N/Pa]
  mutable Eigen::MatrixXd border_response_;  // preconditioned columns of the border
  mutable Eigen::MatrixXd border_schur_;     // and what they leave in the border's rows, inverted
};

}  // namespace rollres
