#pragma once

/// The tractions of a cylinder's contact as sources of what goes on inside the layers: their Fourier transforms, and
/// the stresses that they make in a half-space, which do not depend on its material.
///
/// Along x, with the depth z > 0: of P, the harmonic function below the surface that is p on it, its conjugate and
/// those of q, F = P + i Pc = (i/pi) int p(s)/(x + i z - s) ds,
///     sigma_x = -(P + z P_z) - 2 Qc - z Q_x,   sigma_z = -(P - z P_z) + z Q_x,   tau_xz = -z P_x + Q + z Q_z
/// fulfil the equations of equilibrium, have the tractions sigma_z = -p, tau_xz = q on the surface, and their sum
/// sigma_x + sigma_z = -2 (P + Qc) is harmonic: Flamant's stresses, integrated (Johnson 1985, section 2.5). tau_xz is
/// counted with z upwards, as in all outputs.
///
/// Of a disc of radius R, Michell's stress functions r^n and r^(n+2) give the same formulas with x = R phi, the depth
/// R ln(R/r) inside P and Q, Z = R (R^2 - r^2)/(2 r^2) for the factor z, and (2 Z/R) (-Qc, Qc, Q) more in (sigma_x,
/// sigma_z, tau_xz).

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "core/scene/solution.hpp"

namespace rollres {

/// Of plane strain [Pa]; z upwards.
struct PlaneStress {
  std::complex<double> x, z, xz;
};

/// A place below the face of a half-space, or of a disc.
struct FaceDepth {
  double decay;          ///< of waves, as e^{-k decay} [m]
  double factor;         ///< of their slopes in the stresses [m]
  double curvature = 0;  ///< of the face [1/m]

  /// @param radius of a disc, infinite of a half-space   @param depth >= 0 [m]
  static FaceDepth of(double radius, double depth);
};

/// One wave e^{ikx} of the tractions of a half-space or disc: its stresses at a depth, for k > 0.
PlaneStress half_space_wave(double wavenumber, const FaceDepth& depth, std::complex<double> pressure,
                            std::complex<double> shear);

/// Half the length of a cylinder's contact [m].
/// @throws std::domain_error if there is none
double half_length_of(const SurfaceFields& fields);

class SurfaceTractions {
 public:
  /// @param fields of a cylinder   @param highest wavenumber of whose transforms the digits matter [1/m]
  SurfaceTractions(const SurfaceFields& fields, double highest);

  /// int f e^{-ikx} dx, f = p and q [N/m]
  struct Transforms {
    std::complex<double> pressure, shear;
  };
  Transforms transforms(double wavenumber) const;
  /// The same from each of some wavenumbers at `count` of them, a step apart, up to the highest.
  std::vector<std::vector<Transforms>> transforms(const std::vector<double>& firsts, double step, int count) const;

  /// Stresses in a half-space or disc [Pa]; on the surface the limit from inside
  PlaneStress stresses(double x, const FaceDepth& depth) const;

  double from() const { return from_; }  ///< where tractions begin [m]
  double to() const { return to_; }      ///< where they end [m]

 private:
  struct Point {
    double x, pressure, shear;  // shear and pressure times the weight of integration
  };
  struct Panel {
    double from, to;
    std::vector<Eigen::Array2d> series;     // of pressure and shear, Chebyshev, in s of x = middle + half sin(pi s/2)
    std::vector<std::vector<Point>> rules;  // each twice as fine as the one before; of uniform tractions none
    std::vector<Point> near;                // points for places beside the panel, about its width away

    bool uniform() const { return series.size() == 1; }
  };
  /// F and its derivative, of p and of q.
  struct Potentials {
    std::complex<double> p, dp, q, dq;
  };
  static Point point_of(const Panel& panel, double s, double weight);
  static void add_points(const Panel& panel, double s0, double s1, int order, std::vector<Point>& points);
  static void add_near(const Panel& panel, std::complex<double> place, double s0, double s1, Potentials& sum);

  /// Fewer points on panels that need but one rule and are met by them as well.
  void thin_out(double highest);

  std::vector<Panel> panels_;
  double from_ = 0, to_ = 0;
};

}  // namespace rollres
