#pragma once

/// A sketch of a scene, to scale: the body with its coatings, the layers under it, their sizes, the load, the speed and
/// what drives the body, and where the contact sticks and slips.
///
/// The body stands at its approach, and the contact lies between the edges of the solution. Of two surfaces in contact
/// the softer one is drawn dented, beyond the contact by a smooth curve that is not computed; without an answer the
/// body touches the undeformed surface. Of a body on layers thinner than a twelfth of its radius the lower part is
/// shown.

#include "studies/figures/figure.hpp"

namespace rollres {

/// Whether the body's coatings give way more than the layers under it: then these are drawn flat.
bool coating_yields(const RollingScene& scene);

/// Script and data of the sketch. @param solution  of the scene; it may have no answer, and no fields
PictureText scene_sketch(const RollingScene& scene, const RollingSolution& solution, const std::string& title,
                         const ChartFiles& files);

/// What it shows, for those who do not see it.
std::string sketch_in_words(const RollingScene& scene);

}  // namespace rollres
