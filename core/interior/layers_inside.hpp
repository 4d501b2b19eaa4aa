#pragma once

/// The layers on one side of a contact, those under the body or those on it, with the field in them.

#include <vector>

#include "core/interior/interior_field.hpp"
#include "core/model/contact_surface.hpp"

namespace rollres {

/// @tparam Field InteriorField or VolumeField
template <class Field>
struct LayersInside {
  bool on_body;
  Field field;

  /// Height over the undeformed surface, negative under the body [m].
  double height_of(const InteriorLine& line) const { return (on_body ? 1 : -1) * field.depth_of(line); }
};

/// The tractions as layers on the body meet them, seen from these with z away from the contact: shear turned round.
inline SurfaceFields mirrored_shear(SurfaceFields fields) {
  const auto turn_round = [](std::vector<double>& shears) {
    for (double& shear : shears) shear = -shear;
  };
  turn_round(fields.shear_x);
  turn_round(fields.shear_y);
  for (TractionPanel& panel : fields.panels) turn_round(panel.shear);
  return fields;
}

/// Those under the body, and those on it if there are any.
/// @param fields of the scene's solution   @param more what the field's constructor takes last
template <class Field, class... More>
std::vector<LayersInside<Field>> layers_inside(const ContactModel& model, const SurfaceFields& fields,
                                               const More&... more) {
  std::vector<LayersInside<Field>> parts;
  parts.push_back({false, Field(foundation_of(model), model.speed, 1, fields, more...)});
  if (!model.coating.empty())
    parts.push_back({true, Field(coating_of(model), model.speed, model.flow, mirrored_shear(fields), more...)});
  return parts;
}

}  // namespace rollres
