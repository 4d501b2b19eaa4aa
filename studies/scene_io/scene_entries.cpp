#include "studies/scene_io/scene_entries.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>

#include "core/model/scene_rules.hpp"
#include "core/scene/scene_input.hpp"
#include "studies/scene_io/doubtful_number.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/scene_io/usual_names.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

constexpr std::string_view storage_moduli_key = master_curve_inputs[1];

void refuse_unknown_key(const SceneEntry& entry) {
  if (find_input(entry.key)) return;
  std::vector<std::string_view> known = keys_like(entry.key);
  known.insert(known.end(), ignored_keys.begin(), ignored_keys.end());
  known.insert(known.end(), table_keys.begin(), table_keys.end());
  refuse(entry.place, entry.key, entry.value, unknown_input(known, entry.key));
}

/// The unit in the words of a rule; where the units of cylinder and sphere differ, with the body.
std::string wanted_unit(const Quantity& quantity, Body body) {
  std::string text = unit_in_words(quantity.unit_for(body));
  if (quantity.grows_with_width()) text += " for a " + std::string(body.name());
  return text;
}

bool has_unit(const std::string& text, std::string_view unit) {
  try {
    si_value(text, unit);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

/// What goes with the unit of a text that is per metre, or of the whole body, where the other is wanted; else empty.
std::string about_width(const std::string& text, const Quantity& quantity, Body body) {
  if (body.per_metre() && has_unit(text, quantity.unit)) return "; give its width too for that of the whole body";
  if (body.of_width && has_unit(text, quantity.unit_2d)) return ": leave width out for that of a metre";
  return {};
}

double number(const SceneEntry& entry, const Quantity& quantity, Body body) {
  const std::string_view unit = quantity.unit_for(body);
  auto fail = [&](const std::string& rule) { refuse(entry.place, entry.key, entry.value, rule); };
  if (entry.value.is_number()) return entry.value.get<double>();
  if (!entry.value.is_string())
    fail(unit == "1" ? "must be a number" : "must be a number or a text with " + wanted_unit(quantity, body));
  const auto& text = entry.value.get_ref<const std::string&>();
  if (quantity.range.infinity_allowed && text == "infinite") return std::numeric_limits<double>::infinity();
  if (plain_number(text))
    fail(unit == "1" ? "must be a number without quotes"
                     : "must be a number without quotes, or have " + wanted_unit(quantity, body));
  try {
    const bool temperature = is_temperature(quantity.key) || quantity.key == "shift_temperatures";
    return temperature ? kelvin(text) : si_value(text, unit);
  } catch (const std::invalid_argument& error) {
    std::string rule = error.what();
    if (quantity.grows_with_width()) rule += " for a " + std::string(body.name()) + about_width(text, quantity, body);
    fail(rule);
  }
  return std::nan("");
}

/// A list whose values are as a number of the same quantity is.
std::vector<double> numbers(const SceneEntry& entry, const Quantity& quantity, Body body) {
  if (!entry.value.is_array() || entry.value.empty())
    refuse(entry.place, entry.key, entry.value, "must be a list of numbers: [1, 2]");
  std::vector<double> values;
  for (const Json& item : entry.value) {
    const SceneEntry single{entry.key + "[" + std::to_string(values.size()) + "]", item, entry.place};
    values.push_back(number(single, quantity, body));
    if (!quantity.range.contains(values.back())) refuse(single.place, single.key, item, quantity.range.rule());
  }
  const std::size_t telling = telling_place(quantity, values);
  if (const Json& item = entry.value[telling]; item.is_number())
    if (const std::string doubt = doubt_of(quantity, values[telling]); !doubt.empty())
      refuse(entry.place, entry.key + "[" + std::to_string(telling) + "]", item, doubt);
  return values;
}

/// Which other material an input among the entries is for: "; frequencies is given, for material "master_curve"".
std::string other_material(const std::vector<SceneEntry>& entries, MaterialModel material) {
  for (const SceneEntry& entry : entries) {
    const InputKind* const kind = find_input(entry.key);
    if (!kind || kind->needed_by_all() || kind->needed_by(material)) continue;
    for (std::size_t other = 0; other < ChoiceNames<MaterialModel>::names.size(); ++other)
      if (kind->needed_by(static_cast<MaterialModel>(other)))
        return "; " + entry.key + " is given, for material \"" + std::string(ChoiceNames<MaterialModel>::names[other]) +
               '"';
  }
  return "";
}

void refuse_missing(const std::vector<SceneEntry>& entries, const RollingScene& scene, const std::string& place) {
  for (const InputKind& kind : input_kinds()) {
    const bool needed = kind.needed_by_all() || kind.needed_by(scene.material);
    if (!needed || value_given(entries, kind.quantity.key)) continue;
    const std::string who =
        kind.needed_by_all() ? "every scene" : "material \"" + std::string(name_of(scene.material)) + '"';
    throw std::invalid_argument(place + ": " + std::string(kind.quantity.key) + " is missing: " + who + " needs it (" +
                                std::string(kind.quantity.unit_for(body_of(scene))) + ")" +
                                other_material(entries, scene.material));
  }
}

/// "key given twice", or which keys write the same input.
std::string given_again(const std::string& key) {
  std::string ways;
  for (const InputKind& kind : written_kinds())
    if (kind.held_as == key) ways += " or " + std::string(kind.quantity.key);
  return ways.empty() ? "key given twice" : "give " + key + ways + ", once";
}

/// Adds an entry as it is held. @throws std::invalid_argument if its input is among the entries
void add_held(std::vector<SceneEntry>& entries, const SceneEntry& given) {
  SceneEntry held = held_entry(given);
  if (std::any_of(entries.begin(), entries.end(), [&](const SceneEntry& other) { return other.key == held.key; }))
    refuse(given.place, given.key, given.value, given_again(held.key));
  entries.push_back(std::move(held));
}

/// The inputs that an override takes the place of. What was said of other moduli does not hold for the lists of a
/// table.
std::vector<std::string_view> replaced_by(const SceneEntry& entry) {
  const InputValue value = entry.value.is_string() ? InputValue(entry.value.get<std::string>()) : InputValue(0.0);
  std::vector<std::string_view> replaced = replaced_inputs(entry.key, value);
  const std::string_view own = own_key(entry.key);
  if (own == storage_moduli_key)
    if (const InputKind* const said =
            find_input(entry.key.substr(0, entry.key.size() - own.size()) + std::string(listed_moduli_key)))
      replaced.push_back(said->quantity.key);
  return replaced;
}

/// Refuses moduli of which nothing says whether they are G or E; those beside G0 are G.
/// @param given  whether there is an input of this key   @param layer  in front of the key of a further layer
template <class Given>
void refuse_unsaid_moduli(const Given& given, const std::string& layer, const std::string& place) {
  if (given(listed_moduli_key)) return;
  const std::string series = "relaxation_moduli";
  if (given(storage_moduli_key))
    throw std::invalid_argument(place + ": " + layer + unsaid_moduli(std::string(storage_moduli_key)));
  if (given(series) && given("static_young_modulus"))
    throw std::invalid_argument(place + ": " + layer + unsaid_moduli(series + " beside static_young_modulus", ""));
}

/// The entry of this key, or the end.
template <class Entries>
auto entry_of(Entries& entries, std::string_view key) {
  return std::find_if(entries.begin(), entries.end(), [&](const SceneEntry& entry) { return entry.key == key; });
}

/// A width given to a scene without one makes its loads and torques those of the whole body: plain numbers among them,
/// which no unit tells apart, are refused unless they are given anew.
void refuse_numbers_per_metre(const std::vector<SceneEntry>& entries, const std::vector<SceneEntry>& overrides) {
  const auto width = entry_of(overrides, "width");
  if (width == overrides.end() || entry_of(entries, "width") != entries.end()) return;
  for (const SceneEntry& entry : entries)
    if (entry.value.is_number() && find_input(entry.key)->quantity.grows_with_width() &&
        entry_of(overrides, entry.key) == overrides.end())
      refuse(width->place, width->key, width->value,
             entry.key + " = " + shown(entry.value) + " was given per metre: give it too, of the whole body");
}

/// The object of the layer that an override means.
Json& layer_object(std::vector<SceneEntry>& entries, const SceneEntry& override) {
  const LayerKey parts = layer_key(override.key).value();
  const auto list = entry_of(entries, parts.list);
  RollingScene scene;
  if (list != entries.end()) assign_input(scene, parts.list, layers_of(*list));
  if (const std::string why = absent_layer(scene, override.key); !why.empty())
    refuse(override.place, override.key, override.value, why);
  return list->value[parts.layer];
}

BondedLayer layer_of_object(const SceneEntry& owner, const Json& object) {
  if (!object.is_object()) refuse(owner.place, owner.key, object, "must be an object with the inputs of a layer");
  BondedLayer layer;
  std::vector<std::string_view> known, given;
  for (const InputKind& kind : layer_kinds()) known.push_back(kind.quantity.key);
  for (const auto& [key, value] : object.items()) {
    if (find_name(ignored_keys, key) >= 0) continue;
    const auto kind = std::find_if(layer_kinds().begin(), layer_kinds().end(),
                                   [&](const InputKind& candidate) { return candidate.quantity.key == key; });
    const SceneEntry entry{owner.key + "." + key, value, owner.place};
    if (kind == layer_kinds().end()) refuse(entry.place, entry.key, value, unknown_input(known, key));
    assign_layer_input(layer, kind->quantity.key, input_value(entry, *kind, Indenter::cylinder));
    given.push_back(kind->quantity.key);
  }
  for (const InputKind& kind : layer_kinds())
    if ((kind.needed_by_all() || kind.needed_by(layer.material)) && find_name(given, kind.quantity.key) < 0)
      throw std::invalid_argument(owner.place + ": " + owner.key + "." + std::string(kind.quantity.key) +
                                  " is missing: this layer needs it (" + std::string(kind.quantity.unit) + ")");
  refuse_unsaid_moduli([&](std::string_view key) { return find_name(given, key) >= 0; }, owner.key + ".", owner.place);
  return layer;
}

}  // namespace

Indenter indenter_of(const std::vector<SceneEntry>& entries) {
  RollingScene scene;
  for (const SceneEntry& entry : entries)
    if (entry.key == "indenter") assign_input(scene, entry.key, input_value(entry, scene.indenter));
  return scene.indenter;
}

Body body_of(const std::vector<SceneEntry>& entries) {
  return {indenter_of(entries), value_given(entries, "width") != nullptr};
}

std::vector<SceneEntry> scene_entries(const Json& object, const std::filesystem::path& folder,
                                      const std::string& place) {
  std::vector<SceneEntry> entries;
  const Json complete = with_master_curve(object, folder, place);
  for (const auto& [key, value] : complete.items()) {
    if (find_name(ignored_keys, key) >= 0) {
      if (!value.is_string()) refuse(place, key, value, "must be a text");
      continue;
    }
    refuse_unknown_key({key, value, place});
    add_held(entries, {key, value, place});
    if (const auto layered = layer_key(key))
      refuse(place, key, value, "must stand in the layer's own object, in the list " + std::string(layered->list));
  }
  const Body body = body_of(entries);
  for (const SceneEntry& entry : entries) input_value(entry, body);
  return entries;
}

SceneEntry held_entry(SceneEntry entry) {
  const InputKind* const kind = find_input(entry.key);
  if (!kind || kind->held_as.empty()) return entry;
  return {std::string(kind->held_as), std::get<double>(input_value(entry, *kind, Indenter::cylinder)), entry.place};
}

std::vector<SceneEntry> replacing_entries(const Json& object, const std::string& place) {
  std::vector<SceneEntry> entries;
  for (const auto& [key, value] : object.items()) {
    if (!find_input(key)) refuse(place, key, value, unknown_input(keys_like(key), key));
    add_held(entries, {key, value, place});
  }
  return entries;
}

std::vector<SceneEntry> override_entries(const std::vector<std::string>& words, const std::string& place) {
  std::vector<SceneEntry> entries;
  for (const std::string& word : words) {
    const auto equals = word.find('=');
    if (equals == std::string::npos || equals == 0)
      throw std::invalid_argument(place + ": " + word + ": must be KEY=VALUE");
    SceneEntry entry{word.substr(0, equals), word.substr(equals + 1), place};
    if (word[equals + 1] == '[') {
      entry.value = Json::parse(word.begin() + static_cast<std::ptrdiff_t>(equals) + 1, word.end(), nullptr, false);
      if (!entry.value.is_array()) refuse(place, entry.key, word.substr(equals + 1), "must be a list: [1, 2]");
    } else if (const auto value = plain_number(word.substr(equals + 1))) {
      constexpr double exact = 1e15;  // whole numbers are shown without a decimal point
      if (*value == std::floor(*value) && std::abs(*value) < exact)
        entry.value = static_cast<long long>(*value);
      else
        entry.value = *value;
    }
    std::vector<SceneEntry> meant{entry};
    if (find_name(table_keys, entry.key) >= 0) {
      meant.clear();
      Json named = Json::object();
      named[entry.key] = word.substr(equals + 1);
      const std::string said = std::string(listed_moduli_key) + "=";
      for (const std::string& other : words)
        if (other.starts_with(said)) named[std::string(listed_moduli_key)] = other.substr(said.size());
      const Json lists = with_master_curve(named, {}, place);
      for (const auto& [key, value] : lists.items())
        if (key != listed_moduli_key || !named.contains(key)) meant.push_back({key, value, place});
    } else {
      refuse_unknown_key(entry);
    }
    for (const SceneEntry& one : meant) add_held(entries, one);
  }
  return entries;
}

std::vector<SceneEntry> overridden(std::vector<SceneEntry> entries, const std::vector<SceneEntry>& overrides) {
  refuse_numbers_per_metre(entries, overrides);
  std::vector<SceneEntry> of_layers;
  std::set<std::string, std::less<>> dropped;
  for (const SceneEntry& entry : overrides) {
    if (layer_key(entry.key)) {
      input_value(entry, Indenter::cylinder);  // refuses a wrong one here, where its own place is known
      of_layers.push_back(entry);
      continue;
    }
    dropped.insert(entry.key);
    for (const std::string_view key : replaced_by(entry)) dropped.emplace(key);
  }
  std::erase_if(entries, [&](const SceneEntry& entry) { return dropped.contains(entry.key); });
  std::copy_if(overrides.begin(), overrides.end(), std::back_inserter(entries),
               [](const SceneEntry& entry) { return !layer_key(entry.key); });
  // All are dropped before any is set, so that `check` sees two overrides that exclude each other.
  for (const SceneEntry& entry : of_layers)
    for (const std::string_view key : replaced_by(entry)) layer_object(entries, entry).erase(std::string(own_key(key)));
  for (const SceneEntry& entry : of_layers) layer_object(entries, entry)[std::string(own_key(entry.key))] = entry.value;
  return entries;
}

const Json* value_given(const std::vector<SceneEntry>& entries, std::string_view key) {
  const std::optional<LayerKey> layered = layer_key(key);
  const auto found = entry_of(entries, layered ? layered->list : key);
  if (found == entries.end()) return nullptr;
  if (!layered) return &found->value;
  if (!found->value.is_array() || layered->layer >= found->value.size()) return nullptr;
  const Json& layer = found->value[layered->layer];
  const auto value = layer.find(std::string(layered->input));
  return value == layer.end() ? nullptr : &*value;
}

InputValue input_value(const SceneEntry& entry, Body body) {
  const InputKind* const kind = find_input(entry.key);
  if (!kind) refuse(entry.place, entry.key, entry.value, "unknown key");
  return input_value(entry, *kind, body);
}

InputValue input_value(const SceneEntry& entry, const InputKind& kind, Body body) {
  if (kind.layers) return layers_of(entry);
  auto fail = [&](const std::string& rule) { refuse(entry.place, entry.key, entry.value, rule); };
  if (!kind.choices.empty()) {
    const std::string rule = "must be one of " + joined(kind.choices);
    if (!entry.value.is_string()) fail(rule);
    const auto& name = entry.value.get_ref<const std::string&>();
    if (kind.quantity.key == "kinematics" && name == "deformed")
      fail(rule +
           "; nodes that move with a surface whose layer stays linear are further off than the linear theory: "
           "method = \"finite_strain\" has exact positions and strains");
    if (find_name(kind.choices, name) < 0) fail(unknown(rule, kind.choices, name));
    return name;
  }
  if (kind.list) return numbers(entry, kind.quantity, body);
  const double value = number(entry, kind.quantity, body);
  const bool whole = !kind.whole || (value == std::floor(value) && std::abs(value) <= std::numeric_limits<int>::max());
  if (!whole) fail("must be a whole number");
  if (entry.value.is_number())
    if (const std::string doubt = doubt_of(kind.quantity, value); !doubt.empty()) fail(doubt);
  if (!kind.quantity.range.contains(value)) fail(kind.quantity.range.rule());
  return kind.factor * value;
}

RollingScene unchecked_scene_from(const std::vector<SceneEntry>& entries, const std::string& place) {
  RollingScene scene;
  const Body body = body_of(entries);  // first: the units of the others depend on it
  scene.indenter = body.indenter;
  // Nothing is cleared here, so that `check` sees two inputs that exclude each other.
  for (const SceneEntry& entry : entries) assign_input(scene, entry.key, input_value(entry, body));
  refuse_missing(entries, scene, place);
  refuse_unsaid_moduli([&](std::string_view key) { return value_given(entries, key) != nullptr; }, "", place);
  return scene;
}

RollingScene scene_from(const std::vector<SceneEntry>& entries, const std::string& place) {
  RollingScene scene = unchecked_scene_from(entries, place);
  if (const auto broken = check(scene); !broken.empty()) throw std::invalid_argument(place + ": " + broken.front());
  return scene;
}

BondedLayers layers_of(const SceneEntry& entry) {
  if (!entry.value.is_array() || entry.value.empty())
    refuse(entry.place, entry.key, entry.value, "must be a list of objects, one for each layer");
  BondedLayers layers;
  for (const Json& object : entry.value)
    layers.push_back(layer_of_object({entry.key + "[" + std::to_string(layers.size()) + "]", {}, entry.place}, object));
  return layers;
}

}  // namespace rollres
