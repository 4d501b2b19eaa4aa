#pragma once

/// Relations that need no reference: a scene, and another made of it whose answer follows from the first one's.
///
/// Scenes are random (stability_scene.hpp), with any method, with load or approach given, with friction or without, and
/// with either kinematics. Each output of the other scene may differ from what the first says by
///   - `exact`, relative to the output's own scale. It is 1e-7 where the same equations are solved: laws are held to
///     1e-9 of the largest pressure, and resultants are differences; or what the relation itself is known to; and by
///     what either says of memories expanded in fixed times;
///   - where the discretisations differ (not `strict`, and not as many nodes of the same spacing), also by 1.5 times
///     the errors that both solutions state: estimates cover 95 %, not all. Stated are those of R_r, of edges, of the
///     area, whose is that of the mean pressure, and of the largest pressure;
///   - and there, of one that does not state the output's error, by 1.5 times those of R_r, with continuous edges by
///     three times the tolerance, on grids by a cell at each edge and what the pressure varies by within it.
/// The scale of a resistance is at least a hundredth of the load's lever, P a/R: far below it is rounding.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/solve/rolling_contact.hpp"
#include "studies/evidence/dice.hpp"
#include "studies/evidence/stability_scene.hpp"

namespace rollres {

/// Factors of the units in which the other scene is written.
struct UnitFactors {
  double length = 1, modulus = 1, time = 1;

  /// Of a quantity with this SI unit; 1 for "K", "1", "J/mol", "byte" and text.
  double of(std::string_view unit) const;
};

/// A scene with all its inputs in other units. @param factors powers of 2, for numbers to stay the same to the last bit
RollingScene in_units(RollingScene scene, const UnitFactors& factors);

/// Two scenes, and how their answers belong together.
struct RelatedScenes {
  RollingScene one;
  std::function<RollingScene(const RollingSolution&)> other;  ///< from the answer to `one`, which converged
  UnitFactors factors = {};  ///< outputs of the other scene over those of the first, by their units
  double width = 1;          ///< of the other over the first one's, of which loads, forces, powers and areas are [1]
  double exact = 1e-7;       ///< relative difference that the relation itself leaves [1]
  double resistance = 0;     ///< relative difference of R_r that is allowed where the above is less [1]
  double sensitivity = 1;    ///< of what is found to what is given, where the other scene is given what the first found
  bool strict = false;       ///< the same equations in the same steps: no allowance for discretisation, one status,
                             ///< unless a limit cut an answer short
  bool mirrored = false;     ///< the other answer is the first one's mirror image along x
  bool turned_back = false;  ///< it is the mirror image across the motion
  std::vector<std::string_view> left_out = {};  ///< outputs of which the relation says nothing
};

/// A relation by its name.
struct Relation {
  std::string_view name;     ///< "cut in two"
  std::string_view meaning;  ///< one line
  /// Nothing where the relation says nothing about the scene, as it was drawn.
  std::optional<RelatedScenes> (*scenes)(Dice& dice, RollingScene scene);
  bool of_spheres = true;  ///< whether it says something about them
};

std::span<const Relation> relations();

/// The two scenes of a relation that a seed, an indenter and a number draw; both keep all rules but what the answer to
/// the first gives to the other.
RelatedScenes related_scenes(const Relation& relation, Indenter indenter, std::uint64_t seed, std::size_t number,
                             Spectra spectra = Spectra::both);

enum class RelationOutcome {
  kept,
  broken,      ///< an output differs by more than it may, or an exception was thrown
  one_sided,   ///< only one of the two has an answer
  unanswered,  ///< neither has one
  crashed      ///< the process ended
};
template <>
struct ChoiceNames<RelationOutcome> {
  static constexpr std::array<std::string_view, 5> names{"kept", "broken", "one_sided", "unanswered", "crashed"};
};

/// How far two answers are from what relates them.
struct RelationFinding {
  RelationOutcome outcome = RelationOutcome::crashed;
  double worst = 0;         ///< largest difference of an output over what it may be [1]
  std::string output = {};  ///< whose it is
  double difference = 0;    ///< relative to the output's scale [1]
  std::string words = {};   ///< "rolling_resistance: 1.2 and 1.3, 0.1 apart where 1e-06 is allowed", or a reason
  std::string one = {}, other = {};  ///< both scenes as scene files, unless kept
};

/// Compares two answers that both converged.
RelationFinding compare(const RelatedScenes& scenes, const RollingSolution& one, const RollingSolution& other);

/// Solves both scenes and compares. Never throws.
RelationFinding try_relation(const RelatedScenes& scenes, const Evaluate& evaluate) noexcept;

}  // namespace rollres
