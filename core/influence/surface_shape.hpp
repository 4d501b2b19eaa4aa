#pragma once

/// The elastic response of a surface in the form that a kernel needs: a half-space's, known in closed form, and tables
/// of what is left.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/influence/layer_tables.hpp"
#include "core/scene/quantity.hpp"
#include "core/surface/layer_compliance.hpp"

namespace rollres {

/// Lengths over which the response of a surface changes.
struct ResponseScales {
  double length = std::numeric_limits<double>::infinity();  ///< the finest scale [m]
  double extent = std::numeric_limits<double>::infinity();  ///< distance where tables end [m]
  bool rigid_base = false;                                  ///< whether the surface is at rest beyond

  /// Distance beyond which the surface does not move [m]; infinite where the base is a half-space.
  double reach() const { return rigid_base ? extent : std::numeric_limits<double>::infinity(); }
  /// Length over which the response at a distance is smooth [m].
  double grain(double distance) const {
    if (distance >= extent) return std::numeric_limits<double>::infinity();
    return std::min(std::max(length, 0.5 * distance), extent / 30);
  }
};

struct SurfaceShape {
  LayerSymbols deep;  ///< symbols times k as k -> infinity: the half-space under short waves [1, or 1/Pa]
  LayerSymbols base;  ///< as k -> 0: that under long waves; 0 over a rigid base
  double length = std::numeric_limits<double>::infinity();  ///< unit of the tables' distances, the finest scale [m]
  double extent = std::numeric_limits<double>::infinity();  ///< distance where the tables end [m]
  std::shared_ptr<const RadialTable> radial;                ///< of a sphere; none for a half-space
  std::shared_ptr<const LineTable> line;                    ///< of a cylinder

  bool rigid_base() const { return std::isfinite(extent) && base == LayerSymbols{}; }
  ResponseScales scales() const { return {length, extent, rigid_base()}; }

  bool operator==(const SurfaceShape&) const = default;
};

/// Shape of a layer of unit shear modulus on a rigid base, or of a half-space.
SurfaceShape surface_shape(Indenter indenter, const Layer& layer);

}  // namespace rollres
