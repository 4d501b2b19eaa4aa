#pragma once

/// What short waves make of tractions beyond the incompressible half-space without inertia: unequal slopes across and
/// along, a slope along under pressure there and then, and memories of their own (core/spectral/README.md, section 9).

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/numerics/chebyshev.hpp"
#include "core/surface/layer_slopes.hpp"

namespace rollres {

struct MediumLayer;

/// 2 k c_ww/D, 2 k c_ll/D and k c_x/D of the half-space next to the contact, at s = -1/i of the wavenumbers along the
/// motion, as sums of what they are at once and of retarded parts, (S28) and (S29). All of unit modulus [1].
class DeepResponse {
 public:
  /// @param top the layer next to the contact   @param speed V [m/s]
  /// @param creep_length, creep_compliance of the terms of D, and its instantaneous part, as in SpectralProblem
  /// @param length of the contact, roughly, about which the memories are tabulated [m]
  DeepResponse(const MediumLayer& top, double speed, double instantaneous, const std::vector<double>& creep_length,
               const std::vector<double>& creep_compliance, double length);

  /// The three at a wavenumber along the motion [1/m].
  Eigen::Array3cd at(double wavenumber) const;
  double normal() const { return at_once_(0); }
  double along() const { return at_once_(1); }
  double cross() const { return at_once_(2); }
  Eigen::Array3d at_rest() const { return at_once_ + weights_.rowwise().sum(); }  // long waves: normal, along, cross
  bool remembers() const { return !lengths_.empty(); }

  /// Slopes under unit line forces by the retarded parts alone, as in layer_slopes.hpp, (S30) [1/m].
  LayerSlopes slope(double x) const;
  /// Sum of weights e^(x/T)/T: over 2 pi what goes with ln|x| in them (normal, along), and minus what crosses them from
  /// ahead to behind (cross) [1/m].
  Eigen::Array3d growing(double x) const;
  /// Both at many places, which a processor does side by side: normal, along, cross.
  Eigen::ArrayX3d slopes(const Eigen::ArrayXd& x) const;
  Eigen::ArrayX3d growing(const Eigen::ArrayXd& x) const;
  /// Means R_T of all slopes, those at once with them [1/m].
  LayerSlopes mean(double memory_length, double x) const;
  /// Displacements under unit line forces, -ln|x| times what acts at rest and what memories lack of it, x > 0 [1].
  LayerSlopes displacement(double x) const;

 private:
  LayerSlopes summed(double x) const;
  /// How many powers of the distance stand for the exponentials up to there; 0: none do.
  Eigen::Index powers_at(double farthest) const;

  Eigen::Array3d at_once_;
  std::vector<double> lengths_;                     // T_c of the retarded parts [m]
  Eigen::Array3Xd weights_;                         // and what they weigh
  double shortest_length_ = 0;                      // of them; much below it powers of x stand for the exponentials
  Eigen::Array3Xd moments_;                         // factors of the powers
  Eigen::Array2Xd rests_;                           // and those of what goes without the logarithm, normal and along
  std::shared_ptr<const ChebyshevTable<5>> table_;  // normal and along ahead and behind, cross behind, times |x|
  double shortest_ = 0, longest_ = 0;               // ln |x| of the table's ends
};

}  // namespace rollres
