#pragma once

/// A layered medium with inertia under a single sphere: the response of each retardation time as that of an elastic
/// surface (wave_directions.hpp), a half-space's in closed form plus a smooth correction from tables.

#include <memory>
#include <vector>

#include "core/corner_function.hpp"
#include "core/panel_field.hpp"
#include "core/passage_kernel.hpp"
#include "core/wave_directions.hpp"

namespace rollres {

struct MovingShape {
  double time;  ///< [s]; 0: instantaneous
  ResponseScales scales;
  CornerFunction deep, base;                     ///< half-spaces under short and long waves
  std::shared_ptr<const PanelField> correction;  ///< to deep, up to the extent; none for a half-space
  Harmonics tail;                                ///< of what is left to base at the extent, over a half-space

  /// Average over cells of this size [m], per unit force.
  ElasticResponse response(double cell_x, double cell_y) const;
};

/// One for each retardation time.
std::vector<MovingShape> moving_shapes(const LayeredMedium& medium, const WaveDirections& directions);

}  // namespace rollres
