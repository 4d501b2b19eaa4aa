#pragma once

/// One linearised step of the contact problem: the active laws at the nodes in contact, bordered by the load and the
/// drive. Solved by dense factorisation or by preconditioned GMRES; both see the same rows.

#include <vector>

#include "core/convolution/influence_operator.hpp"
#include "core/influence/influence.hpp"
#include "core/newton/contact_problem.hpp"
#include "core/newton/law_rows.hpp"

namespace rollres {

/// Unknowns of the contact problem on the whole (half) grid.
struct ContactUnknowns {
  Vector pressure, shear_x, shear_y;  // [Pa]; shear_y empty for a straight cylinder, both empty without friction
  double approach = 0;                // d [m]
  double rotation_ratio = 0;          // omega [1]

  ContactUnknowns& add(double factor, const ContactUnknowns& other);
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

/// Solves the rows of law_rows.hpp for the increments of one step.
class NewtonSystem {
 public:
  NewtonSystem(const ContactProblem& problem, const InfluenceOperator& influence, const ActiveLaws& laws)
      : problem_(problem), influence_(influence), laws_(laws) {}

  /// Factorises the dense matrix built from the coefficients themselves.
  LinearStep solve_dense(const InfluenceTable& table, const LawResiduals& residuals) const;
  /// GMRES to a relative residual, right-preconditioned by core/newton/README.md, (N10) to (N12): in single precision,
  /// refined in double, unless that has failed with this operator.
  LinearStep solve_krylov(const LawResiduals& residuals, double tolerance, int most_iterations) const;

 private:
  ScaledResponse<double> response_to(const InfluenceTable& table, const LawRows<double>& rows, Eigen::Index component,
                                     Eigen::Index source) const;
  ContactUnknowns unpack(const Vector& x, const LawRows<double>& rows) const;
  Vector apply(const Vector& x, const LawRows<double>& rows) const;

  const ContactProblem& problem_;
  const InfluenceOperator& influence_;
  const ActiveLaws& laws_;
};

}  // namespace rollres
