#include "studies/scene_io/scene_overrides.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <stdexcept>

#include "core/scene/scene_input.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/scene_io/usual_names.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// The inputs that an override takes the place of. What was said of other moduli does not hold for the lists of a
/// table.
std::vector<std::string_view> replaced_by(const SceneEntry& entry) {
  const InputValue value = entry.value.is_string() ? InputValue(entry.value.get<std::string>()) : InputValue(0.0);
  std::vector<std::string_view> replaced = replaced_inputs(entry.key, value);
  const std::string_view own = own_key(entry.key);
  if (own == master_curve_inputs[1] || own == relaxation_inputs[1])
    if (const InputKind* const said =
            find_input(entry.key.substr(0, entry.key.size() - own.size()) + std::string(listed_moduli_key)))
      replaced.push_back(said->quantity.key);
  return replaced;
}

/// The object of the layer that an override means.
Json& layer_object(std::vector<SceneEntry>& entries, const SceneEntry& override) {
  const LayerKey parts = layer_key(override.key).value();
  const auto list = find_if(entries, [&](const SceneEntry& entry) { return entry.key == parts.list; });
  RollingScene scene;
  if (list != entries.end()) assign_input(scene, parts.list, BondedLayers(list->value.size()));
  if (const std::string why = absent_layer(scene, override.key); !why.empty())
    refuse(override.place, override.key, override.value, why);
  return list->value[parts.layer];
}

/// Loads and torques as plain numbers, which no unit tells apart, are per metre of a cylinder without a width and of
/// the whole body of one with a width: where that changes they are refused unless they are given anew.
/// @param was  the body before   @param after  the entries with the overrides and without what was taken away
void refuse_numbers_of_other_length(Body was, const std::vector<SceneEntry>& after,
                                    const std::vector<SceneEntry>& overrides, const std::vector<SceneEntry>& taken) {
  const Body is = body_of(after);
  if (was.of_width == is.of_width || was.indenter != is.indenter) return;
  const std::string anew =
      is.of_width ? "per metre: give it too, of the whole body" : "of the whole body: give it too, per metre";
  const std::vector<SceneEntry>& changes = is.of_width ? overrides : taken;
  const SceneEntry& width = *find_if(changes, [](const SceneEntry& entry) { return entry.key == "width"; });
  for (const SceneEntry& entry : after)
    if (entry.value.is_number() && find_input(entry.key)->quantity.grows_with_width() &&
        !value_given(overrides, entry.key))
      refuse(width.place, width.key, width.value,
             entry.key + " = " + shortest(entry.value.get<double>()) + " was given " + anew);
}

/// What the last of the words "KEY=VALUE" gives this key.
std::optional<std::string> value_in(const std::vector<std::string>& words, const std::string& key) {
  std::optional<std::string> value;
  for (const std::string& word : words)
    if (word.starts_with(key + "=")) value = word.substr(key.size() + 1);
  return value;
}

/// Takes an input away that may be absent.
void take_away(std::vector<SceneEntry>& entries, const SceneEntry& taken) {
  const InputKind& kind = *find_input(taken.key);
  if (!kind.optional && !kind.list) input_value(taken, kind, body_of(entries));  // refuses null
  if (layer_key(taken.key))
    layer_object(entries, taken).erase(std::string(own_key(taken.key)));
  else
    std::erase_if(entries, [&](const SceneEntry& entry) { return entry.key == held_key(taken.key); });
}

}  // namespace

std::vector<SceneEntry> replacing_entries(const Json& object, const std::string& place) {
  std::vector<SceneEntry> entries;
  for (const auto& [key, value] : object.items()) {
    if (!find_input(key)) refuse(place, key, value, unknown_input(keys_like(key), key));
    add_entry(entries, {key, value, place});
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
    const std::string own(own_key(entry.key)), prefix = entry.key.substr(0, entry.key.size() - own.size());
    if (find_name(table_keys, own) >= 0) {
      meant.clear();
      Json named = Json::object();
      named[own] = word.substr(equals + 1);
      for (const std::string& key : {std::string(listed_moduli_key), std::string("material")})
        if (const auto said = value_in(words, prefix + key)) named[key] = *said;
      const Json lists = with_master_curve(named, {}, place);
      for (const auto& [key, value] : lists.items())
        if (!named.contains(key)) meant.push_back({prefix + key, value, place});
    }
    for (const SceneEntry& one : meant) {
      refuse_unknown_key(one);
      add_entry(entries, one);
    }
  }
  return entries;
}

std::vector<SceneEntry> overridden(std::vector<SceneEntry> entries, const std::vector<SceneEntry>& overrides,
                                   const std::vector<SceneEntry>& taken) {
  const Body before = body_of(entries);
  for (const SceneEntry& one : taken) take_away(entries, one);
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
  refuse_numbers_of_other_length(before, entries, overrides, taken);
  return entries;
}

Json without_replaced_tables(Json object, const std::vector<std::string>& words) {
  for (const TablePart& part : parts_with_tables(object)) {
    const auto named = [&](std::string_view key) { return part.object->contains(std::string(key)); };
    bool any = false;
    for (const std::string_view key : table_keys)
      if (const auto given = value_in(words, part.prefix + std::string(key)); given && named(key)) {
        any = true;
        part.object->erase(std::string(key));
        if (part.prefix.empty()) continue;
        // A further layer is checked before it is overridden, and needs its lists.
        (*part.object)[std::string(key)] = std::filesystem::absolute(*given).string();
        if (key != master_curve_key) continue;
        part.object->erase(std::string(listed_moduli_key));
        if (const auto said = value_in(words, part.prefix + std::string(listed_moduli_key)))
          (*part.object)[std::string(listed_moduli_key)] = *said;
      }
    if (any && none_of(table_keys, named)) part.object->erase(std::string(ignored_columns_key));
  }
  return object;
}

}  // namespace rollres
