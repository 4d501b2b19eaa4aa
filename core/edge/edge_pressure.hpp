#pragma once

/// The pressure of a sphere's contact whose edge is known: what cells do over which it is spread like sqrt(F)
/// (core/newton/README.md, section 9).

#include <vector>

#include "core/edge/edge_cells.hpp"
#include "core/edge/edge_curve.hpp"
#include "core/model/contact_model.hpp"
#include "core/numerics/vector.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// Operators on pressures of the cells of a half grid whose nodes lie inside the edge; a cell that only reaches into
/// the contact leaves its part to them.
class EdgePressure {
 public:
  EdgePressure(const ContactModel& model, const SurfaceGrid& half, const EdgeCurve& curve);

  /// Whether the contact keeps clear of the grid's border.
  bool fits() const { return fits_; }
  const std::vector<Eigen::Index>& contact() const { return contact_; }

  /// Pressures of even cells with the same forces and moments as the uneven ones (N29) [Pa].
  template <class Field>
  Field even(const Field& pressure) const {
    Field spread = Field::Zero(pressure.size());
    for (const Share& share : spread_)
      spread(share.target) += static_cast<typename Field::Scalar>(share.value) * pressure(share.source);
    return spread;
  }
  /// Adds to displacements w [m] of the nodes inside the edge what uneven cells beside them do more than those (N30).
  template <class Field>
  void add_near(const Field& pressure, Field& w) const {
    for (const Share& share : near_)
      w(share.target) += static_cast<typename Field::Scalar>(share.value) * pressure(share.source);
  }
  /// Mean pressure over the cells themselves, without what they bear of others [Pa].
  Vector of_cells(const Vector& pressure) const { return pressure.cwiseProduct(own_); }

 private:
  struct Share {
    Eigen::Index target, source;
    double value;
  };
  class Assembly;

  bool fits_ = true;
  std::vector<Eigen::Index> contact_;
  std::vector<Share> spread_, near_;
  Vector own_;
};

}  // namespace rollres
