#pragma once

/// Stresses inside an elastic half-space in plane strain, in closed form. z is upwards, depth = -z; they do not depend
/// on the elastic constants.

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

}  // namespace rollres
