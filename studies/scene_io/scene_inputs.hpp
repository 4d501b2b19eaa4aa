#pragma once

/// The inputs of a scene by key, for readers of files, overrides and axes. A key may be one of a further layer,
/// "coating_layers[0].layer_thickness" (core/scene/scene_input.hpp).

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/scene/scene.hpp"

namespace rollres {

/// An input as a value: a number [SI], the name of a choice, a list of numbers [SI], or further layers.
using InputValue = std::variant<double, std::string, std::vector<double>, BondedLayers>;

/// What an input takes, beside its quantity.
struct InputKind {
  Quantity quantity;
  std::span<const std::string_view> choices = {};  ///< names; empty for a number
  bool whole = false;                              ///< a count
  bool list = false;                               ///< a list, of numbers or of layers; empty if absent
  bool layers = false;                             ///< a list of layers
  bool optional = false;                           ///< may be absent
  InputValue default_value = 0.0;                  ///< of no meaning if `optional` or `list`
  std::string_view held_as = {};                   ///< the input that it is another way to write; empty: none
  double factor = 1;                               ///< of that input over this one

  /// Whether it is one real number, which can vary between two ends.
  bool real() const { return choices.empty() && !whole && !list; }
  /// Whether no scene can do without it: a number whose default its own range refuses.
  bool needed_by_all() const;
  bool needed_by(MaterialModel material) const;
  /// Who cannot do without it, in words: "every scene", "material zener", or nobody.
  std::string needed_by() const;
};

/// All inputs, in the order of the list.
const std::vector<InputKind>& input_kinds();

/// The same and other ways to write them, each after the input that it is held as: diameter after radius.
const std::vector<InputKind>& written_kinds();

/// The inputs of a further layer, by their own keys, in the order of the list.
const std::vector<InputKind>& layer_kinds();

/// The input with this key, or another way to write one, or nullptr. One of a further layer is found whether or not a
/// scene has that layer.
const InputKind* find_input(std::string_view key);

/// The same, or a number of a list, "relaxation_moduli[2]", whether or not a scene has such a number.
const InputKind* find_number(std::string_view key);

/// The key under which a scene holds what is written under this one: radius for diameter.
std::string held_key(const std::string& key);

/// For places where only what scenes hold can be named: axes of charts, filters, derivatives.
/// @throws std::invalid_argument "diameter: is stored as radius, which is 0.5 times it: name radius"
void require_held(const std::string& key);

/// The inputs that giving `key` this value takes the place of: load and approach, spacing and tolerance, and what
/// belongs to another drive.
std::vector<std::string_view> replaced_inputs(std::string_view key, const InputValue& value);

/// Gives an input its value and nothing else. Ranges are left to `check`.
/// @throws std::invalid_argument "key = value: rule" for an unknown key, a layer that the scene has not, an unknown
/// name
///         or a value of another kind
void assign_input(RollingScene& scene, std::string_view key, const InputValue& value);

/// The same, and clears what the input takes the place of.
void set_input(RollingScene& scene, std::string_view key, const InputValue& value);

/// Gives an input of a further layer its value, by its own key.
void assign_layer_input(BondedLayer& layer, std::string_view key, const InputValue& value);

/// A value as text, numbers as short as they can be read back.
std::string text_of(const InputValue& value);

}  // namespace rollres
