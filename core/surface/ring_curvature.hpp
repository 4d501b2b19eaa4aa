#pragma once

/// What the curvature of a ring's face adds to the slope w' that short waves make: that of a disc less that of a
/// half-space (ring_compliance.hpp), which fades like a power of the wavenumber and not exponentially. With n = k R and
/// unit modulus, under pressure and, by the hoop's part, under shear
///     k c_ww: [(1 - nu) - (1 - 2 nu)/2 n]/(n^2 - 1),     k c_hoop: [(1 - nu) n - (1 - 2 nu)/2]/(n^2 - 1)
///
/// The quotient 1/(n^2 - 1) is replaced by a sum of w_j/(n^2 + s_j) that agrees with it to n^-10: what
/// is missing belongs to long waves, and is smooth. With the creep of the ring, sum of C/(1 - i k T), all is a sum of
/// a/(1 - i k T) and -i b/(1 - i k T) over positive and negative lengths T, whose slopes are R_T of a pole and of a
/// unit force (core/spectral/README.md, (S3), (S30)).

#include <array>
#include <complex>
#include <memory>
#include <vector>

#include "core/numerics/chebyshev.hpp"
#include "core/surface/layered_medium.hpp"

namespace rollres {

/// What goes with ln|x| in slopes, as a sum of exponentials of the distance. Those of a ring's radius are a power
/// series; those of memories fade where they would grow far beyond the slopes themselves: what is left there is smooth
/// without them.
class LogarithmicSlope {
 public:
  LogarithmicSlope() = default;
  explicit LogarithmicSlope(double radius) : radius_(radius) {}
  /// @param weight times e^{x/length} [1/(Pa m)]
  void add(double weight, double length);

  /// @param x up to about the radius   @return [1/(Pa m)]
  double operator()(double x) const;
  bool none() const { return radius_ == 0; }

 private:
  struct Memory {
    double weight, length;  // [1/(Pa m)], [m]
  };
  static constexpr std::size_t powers_ = 18;
  double radius_ = 0;
  std::array<double, powers_> series_{};  // of x over the radius
  std::vector<Memory> memories_;
};

class RingCurvature {
 public:
  enum class Of { pressure, shear };

  /// None: 0 everywhere.
  RingCurvature() = default;
  /// @param ring the outer one   @param speed V [m/s], negative where the ring flows backwards
  /// @param coating of the body: its cross terms have the opposite sign
  RingCurvature(const MediumLayer& ring, double speed, Of of, bool coating);

  /// The same over a spectrum whose terms have all the ring's times, as a sum over its relaxation times [1].
  RingCurvature over(const CreepSpectrum& deep) const;
  /// Seen through memories, R_T of it for each of these lengths T [m], not 0.
  std::vector<RingCurvature> remembered(const std::vector<double>& lengths) const;

  /// What it adds to k c_ww or to k c_hoop at a wavenumber along the motion [1/Pa].
  std::complex<double> operator()(double wavenumber) const;
  /// Re 1/pi int i k c_ww e^{i k x} dk or -Re 1/pi int k c_hoop e^{i k x} dk, at 0 without what goes with ln|x|
  /// [1/(Pa m)]
  double slope(double x) const;
  /// Its antiderivative, Re 1/pi int [k c_ww - at_rest() e^{-2 k depth}] e^{i k x}/k dk less
  /// at_rest() ln(x^2 + 4 depth^2)/(2 pi), whatever the depth, or Re 1/pi int i c_hoop e^{i k x} dk [1/Pa]
  double displacement(double x) const;
  /// What goes with ln|x| in the slope. @param finest distance [m]: memories that it does not tell from none are none
  LogarithmicSlope logarithmic_slope(double finest) const;
  /// k c_ww of long waves; 0 of shear [1/Pa].
  double at_rest() const { return at_rest_; }
  bool none() const { return parts_.empty(); }

 private:
  struct Part {
    double length;      // T [m]
    double pole, jump;  // a, b [1/Pa]
  };
  class TabledParts;
  void make_series();
  void tabulate(TabledParts& tabled);
  RingCurvature seen_through(double length) const;
  double sum_of_parts(double x) const;

  MediumLayer ring_{0, 0.5, 0, {}};
  double speed_ = 1;
  Of of_ = Of::pressure;
  bool coating_ = false;
  double even_ = 0, odd_ = 0;              // of (even + odd n)/(n^2 - 1)
  double step_ = 0, at_rest_ = 0;          // of all jumps together, of all poles
  std::vector<double> squares_, weights_;  // s_j, w_j
  std::vector<Part> parts_;
  using Side = ChebyshevTable<1>;  // slopes over ln|x/R|
  std::shared_ptr<const std::array<Side, 2>> sides_;  // ahead and behind, where there are memories
  // Without memory the even part's slope is C (x/R) sum (x/R)^{2i} (logarithms_i ln|x/R| + rests_i).
  std::vector<double> logarithms_, rests_;
};

}  // namespace rollres
