#pragma once

/// The real edge of a sphere's contact, which runs through the cells of the grid, as its pressure tells it
/// (core/newton/README.md, section 8).

#include <vector>

#include "core/numerics/vector.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// The contact as F = h(y)^2 - (x - m(y))^2 > 0, with h^2 and m polynomials in y^2 (N24), or in y where the contact is
/// not its own mirror image.
struct EdgeCurve {
  double unit = 1;                          // of y [m]
  Vector centre = {}, squared_length = {};  // coefficients of m [m] and h^2 [m2]; empty: not known
  bool even = true;                         // in y
  double origin = 0;                        // of y [m]

  bool known() const { return centre.size() > 0; }
};

/// F along x, at one y.
struct CurveRow {
  double centre, squared, centre_slope, squared_slope;  // m [m], h^2 [m2] and their derivatives by y

  CurveRow(const EdgeCurve& curve, double y);
  double level(double x) const { return squared - (x - centre) * (x - centre); }     // F [m2]
  double along(double x) const { return -2 * (x - centre); }                         // dF/dx [m]
  double across(double x) const { return squared_slope - along(x) * centre_slope; }  // dF/dy [m]
  double steepness(double x) const;                                                  // |grad F| [m]
  /// int sqrt(F) dx over what lies in the contact [m2].
  double sum_of_root(double from, double to) const;
};

/// What the pressure of a row says of the ends of its contact [m].
struct RowEnds {
  double y, trailing, leading;
};

/// Of all rows that are long enough to tell. @param pressure on the grid [Pa]
std::vector<RowEnds> ends_of_rows(const SurfaceGrid& grid, const Vector& pressure);

/// From the ends of rows, pressure in [Pa]; not known where too few rows are long enough.
EdgeCurve edge_curve(const SurfaceGrid& grid, const Vector& pressure);

/// The cells whose pressure tells the edge, by their distance inside it, and how far outside the real one it is then
/// found [cells].
struct EdgeRing {
  double from, to, beyond;
};

/// From the pressure of a ring of cells along the edge on a folded grid [Pa], by (N28); not known where they are too
/// few or tell of none.
EdgeCurve edge_around(const SurfaceGrid& half, const Vector& pressure, const EdgeRing& ring);

}  // namespace rollres
