#include "studies/scene_io/scene_entries.hpp"

#include <cmath>
#include <limits>
#include <optional>
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
    return is_temperature(quantity.key) ? kelvin(text) : si_value(text, unit);
  } catch (const std::invalid_argument& error) {
    std::string rule = error.what();
    if (quantity.grows_with_width() && rule.ends_with(unit_in_words(unit)))
      rule += " for a " + std::string(body.name()) + about_width(text, quantity, body);
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
    if (!quantity.range.contains(values.back())) refuse(single.place, single.key, item, quantity.rule());
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
        return "; " + (entry.table.empty() ? entry.key : entry.table) + " is given, for material \"" +
               std::string(ChoiceNames<MaterialModel>::names[other]) + '"';
  }
  return "";
}

/// "material "zener", the default,": what needs an input.
std::string material_in_words(MaterialModel material, bool given) {
  return "material \"" + std::string(name_of(material)) + (given ? "\"" : "\", the default,");
}

/// " needs it (m)"
std::string missing_number(const Quantity& quantity, Body body) {
  const std::string_view unit = quantity.unit_for(body);
  return " needs it (" + (unit == "1" ? std::string("a number") : std::string(unit)) + ")";
}

void refuse_missing(const std::vector<SceneEntry>& entries, const RollingScene& scene, const std::string& place) {
  for (const InputKind& kind : input_kinds()) {
    const bool needed = kind.needed_by_all() || kind.needed_by(scene.material);
    if (!needed || value_given(entries, kind.quantity.key)) continue;
    const std::string who = kind.needed_by_all()
                                ? "every scene"
                                : material_in_words(scene.material, value_given(entries, "material") != nullptr);
    throw std::invalid_argument(place + ": " + std::string(kind.quantity.key) + " is missing: " + who +
                                missing_number(kind.quantity, body_of(scene)) +
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

/// Refuses moduli of which nothing says whether they are G or E; those beside G0 are G.
/// @param given  whether there is an input of this key   @param layer  in front of the key of a further layer
template <class Given>
void refuse_unsaid_moduli(const Given& given, MaterialModel material, const std::string& layer,
                          const std::string& place) {
  if (given(listed_moduli_key)) return;
  const std::string series = "relaxation_moduli";
  if (given(storage_moduli_key))
    throw std::invalid_argument(place + ": " + layer + unsaid_moduli(std::string(storage_moduli_key)));
  if (given(series) && given("static_young_modulus"))
    throw std::invalid_argument(place + ": " + layer + unsaid_moduli(series + " beside static_young_modulus", ""));
  if (material == MaterialModel::relaxation_curve)
    throw std::invalid_argument(place + ": " + layer + unsaid_moduli(series, "relaxation_modulus"));
}

/// The entry of this key, or the end.
template <class Entries>
auto entry_of(Entries& entries, std::string_view key) {
  return find_if(entries, [&](const SceneEntry& entry) { return entry.key == key; });
}

BondedLayer layer_of_object(const SceneEntry& owner, const Json& object) {
  if (!object.is_object()) refuse(owner.place, owner.key, object, "must be an object with the inputs of a layer");
  BondedLayer layer;
  std::vector<std::string_view> known, given;
  for (const InputKind& kind : layer_kinds()) known.push_back(kind.quantity.key);
  for (const auto& [key, value] : object.items()) {
    if (find_name(ignored_keys, key) >= 0) continue;
    const auto kind = find_if(layer_kinds(), [&](const InputKind& candidate) { return candidate.quantity.key == key; });
    const SceneEntry entry{owner.key + "." + key, value, owner.place};
    if (kind == layer_kinds().end()) refuse(entry.place, entry.key, value, unknown_input(known, key));
    assign_layer_input(layer, kind->quantity.key, input_value(entry, *kind, Indenter::cylinder));
    given.push_back(kind->quantity.key);
  }
  for (const InputKind& kind : layer_kinds())
    if ((kind.needed_by_all() || kind.needed_by(layer.material)) && find_name(given, kind.quantity.key) < 0)
      throw std::invalid_argument(
          owner.place + ": " + owner.key + "." + std::string(kind.quantity.key) + " is missing: " +
          (kind.needed_by_all() ? "every layer"
                                : material_in_words(layer.material, find_name(given, "material") >= 0)) +
          missing_number(kind.quantity, Indenter::cylinder));
  refuse_unsaid_moduli([&](std::string_view key) { return find_name(given, key) >= 0; }, layer.material,
                       owner.key + ".", owner.place);
  return layer;
}

}  // namespace

void refuse_unknown_key(const SceneEntry& entry) {
  if (find_input(entry.key)) return;
  std::vector<std::string_view> known = keys_like(entry.key);
  known.insert(known.end(), ignored_keys.begin(), ignored_keys.end());
  known.insert(known.end(), table_keys.begin(), table_keys.end());
  refuse(entry.place, entry.key, entry.value, unknown_input(known, entry.key));
}

void add_entry(std::vector<SceneEntry>& entries, const SceneEntry& given) {
  SceneEntry held = held_entry(given);
  if (any_of(entries, [&](const SceneEntry& other) { return other.key == held.key; }))
    refuse(given.place, given.key, given.value, given_again(held.key));
  entries.push_back(std::move(held));
}

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
    add_entry(entries, {key, value, place, object.contains(key) ? std::string() : table_key_of(key)});
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
  const double value = std::get<double>(input_value(entry, *kind, Indenter::cylinder));
  return {std::string(kind->held_as), written_input(find_input(kind->held_as)->quantity, value), entry.place};
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
           "; moving nodes on a linear layer are less exact than the linear theory; "
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
  if (!kind.quantity.range.contains(value)) fail(kind.quantity.rule());
  return kind.factor * value;
}

double input_difference(const SceneEntry& entry, const InputKind& kind, Body body) {
  const Quantity& quantity = kind.quantity;
  const bool temperature = is_temperature(quantity.key);
  if (entry.value.is_number()) {
    const auto number = entry.value.get<double>();
    if (const std::string doubt = temperature ? std::string() : doubt_of(quantity, number); !doubt.empty())
      refuse(entry.place, entry.key, entry.value, doubt);
    return kind.factor * number;
  }
  const std::string rule = "the standard deviation must be a number, one with a unit, or a share of the mean (10 %)";
  if (!entry.value.is_string()) refuse(entry.place, entry.key, entry.value, rule);
  const auto text = entry.value.get<std::string>();
  if (temperature && !text.ends_with("K"))
    refuse(entry.place, entry.key, entry.value, "a difference of temperatures needs the unit K");
  return refusing_at(entry.place + ": " + entry.key + " = " + shown(entry.value),
                     [&] { return kind.factor * si_value(text, quantity.unit_for(body)); });
}

RollingScene unchecked_scene_from(const std::vector<SceneEntry>& entries, const std::string& place) {
  RollingScene scene;
  const Body body = body_of(entries);  // first: the units of the others depend on it
  scene.indenter = body.indenter;
  // Nothing is cleared here, so that `check` sees two inputs that exclude each other.
  for (const SceneEntry& entry : entries) assign_input(scene, entry.key, input_value(entry, body));
  refuse_missing(entries, scene, place);
  refuse_unsaid_moduli([&](std::string_view key) { return value_given(entries, key) != nullptr; }, scene.material, "",
                       place);
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
