#pragma once

/// Shear along the axle inside the layers of a skewed cylinder's contact, in steady motion: v, tau_xy and tau_yz.
///
/// The same on all planes across the axle, it is antiplane shear: it has no part in the field of the plane
/// (interior_field.hpp), and that has none in it. A wave e^{ikx} of the traction along the axle is one of
/// transverse_response.hpp with the moduli G*(-k V). The waves are those of the plane, the shortest of which are
/// shorter than the traction's cells. Of a ring with radius R antiplane shear is that of flat layers at the depths R
/// ln(R/r), with stresses R/r times as large. What it adds to the power lost on a line of flow is (V/pi) int_0^inf k
/// Im[J] |tau|^2 dk of both stresses, to the density sum_m C_m/tau_m |tau - y_m|^2.

#include <Eigen/Core>
#include <vector>

#include "core/interior/interior_waves.hpp"
#include "core/scene/solution.hpp"
#include "core/surface/layered_medium.hpp"

namespace rollres {

struct InteriorLine;
struct VolumeFields;

class AxialField {
 public:
  /// @param medium from the contact away   @param speed V [m/s], negative where material flows backwards
  /// @param flow  speed at which it flows over V > 0   @param fields of a skewed cylinder on a grid
  /// @param waves of the plane
  AxialField(const LayeredMedium& medium, double speed, double flow, const SurfaceFields& fields, InteriorWaves waves);

  /// @param f fields of the plane at the same points, to which those along the axle are added, the density if it is
  /// there
  /// @throws BeyondLimits
  void add_to(VolumeFields& f, const std::vector<double>& x, const std::vector<InteriorLine>& lines) const;

 private:
  /// Of one line of flow.
  struct Line {
    std::size_t layer;
    double flat_depth;          ///< below the layer's face [m]
    double stretch;             ///< R/r
    Eigen::ArrayXcd xy, yz, v;  ///< amplitudes of tau_xy, tau_yz and v by wave
  };
  std::vector<Line> waves_on(const std::vector<InteriorLine>& lines, Eigen::ArrayXd& line_loss) const;
  void add_density(VolumeFields& f, const Eigen::ArrayXd& x, Eigen::Index column, const Line& line) const;

  LayeredMedium medium_, flat_;  // flat_ has the depths of a ring
  double speed_, flow_;
  InteriorWaves waves_;
  Eigen::ArrayXcd traction_;                 // of each wave
  std::vector<Eigen::ArrayXcd> compliance_;  // of each layer, by wave
};

}  // namespace rollres
