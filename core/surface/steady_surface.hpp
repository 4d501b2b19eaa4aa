#pragma once

/// Compliance of everything that yields in a contact in steady motion, wavenumber by wavenumber: the layers under the
/// body and those on it.
///
/// Tractions on a coating are opposite to those on the foundation, and so are their normals: compliances add, but for
/// the cross terms, which subtract (Johnson 1985, section 5.1, for two half-spaces). A coating is bonded to
/// the rigid core of the body, flat or a ring (ring_compliance.hpp), and taken to have recovered when it comes round
/// again. One that flows backwards answers with the conjugate of its moduli.

#include <complex>
#include <vector>

#include "core/surface/layered_medium.hpp"
#include "core/surface/ring_curvature.hpp"

namespace rollres {

/// The layers under the body and those on it, from the contact away, as motion at V meets them.
struct SurfaceMedia {
  LayeredMedium foundation, coating;  ///< the latter may be none
  bool backwards = false;             ///< the coating flows against the motion

  bool operator==(const SurfaceMedia&) const = default;
};

class SteadySurface {
 public:
  /// One layer on a rigid base, or a half-space, of one material without inertia. @param speed V [m/s]
  SteadySurface(const Layer& layer, CreepSpectrum material, double speed);
  SteadySurface(SurfaceMedia media, double speed);
  bool operator==(const SteadySurface&) const = default;

  /// Moduli for one wavenumber along the motion.
  struct Moduli {
    std::complex<double> compliance;  ///< 1/G* where the surface is one layer
    std::vector<std::complex<double>> foundation, coating;
  };
  Moduli moduli(double along) const;

  /// For wavenumbers (along, across) [1/m], not both 0 over a half-space [m/Pa].
  SurfaceCompliance operator()(const Moduli& moduli, double along, double across) const;

  /// What short waves along the motion see, times their wavenumber: half-spaces of the materials next to the contact
  /// [1/Pa].
  SurfaceCompliance half_spaces(const Moduli& moduli) const;
  /// And what long waves see: the half-space below, at rest, or nothing over a rigid base [1/Pa].
  SurfaceCompliance long_waves() const;

  /// What a ring's curvature adds to the half-spaces; none of flat layers.
  RingCurvature curvature(RingCurvature::Of of) const;

  double speed() const { return speed_; }  ///< [m/s]
  /// Longest of the lengths over which the surface answers: all thicknesses together, bending of a stiff layer on a
  /// soft one, and the memories [m].
  double longest_wave() const;

 private:
  bool composite_;
  Layer layer_;             // where the surface is one layer,
  CreepSpectrum material_;  // of one material
  SurfaceMedia media_;
  double speed_, thickness_;
};

}  // namespace rollres
