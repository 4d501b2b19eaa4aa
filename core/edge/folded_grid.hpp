#pragma once

/// A whole grid with a row at y = 0 seen as two folded ones, one for each side.

#include <algorithm>

#include "core/numerics/vector.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// Its rows y >= 0, as many as the longer side has.
inline SurfaceGrid folded(const SurfaceGrid& whole) {
  SurfaceGrid half = whole;
  half.first_row = 0;
  half.rows = 1 + std::max(-whole.first_row, whole.first_row + whole.rows - 1);
  half.folded = true;
  return half;
}

/// Values on the side y >= 0 or, with `side` -1, y <= 0 of a whole grid, on the folded one; zero beyond it.
inline Vector side_of(const SurfaceGrid& whole, const Vector& values, int side) {
  const SurfaceGrid half = folded(whole);
  Vector on_side = Vector::Zero(half.size());
  for (int row = 0; row < half.rows; ++row)
    if (const int from = side * row - whole.first_row; from >= 0 && from < whole.rows)
      on_side.segment(half.index(0, row), half.columns) = values.segment(whole.index(0, from), whole.columns);
  return on_side;
}

}  // namespace rollres
