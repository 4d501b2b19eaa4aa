#include "core/scene/scene_input.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <mutex>
#include <tuple>

namespace rollres {

namespace {

/// A further layer's quantity with the texts that it refers to.
struct KeptQuantity {
  std::string key, symbol;
  Quantity quantity;
};

}  // namespace

std::string LayerKey::layer_in_words() const {
  std::string words = list == "coating_layers" ? "coating" : std::string(list.substr(0, list.rfind('s')));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words + " [" + std::to_string(layer) + "]";
}

std::optional<LayerKey> layer_key(std::string_view key) {
  constexpr std::size_t most_digits = 3;
  const std::size_t open = key.find('['), close = key.find("].");
  if (open == 0 || open == std::string_view::npos || close == std::string_view::npos || close <= open + 1) return {};
  const std::string_view digits = key.substr(open + 1, close - open - 1);
  LayerKey found{key.substr(0, open), 0, key.substr(close + 2)};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), found.layer);
  const bool number = error == std::errc() && end == digits.data() + digits.size() && digits.size() <= most_digits;
  const bool one_way = digits == "0" || digits.front() != '0';
  if (!number || !one_way || found.input.empty()) return {};
  return found;
}

std::string_view own_key(std::string_view key) {
  const std::optional<LayerKey> layered = layer_key(key);
  return layered ? layered->input : key;
}

const Quantity& layer_quantity(std::string_view list, std::size_t layer, const Quantity& own) {
  static std::mutex mutex;
  static std::map<std::tuple<std::string, std::size_t, std::string>, KeptQuantity, std::less<>> kept;
  const std::lock_guard lock(mutex);
  const std::tuple<std::string_view, std::size_t, std::string_view> place{list, layer, own.key};
  if (const auto found = kept.find(place); found != kept.end()) return found->second.quantity;
  KeptQuantity& one = kept[std::tuple<std::string, std::size_t, std::string>(place)];
  const LayerKey parts{list, layer, own.key};
  one.key = std::string(list) + "[" + std::to_string(layer) + "]." + std::string(own.key);
  if (!own.symbol.empty()) one.symbol = std::string(own.symbol) + " of " + parts.layer_in_words();
  one.quantity = own;
  one.quantity.key = one.key;
  one.quantity.symbol = one.symbol;
  return one.quantity;
}

std::string absent_layer(const RollingScene& scene, std::string_view key) {
  std::string why;
  const std::optional<LayerKey> parts = layer_key(key);
  if (!parts || find_name(keys_like(key), key) < 0) return why;
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

bool decides_spectral(std::string_view key) {
  return key == "poisson_ratio" || key == "coating_layers[0].poisson_ratio";
}

}  // namespace rollres
