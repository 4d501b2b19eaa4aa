#pragma once

/// The inside of the layers of a cylinder's contact: interior_summary.hpp in plane strain.

#include <vector>

#include "core/interior/interior_field.hpp"
#include "core/interior/interior_summary.hpp"

namespace rollres {

/// Layers on one side of the contact: those under the body or those on it, where z and the shear are mirrored.
struct LayersInside {
  bool on_body;
  InteriorField field;

  /// Height over the undeformed surface, negative under the body [m].
  double height_of(const InteriorLine& line) const { return (on_body ? 1 : -1) * field.depth_of(line); }
};

/// @param reach up to which |x| fields are wanted [m]
std::vector<LayersInside> layers_inside(const RollingScene& scene, const SurfaceFields& fields, double reach,
                                        InteriorField::Detail detail);

InteriorSummary cylinder_summary(const RollingScene& scene, const SurfaceFields& fields, InteriorField::Detail detail);
std::vector<InteriorSection> cylinder_sections(const RollingScene& scene, const SurfaceFields& fields);

}  // namespace rollres
