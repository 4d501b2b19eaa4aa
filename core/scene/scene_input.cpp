#include "core/scene/scene_input.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <mutex>
#include <utility>

namespace rollres {

namespace {

/// A further layer's quantity with the texts that it refers to.
struct KeptQuantity {
  std::string key, symbol;
  Quantity quantity;
};

/// A place in a list as keys write it: up to three digits, without leading zeros.
std::optional<std::size_t> place_of(std::string_view digits) {
  constexpr std::size_t most_digits = 3;
  std::size_t place = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), place);
  const bool number = error == std::errc() && end == digits.data() + digits.size() && digits.size() <= most_digits;
  const bool one_way = digits == "0" || (!digits.empty() && digits.front() != '0');
  if (!number || !one_way) return {};
  return place;
}

/// `own` under another key and symbol, whose texts are kept by the key.
const Quantity& kept_quantity(const Quantity& own, std::string key, std::string symbol) {
  static std::mutex mutex;
  static std::map<std::string, KeptQuantity, std::less<>> kept;
  const std::lock_guard lock(mutex);
  if (const auto found = kept.find(key); found != kept.end()) return found->second.quantity;
  KeptQuantity& one = kept[key];
  one.key = std::move(key);
  one.symbol = std::move(symbol);
  one.quantity = own;
  one.quantity.key = one.key;
  one.quantity.symbol = one.symbol;
  return one.quantity;
}

}  // namespace

std::string LayerKey::layer_in_words() const {
  std::string words = list == "coating_layers" ? "coating" : std::string(list.substr(0, list.rfind('s')));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words + " [" + std::to_string(layer) + "]";
}

std::optional<LayerKey> layer_key(std::string_view key) {
  const std::size_t open = key.find('['), close = key.find("].");
  if (open == 0 || open == std::string_view::npos || close == std::string_view::npos || close <= open + 1) return {};
  const std::optional<std::size_t> layer = place_of(key.substr(open + 1, close - open - 1));
  const std::string_view input = key.substr(close + 2);
  if (!layer || input.empty()) return {};
  return LayerKey{key.substr(0, open), *layer, input};
}

std::vector<std::string> layer_keys(const RollingScene& scene) {
  std::vector<std::string> keys{"layer"};
  visit_inputs(scene, [&](const Quantity& quantity, const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, BondedLayers>)
      for (std::size_t i = 0; i < value.size(); ++i)
        keys.push_back(std::string(quantity.key) + "[" + std::to_string(i) + "]");
  });
  return keys;
}

MaterialInputs& layer_of(RollingScene& scene, std::string_view name) {
  const std::optional<ElementKey> key = element_key(name);
  if (!key) return scene;
  return (key->list == "coating_layers" ? scene.coating_layers : scene.lower_layers).at(key->place);
}

std::optional<ElementKey> element_key(std::string_view key) {
  const std::size_t open = key.rfind('[');
  if (open == 0 || open == std::string_view::npos || key.back() != ']') return {};
  const std::optional<std::size_t> place = place_of(key.substr(open + 1, key.size() - open - 2));
  if (!place) return {};
  return ElementKey{key.substr(0, open), *place};
}

std::string_view own_key(std::string_view key) {
  const std::optional<LayerKey> layered = layer_key(key);
  return layered ? layered->input : key;
}

const Quantity& layer_quantity(std::string_view list, std::size_t layer, const Quantity& own) {
  const LayerKey parts{list, layer, own.key};
  return kept_quantity(own, std::string(list) + "[" + std::to_string(layer) + "]." + std::string(own.key),
                       own.symbol.empty() ? "" : std::string(own.symbol) + " of " + parts.layer_in_words());
}

const Quantity& element_quantity(const Quantity& list, std::size_t place) {
  const std::string count = "[" + std::to_string(place) + "]";
  return kept_quantity(list, std::string(list.key) + count,
                       list.symbol.empty() ? "" : std::string(list.symbol) + " " + count);
}

std::string absent_layer(const RollingScene& scene, std::string_view key) {
  std::string why;
  if (const std::optional<ElementKey> element = element_key(key))
    visit_input(scene, element->list, [&](const Quantity& list, const auto& value) {
      if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::vector<double>>)
        if (element->place >= value.size())
          why = value.empty() ? "the scene has no " + std::string(list.key)
                              : "the scene has " + std::to_string(value.size()) + " " + std::string(list.key) +
                                    ": [0] to [" + std::to_string(value.size() - 1) + "]";
    });
  const std::optional<LayerKey> parts = layer_key(key);
  if (!why.empty() || !parts || find_name(keys_like(key), key) < 0) return why;
  visit_inputs(scene, [&](const Quantity& quantity, const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, BondedLayers>) {
      if (quantity.key != parts->list || parts->layer < value.size()) return;
      const std::string list(parts->list), last = "[" + std::to_string(value.size() - 1) + "]";
      if (value.empty())
        why = "the scene has no " + list;
      else if (value.size() == 1)
        why = "the scene has one layer in " + list + ": " + list + "[0]";
      else
        why = "the scene has " + std::to_string(value.size()) + " layers in " + list + ": [0] to " + last;
    }
  });
  return why;
}

std::vector<std::string_view> keys_like(std::string_view misspelt) {
  std::vector<std::string_view> keys = input_keys();
  if (misspelt.find('[') == std::string_view::npos) return keys;
  const std::optional<LayerKey> parts = layer_key(misspelt);
  const RollingScene scene;
  const BondedLayer layer;
  visit_inputs(scene, [&](const Quantity& quantity, const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, BondedLayers>)
      visit_layer_inputs(layer, [&](const Quantity& own, const auto&) {
        keys.push_back(layer_quantity(quantity.key, parts ? parts->layer : 0, own).key);
      });
  });
  return keys;
}

}  // namespace rollres
