#include "studies/scene_io/solution_json.hpp"

#include <cmath>
#include <optional>
#include <type_traits>

#include "db/rows/layer_list.hpp"
#include "studies/scene_io/doubtful_number.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

namespace {

template <class Value>
Json json_of(const Value& value) {
  if constexpr (std::is_enum_v<Value>)
    return std::string(name_of(value));
  else if constexpr (std::is_same_v<Value, std::optional<double>>)
    return value ? Json(*value) : Json();
  else if constexpr (std::is_floating_point_v<Value>)
    return std::isfinite(value) ? Json(value) : Json(nullptr);
  else
    return value;
}

/// An input as a scene file has it.
template <class Value>
Json written(const Quantity& quantity, const Value& value) {
  if constexpr (std::is_same_v<Value, std::optional<double>>)
    return value ? written_input(quantity, *value) : Json();
  else if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::vector<double>>)
    return written_input(quantity, value);
  else
    return json_of(value);
}

/// What differs from a plain layer, and what a layer in a file must have.
Json layers_json(const BondedLayers& layers) {
  Json list = Json::parse(text_of_layers(layers));
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (!layers[i].storage_moduli.empty() || !layers[i].relaxation_moduli.empty())  // what they are must be said
      list[i]["listed_moduli"] = json_of(layers[i].listed_moduli);
    auto kind = layer_kinds().begin();
    visit_layer_inputs(layers[i], [&](const Quantity& quantity, const auto& value) {
      const std::string key(quantity.key);
      const bool needed = kind->needed_by_all() || kind->needed_by(layers[i].material);
      if (const Json own = written(quantity, value); !own.is_null() && (needed || list[i].contains(key)))
        list[i][key] = own;
      ++kind;
    });
  }
  return list;
}

Json inputs_json(const RollingScene& scene) {
  Json object = Json::object();
  visit_inputs(scene, [&](const Quantity& quantity, const auto& value) {
    const std::string key(quantity.key);
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, BondedLayers>) {
      if (!value.empty()) object[key] = layers_json(value);
    } else if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::vector<double>>) {
      if (!value.empty()) object[key] = written(quantity, value);
    } else if (const Json own = written(quantity, value);
               !own.is_null() || std::is_floating_point_v<std::decay_t<decltype(value)>>) {
      object[key] = own;
    }
  });
  return object;
}

Json outputs_json(const RollingSolution& solution) {
  Json object = Json::object();
  visit_outputs(solution, [&](const Quantity& quantity, const auto& value) {
    object[std::string(quantity.key)] = json_of(value);
  });
  return object;
}

std::string text(const Json& object) { return object.dump(2, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string scene_json(const RollingScene& scene) { return text(inputs_json(scene)); }

std::string solution_json(const RollingScene& scene, const RollingSolution& solution) {
  Json object = outputs_json(solution);
  object["scene"] = inputs_json(scene);
  return text(object);
}

std::string solution_line(const RollingSolution& solution, const std::string& id) {
  return "{\"id\":" + id + "," + outputs_json(solution).dump(-1, ' ', false, Json::error_handler_t::replace).substr(1);
}

}  // namespace rollres
