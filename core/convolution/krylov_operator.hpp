#pragma once

/// The influence operator as GMRES asks for it, in single or double precision, with an approximate inverse for
/// preconditioning.
///
/// Slips, du/dx and dv/dx by forward differences, are convolved as such: taken from displacements afterwards they
/// would lose the digits that single precision does not have to spare.

#include <Eigen/Core>

#include "core/convolution/influence_operator.hpp"

namespace rollres {

template <class Real>
class KrylovOperator {
 public:
  using Field = Eigen::Matrix<Real, Eigen::Dynamic, 1>;  // on the grid

  struct Response {
    Field w;               // [m]
    Field slip_x, slip_y;  // [1]
  };
  struct Tractions {
    Field pressure, shear_x, shear_y;  // [Pa]
  };

  /// @param padded size of the spectra
  KrylovOperator(const ContactModel& model, const SurfaceGrid& grid, PaddedSize padded, const InfluenceSpectra& spectra,
                 bool friction);

  /// Displacement w and change of slip from tractions [Pa]. Empty shear: only w is computed; shear_y is empty for
  /// a straight cylinder.
  void apply(const Tractions& tractions, Response& response);

  /// Approximately the pressure that gives -w and the shear that gives minus the slip, by the reciprocal of the
  /// layer's symbols on the whole padded grid [Pa] (core/newton/README.md, (N10)); slips may be empty. The symbols are
  /// those of the layer and not of the truncated coefficients, whose jump at the ends of the window can put a zero
  /// among them.
  void approximate_inverse(const Response& wanted, Tractions& tractions);

 private:
  void prepare_inverses(const ContactModel& model, bool friction);
  EvenTransform<Real>& even_transform();
  /// Of a skewed cylinder: `to` is the kernel times `from`, both along its axle.
  void along_axle(const Field& from, const Spectrum<Real>& kernel, Field& to);

  SurfaceGrid grid_;
  bool lateral_;  // shear along y, as of a plane
  PaddedSize padded_;
  std::unique_ptr<SurfaceConvolution<Real>> transform_;
  std::unique_ptr<EvenTransform<Real>> even_transform_;
  const Field none_;
  Spectrum<Real> ww_, wu_, vw_;  // of displacements under shear
  Spectrum<Real> slip_uw_, slip_vw_, slip_uu_, slip_uv_, slip_vv_;
  Spectrum<Real> inverse_ww_, inverse_xx_, inverse_xy_, inverse_yy_;
};

}  // namespace rollres
