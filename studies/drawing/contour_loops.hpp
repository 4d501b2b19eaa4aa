#pragma once

/// Contour lines of a field on a rectangular grid as closed loops, to be drawn and filled: a region between two levels
/// is bounded by loops, and loops of one field never cross.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace rollres {

/// Values at (x[i], y[j]), both rising, x running fastest: values[j * x.size() + i].
struct PlaneField {
  std::vector<double> x, y;
  std::vector<double> values;

  double at(std::size_t column, std::size_t row) const { return values[row * x.size() + column]; }
};

struct ContourLoop {
  double level = 0;
  bool higher_inside = false;                 ///< whether the field just inside is above the level
  double area = 0;                            ///< enclosed [unit of x times unit of y], > 0
  std::vector<std::array<double, 2>> points;  ///< without the first one again at the end
};

/// Loops around the regions in which the field, linear along each edge between neighbouring nodes, reaches a level,
/// largest first: painted in this order, each in the colour of its inside, they leave every band in its own.
/// @param outside  the field beyond the grid; where it is on the level's other side the loop runs along the border
std::vector<ContourLoop> contour_loops(const PlaneField& field, std::span<const double> levels, double outside);

}  // namespace rollres
