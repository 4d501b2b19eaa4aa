#include "studies/scene_io/scene_inputs.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include "core/messages/number_list.hpp"
#include "core/scene/scene_input.hpp"
#include "db/rows/layer_list.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

template <class Value>
InputKind kind_of(const Quantity& quantity, const Value& value) {
  InputKind kind{.quantity = quantity};
  if constexpr (std::is_enum_v<Value>) {
    kind.choices = ChoiceNames<Value>::names;
    kind.default_value = std::string(name_of(value));
  } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
    kind.optional = true;
  } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
    kind.list = true;
    kind.default_value = value;
  } else if constexpr (std::is_same_v<Value, BondedLayers>) {
    kind.list = kind.layers = true;
    kind.default_value = value;
  } else {
    kind.whole = std::is_integral_v<Value>;
    kind.default_value = static_cast<double>(value);
  }
  return kind;
}

[[noreturn]] void refuse_value(std::string_view key, const InputValue& value, const std::string& rule) {
  throw std::invalid_argument(std::string(key) + " = " + text_of(value) + ": " + rule);
}

template <class Value>
void assign(Value& target, std::string_view key, const InputValue& value) {
  if constexpr (std::is_enum_v<Value>) {
    const auto* const name = std::get_if<std::string>(&value);
    const int found = name ? find_name(ChoiceNames<Value>::names, *name) : -1;
    if (found < 0) refuse_value(key, value, "unknown name");
    target = static_cast<Value>(found);
  } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
    const auto* const list = std::get_if<Value>(&value);
    if (!list) refuse_value(key, value, "must be a list of numbers");
    target = *list;
  } else if constexpr (std::is_same_v<Value, BondedLayers>) {
    const auto* const layers = std::get_if<Value>(&value);
    if (!layers) refuse_value(key, value, "must be a list of layers");
    target = *layers;
  } else {
    const auto* const number = std::get_if<double>(&value);
    if (!number) refuse_value(key, value, "must be a number");
    if constexpr (std::is_integral_v<Value>) {
      if (std::abs(*number) > std::numeric_limits<Value>::max() || *number != std::floor(*number))
        refuse_value(key, value, "must be a whole number");
      target = static_cast<Value>(*number);
    } else {
      target = *number;
    }
  }
}

const InputKind* find_kind(const std::vector<InputKind>& kinds, std::string_view key) {
  const auto found = find_if(kinds, [&](const InputKind& kind) { return kind.quantity.key == key; });
  return found == kinds.end() ? nullptr : &*found;
}

/// Kept by its key as long as the program runs.
const InputKind& kept_kind(const InputKind& kind) {
  static std::mutex mutex;
  static std::map<std::string, InputKind, std::less<>> kept;
  const std::lock_guard lock(mutex);
  return kept.try_emplace(std::string(kind.quantity.key), kind).first->second;
}

}  // namespace

bool InputKind::needed_by_all() const {
  const auto* const number = std::get_if<double>(&default_value);
  return !optional && number && !quantity.range.contains(*number);
}

bool InputKind::needed_by(MaterialModel material) const {
  return find_name(needed_inputs(material), own_key(quantity.key)) >= 0;
}

std::string InputKind::needed_by() const {
  if (needed_by_all()) return "every scene";
  std::string names;
  for (std::size_t i = 0; i < ChoiceNames<MaterialModel>::names.size(); ++i)
    if (needed_by(static_cast<MaterialModel>(i)))
      names += (names.empty() ? "material " : " or ") + std::string(ChoiceNames<MaterialModel>::names[i]);
  return names;
}

const std::vector<InputKind>& input_kinds() {
  static const std::vector<InputKind> kinds = [] {
    std::vector<InputKind> list;
    const RollingScene defaults;
    visit_inputs(defaults,
                 [&](const Quantity& quantity, const auto& value) { list.push_back(kind_of(quantity, value)); });
    return list;
  }();
  return kinds;
}

const std::vector<InputKind>& written_kinds() {
  static const std::vector<InputKind> kinds = [] {
    std::vector<InputKind> list;
    for (const InputKind& kind : input_kinds()) {
      list.push_back(kind);
      if (kind.quantity.key == "radius")
        list.push_back({.quantity = {"diameter", "2R", "m", "diameter of the body, in place of radius", positive},
                        .optional = true,
                        .held_as = "radius",
                        .factor = 0.5});
    }
    return list;
  }();
  return kinds;
}

const std::vector<InputKind>& layer_kinds() {
  static const std::vector<InputKind> kinds = [] {
    std::vector<InputKind> list;
    const BondedLayer defaults;
    visit_layer_inputs(defaults,
                       [&](const Quantity& quantity, const auto& value) { list.push_back(kind_of(quantity, value)); });
    return list;
  }();
  return kinds;
}

const InputKind* find_input(std::string_view key) {
  const std::optional<LayerKey> layered = layer_key(key);
  if (!layered) return find_kind(written_kinds(), key);
  const InputKind* const list = find_kind(input_kinds(), layered->list);
  const InputKind* const own = find_kind(layer_kinds(), layered->input);
  if (!list || !list->layers || !own) return nullptr;
  InputKind kind = *own;
  kind.quantity = layer_quantity(layered->list, layered->layer, own->quantity);
  return &kept_kind(kind);
}

const InputKind* find_number(std::string_view key) {
  const std::optional<ElementKey> element = element_key(key);
  const InputKind* const list = element ? find_input(element->list) : nullptr;
  if (!list || !list->list || list->layers) return find_input(key);
  return &kept_kind({.quantity = element_quantity(list->quantity, element->place)});
}

std::string held_key(const std::string& key) {
  const InputKind* const kind = find_input(key);
  return kind && !kind->held_as.empty() ? std::string(kind->held_as) : key;
}

void require_held(const std::string& key) {
  const InputKind* const kind = find_input(key);
  if (!kind || kind->held_as.empty()) return;
  const std::string held(kind->held_as);
  throw std::invalid_argument(key + ": is stored as " + held + ", which is " + text_of(InputValue(kind->factor)) +
                              " times it: name " + held);
}

std::vector<std::string_view> replaced_inputs(std::string_view key, const InputValue& value) {
  if (const std::optional<LayerKey> layered = layer_key(key)) {
    if (!find_input(key)) return {};
    std::vector<std::string_view> replaced = replaced_inputs(layered->input, value);
    for (std::string_view& one : replaced)
      one = layer_quantity(layered->list, layered->layer, find_kind(layer_kinds(), one)->quantity).key;
    return replaced;
  }
  if (key == "load") return {"approach"};
  if (key == "approach") return {"load"};
  if (key == "spacing") return {"tolerance"};
  if (key == "tolerance") return {"spacing"};
  if (key == "static_shear_modulus") return {"static_young_modulus"};
  if (key == "static_young_modulus") return {"static_shear_modulus"};
  using Keys = std::vector<std::string_view>;
  if (key == "activation_energy") return {"wlf_c1", "wlf_c2", "vft_b", "vft_temperature", "shift_factors"};
  if (key == "wlf_c1" || key == "wlf_c2") return {"activation_energy", "vft_b", "vft_temperature", "shift_factors"};
  if (key == "vft_b" || key == "vft_temperature") return {"activation_energy", "wlf_c1", "wlf_c2", "shift_factors"};
  if (key == "shift_factors") {
    const auto* const list = std::get_if<std::vector<double>>(&value);
    return list && list->empty() ? Keys{} : Keys{"activation_energy", "wlf_c1", "wlf_c2", "vft_b", "vft_temperature"};
  }
  std::vector<std::string_view> keys;
  if (key == "drive") {
    const auto* const drive = std::get_if<std::string>(&value);
    if (!drive || *drive != name_of(Drive::torque)) keys.push_back("driving_torque");
    if (!drive || *drive != name_of(Drive::rotation)) keys.push_back("rotation_ratio");
  }
  return keys;
}

void assign_input(RollingScene& scene, std::string_view key, const InputValue& value) {
  if (visit_input(scene, key, [&](const Quantity&, auto& target) { assign(target, key, value); })) return;
  const std::string why = absent_layer(scene, key);
  refuse_value(key, value, why.empty() ? "unknown key" : why);
}

void assign_layer_input(BondedLayer& layer, std::string_view key, const InputValue& value) {
  visit_layer_inputs(layer, [&](const Quantity& quantity, auto& target) {
    if (quantity.key == key) assign(target, key, value);
  });
}

void set_input(RollingScene& scene, std::string_view key, const InputValue& value) {
  assign_input(scene, key, value);
  for (const std::string_view replaced : replaced_inputs(key, value))
    visit_input(scene, replaced, [](const Quantity&, auto& target) {
      if constexpr (std::is_same_v<std::decay_t<decltype(target)>, std::optional<double>>) target.reset();
    });
}

std::string text_of(const InputValue& value) {
  if (const auto* const name = std::get_if<std::string>(&value)) return '"' + *name + '"';
  if (const auto* const list = std::get_if<std::vector<double>>(&value)) return text_of_list(*list);
  if (const auto* const layers = std::get_if<BondedLayers>(&value)) return text_of_layers(*layers);
  const double number = std::get<double>(value);
  if (std::isinf(number) && number > 0) return "\"infinite\"";
  return shortest(number);
}

}  // namespace rollres
