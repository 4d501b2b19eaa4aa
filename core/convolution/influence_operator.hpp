#pragma once

/// Surface displacements from surface tractions: convolution with the influence coefficients by fast Fourier
/// transform on a padded grid.
///
/// On a folded grid p, tau_x, w and u are even in y, tau_y and v odd, so that one complex transform carries all three
/// tractions and one all three displacements (padded_convolution.hpp); on a whole one they are any
/// (plane_convolution.hpp). Under a skewed cylinder v answers tau_y alone, by a transform of its own.

#include <Eigen/Core>
#include <memory>

#include "core/convolution/surface_convolution.hpp"
#include "core/influence/influence.hpp"
#include "core/model/indenter_shape.hpp"
#include "core/numerics/vector.hpp"

namespace rollres {

template <class Real>
class KrylovOperator;

/// Displacements at the grid's nodes and one column beyond, x running fastest: size (columns + 1) * rows [m].
struct Displacements {
  Vector w, u, v;
};

/// Transforms of the influence coefficients [m/Pa], normalised for the inverse transform; without friction ww only,
/// without v for a straight cylinder, vv alone for a skewed one. wu is that of w under shear, of rings alone: else it
/// is uw.
struct InfluenceSpectra {
  Spectrum<double> ww, uu, vv, uv, uw, vw, wu;
  const Spectrum<double>& of_shear() const { return wu.re.empty() ? uw : wu; }
};

/// An operator serves one thread at a time (it keeps work space).
class InfluenceOperator {
 public:
  /// @param grid as of ContactProblem   @param friction false: only w from p will be wanted
  InfluenceOperator(const ContactModel& model, const InfluenceTable& table, const SurfaceGrid& grid, bool friction);
  ~InfluenceOperator();

  /// Tractions [Pa] on the grid. Empty shear: only w is computed; shear_y is empty for a straight cylinder.
  Displacements apply(const Vector& pressure, const Vector& shear_x, const Vector& shear_y) const;

  /// The same of the coating's part, and what it does to those who move it: the coefficients with offsets the other
  /// way. None without a coating; made when first asked for.
  const InfluenceOperator* coating() const { return part(coating_, coating_table_, false); }
  const InfluenceOperator* coating_transposed() const { return part(transposed_, coating_table_, true); }

  /// Displacement w at a node from unit pressure on its own cell, taken positive [m/Pa].
  double self_normal() const { return self_normal_; }
  /// Change of slip along x at a node for unit shear traction on its own cell, taken positive [1/Pa].
  double self_slip() const { return self_slip_; }

  /// What an iterative solution of the linearised laws asks for, in either precision; made when first asked for.
  template <class Real>
  KrylovOperator<Real>& krylov() const;
  /// Whether iterations in single precision have reached what they were asked for so far.
  bool single_precision_suffices() const { return single_precision_suffices_; }
  void demand_double_precision() const { single_precision_suffices_ = false; }

 private:
  EvenTransform<double>& even_transform() const;
  const InfluenceOperator* part(std::unique_ptr<InfluenceOperator>& made,
                                const std::shared_ptr<const InfluenceTable>& table, bool reversed) const;

  ContactModel model_;
  SurfaceGrid grid_;
  bool lateral_, friction_;  // shear and displacements along y, as of a plane; shear
  PaddedSize padded_;
  InfluenceSpectra spectra_;
  mutable std::unique_ptr<SurfaceConvolution<double>> transform_;
  mutable std::unique_ptr<EvenTransform<double>> even_transform_;
  mutable bool single_precision_suffices_ = true;
  mutable std::unique_ptr<KrylovOperator<float>> single_;
  mutable std::unique_ptr<KrylovOperator<double>> double_;
  double self_normal_ = 0, self_slip_ = 0;
  std::shared_ptr<const InfluenceTable> coating_table_;
  mutable std::unique_ptr<InfluenceOperator> coating_, transposed_;
};

}  // namespace rollres
