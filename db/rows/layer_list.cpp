#include "db/rows/layer_list.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <type_traits>

namespace rollres {

namespace {

using Json = nlohmann::ordered_json;

template <class Value>
Json json_of(const Value& value) {
  if constexpr (std::is_enum_v<Value>)
    return std::string(name_of(value));
  else if constexpr (std::is_same_v<Value, std::optional<double>>)
    return value ? Json(*value) : Json();
  else if constexpr (std::is_same_v<Value, double>)
    return std::isinf(value) ? Json("infinite") : Json(value);
  else
    return value;
}

template <class Value>
void read(const Json& json, Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    const int found = find_name(ChoiceNames<Value>::names, json.get<std::string>());
    if (found < 0) throw std::invalid_argument(json.dump() + ": unknown name");
    value = static_cast<Value>(found);
  } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
    value = json.get<double>();
  } else if constexpr (std::is_same_v<Value, double>) {
    value = json == "infinite" ? std::numeric_limits<double>::infinity() : json.get<double>();
  } else {
    value = json.get<Value>();
  }
}

}  // namespace

std::string text_of_layers(const BondedLayers& layers) {
  std::vector<Json> defaults;
  const BondedLayer plain;
  visit_layer_inputs(plain, [&](const Quantity&, const auto& value) { defaults.push_back(json_of(value)); });
  Json list = Json::array();
  for (const BondedLayer& layer : layers) {
    Json object = Json::object();
    auto usual = defaults.begin();
    visit_layer_inputs(layer, [&](const Quantity& quantity, const auto& value) {
      const Json here = json_of(value);
      if (here != *usual++) object[std::string(quantity.key)] = here;
    });
    list.push_back(object);
  }
  return list.dump();
}

BondedLayers layers_in(const std::string& text) {
  try {
    BondedLayers layers;
    for (const Json& object : Json::parse(text)) {
      BondedLayer& layer = layers.emplace_back();
      visit_layer_inputs(layer, [&](const Quantity& quantity, auto& value) {
        if (const auto found = object.find(std::string(quantity.key)); found != object.end()) read(*found, value);
      });
    }
    return layers;
  } catch (const Json::exception& error) {
    throw std::invalid_argument(text + ": is no list of layers: " + error.what());
  }
}

}  // namespace rollres
