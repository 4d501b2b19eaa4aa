#pragma once

/// The kinds of relations, each of which makes another scene of one (relations.hpp): of layers and bodies, of
/// materials, of units and of what is given. Nothing where a relation says nothing about the scene.

#include <optional>
#include <utility>
#include <vector>

#include "studies/relations/relations.hpp"

namespace rollres {

using RelatedPair = std::optional<RelatedScenes>;

/// An other scene that does not depend on the answer to the first.
inline auto known_scene(RollingScene scene) {
  return [scene = std::move(scene)](const RollingSolution&) { return scene; };
}

/// The layers of a scene, each as its inputs of material.
std::vector<MaterialInputs*> layer_materials(RollingScene& scene);

// Of layers and bodies (layer_relations.cpp).
RelatedPair cut_in_two(Dice& dice, RollingScene scene);
RelatedPair cut_in_five(Dice& dice, RollingScene scene);
RelatedPair exchanged(Dice& dice, RollingScene scene);
RelatedPair weightless(Dice& dice, RollingScene scene);
RelatedPair mirrored(Dice& dice, RollingScene scene);
RelatedPair turned_back(Dice& dice, RollingScene scene);
RelatedPair long_period(Dice& dice, RollingScene scene);
RelatedPair closed_ring(Dice& dice, RollingScene scene);
RelatedPair deep_layer(Dice& dice, RollingScene scene);

// Of materials (material_relations.cpp).
RelatedPair term_split(Dice& dice, RollingScene scene);
RelatedPair term_unseen(Dice& dice, RollingScene scene);
RelatedPair other_words(Dice& dice, RollingScene scene);

// Of units and of what is given (unit_relations.cpp).
RelatedPair all_scaled(Dice& dice, RollingScene scene);
RelatedPair speed_scaled(Dice& dice, RollingScene scene);
RelatedPair whole_width(Dice& dice, RollingScene scene);
RelatedPair given_back(Dice& dice, RollingScene scene);

}  // namespace rollres
