#pragma once

/// How the real edge of a sphere's contact changes the slip beside it (core/newton/README.md, section 8).

#include <vector>

#include "core/edge/edge_curve.hpp"
#include "core/model/contact_model.hpp"
#include "core/numerics/vector.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// What the slip of nodes beside the edge has more than that of even cells: linear in the shear (N25), (N26).
class EdgeSlip {
 public:
  EdgeSlip() = default;
  /// @param in_contact a flag for each node
  EdgeSlip(const ContactModel& model, const SurfaceGrid& grid, const EdgeCurve& curve,
           const std::vector<char>& in_contact);

  const EdgeCurve& curve() const { return curve_; }

  /// Adds it to slips [1] that shear tractions [Pa] cause, all on the grid.
  template <class Field>
  void add(const Field& shear_x, const Field& shear_y, Field& slip_x, Field& slip_y) const {
    using Real = typename Field::Scalar;
    for (const Term& term : terms_) {
      const Real x = shear_x(term.source), y = shear_y(term.source);
      slip_x(term.target) += static_cast<Real>(term.xx) * x + static_cast<Real>(term.xy) * y;
      slip_y(term.target) += static_cast<Real>(term.yx) * x + static_cast<Real>(term.yy) * y;
    }
  }

 private:
  struct Term {
    Eigen::Index target, source;
    double xx, xy, yx, yy;  // [1/Pa]
  };
  EdgeCurve curve_;
  std::vector<Term> terms_;
};

}  // namespace rollres
