#include "studies/relations/relations.hpp"

#include <array>
#include <stdexcept>
#include <utility>

#include "core/model/scene_rules.hpp"
#include "studies/relations/relation_kinds.hpp"
#include "studies/relations/scenes_to_relate.hpp"

namespace rollres {

namespace {

RelatedPair tolerances(Dice&, RollingScene scene) {
  if (scene.method == Method::active_set || scene.method == Method::newton_dense) return {};
  if (scene.method == Method::finite_strain) return {};
  const bool sphere = dimension_of(scene.indenter) == 3;
  scene.spacing.reset();
  scene.tolerance = sphere ? 1e-2 : 1e-3;
  RollingScene other = scene;
  other.tolerance = sphere ? 1e-3 : scene.method == Method::automatic ? 1e-6 : 1e-4;
  return RelatedScenes{.one = scene,
                       .other = known_scene(other),
                       .resistance = *scene.tolerance,
                       .left_out = {"peak_shear_x", "peak_shear_y"}};
}

constexpr std::array<Relation, 17> all_relations{{
    {"cut in two", "a layer, or a coating, as two of the same material", cut_in_two},
    {"cut in five", "the same as five", cut_in_five},
    {"term split", "a Prony term as two of half its modulus", term_split},
    {"term unseen", "a Prony term more that the contact cannot see", term_unseen},
    {"other words", "the same material by other inputs", other_words},
    {"scaled", "lengths, moduli and times in other units", all_scaled},
    {"speed and memories", "a speed times a number, all times over it", speed_scaled},
    {"whole width", "loads and torques of a cylinder's whole width for those per metre", whole_width, false},
    {"given back",
     "load given, approach found and given in its place, or the other way round; skew and axial force likewise",
     given_back},
    {"exchanged", "without friction, the body's coating for what lies below", exchanged},
    {"weightless", "inertia of layers that weigh next to nothing for none", weightless},
    {"mirrored", "on elastic layers, sliding forwards for sliding backwards", mirrored, false},
    {"turned back", "skew, camber and pivot to the other side", turned_back},
    {"long period", "bodies far apart for a single one", long_period, false},
    {"closed ring", "a coating that comes round after a turn for bodies a turn apart", closed_ring, false},
    {"deep layer", "a layer of 1,000 half-widths for a half-space", deep_layer},
    {"tolerance", "a tolerance of 1e-3 for 1e-6", tolerances},
}};

}  // namespace

std::span<const Relation> relations() { return all_relations; }

RelatedScenes related_scenes(const Relation& relation, Indenter indenter, std::uint64_t seed, std::size_t number,
                             Spectra spectra) {
  RollingSolution found;  // an answer that gives the other scene something to be checked with
  found.load = found.approach = found.axial_force = found.lateral_force = 1e-4;
  std::uint64_t named = mixed(mixed(seed) + number);
  for (const char letter : relation.name) named = mixed(named + static_cast<unsigned char>(letter));
  constexpr std::uint64_t most_attempts = 10'000;  // a hundred are seldom needed
  for (std::uint64_t attempt = 0; attempt < most_attempts; ++attempt) {
    const std::uint64_t lot = mixed(named + attempt);
    Dice dice(lot);
    const RollingScene scene = scene_to_relate(dice, stability_scene(indenter, lot, number, spectra));
    if (!check(scene).empty()) continue;
    RelatedPair scenes = relation.scenes(dice, scene);
    if (scenes && check(scenes->one).empty() && check(scenes->other(found)).empty()) return std::move(*scenes);
  }
  throw std::logic_error("no random scene fits the relation " + std::string(relation.name));
}

}  // namespace rollres
