#pragma once

/// Stresses inside an elastic half-space, in closed form. z is upwards, depth = -z. In plane strain they do not depend
/// on the elastic constants, otherwise on Poisson's ratio.

namespace rollres {

struct InsideStress {
  double x, z, xz;  ///< sigma_x, sigma_z, tau_xz [Pa]
};

/// Under Hertz's pressure p0 sqrt(1 - x^2/a^2) (McEwen 1949, Phil. Mag. 40, 454; Johnson 1985, eq. 4.49).
/// @param half_width a [m]   @param peak_pressure p0 [Pa]   @param depth > 0 [m]
InsideStress hertz_line_inside(double half_width, double peak_pressure, double x, double depth);

/// The largest shear stress of that field, (sigma_1 - sigma_2)/2, over p0: below the middle, at the depth
/// a sqrt((sqrt 5 - 1)/2) (Johnson 1985, eq. 4.47 maximised): 0.30028.
double hertz_line_largest_shear();
/// That depth over a: 0.78615.
double hertz_line_depth_of_largest_shear();

/// Under a line load: a pressure P [N/m] and a shear Q [N/m] along x, both at x = 0 (Flamant 1892; Johnson 1985, eqs.
/// 2.15 and 2.19).
InsideStress flamant_inside(double pressure, double shear, double x, double depth);

/// In three dimensions [Pa].
struct VolumeStress {
  double x, y, z, yz, xz, xy;
};

/// Under point forces at the origin: P downwards (Boussinesq 1885) and Q along x (Cerruti 1882) [N]; Johnson 1985, eqs.
/// 3.19 and 3.75.   @param depth > 0 [m]
VolumeStress point_forces_inside(double pressure, double shear, double poisson_ratio, double x, double y, double depth);

/// The largest difference of principal stresses under Hertz's pressure p0 sqrt(1 - r^2/a^2), over p0, on the axis
/// (Huber 1904; Johnson 1985, eq. 3.45), and its depth over a.
struct AxisShear {
  double difference, depth;
};
AxisShear hertz_point_largest_shear(double poisson_ratio);

}  // namespace rollres
