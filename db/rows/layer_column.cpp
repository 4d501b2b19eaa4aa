#include "db/rows/layer_column.hpp"

#include <map>
#include <mutex>

#include "core/scene/scene_input.hpp"
#include "db/file/digest.hpp"
#include "db/rows/result_store.hpp"

namespace rollres {

namespace {

/// SQL of an input in a list of layers, which leaves out what is at its default.
template <class Value>
std::string expression_of(const LayerKey& key, const Quantity& quantity, const Value& usual) {
  const std::string list(key.list), place = std::to_string(key.layer);
  const std::string given = "json_extract(" + list + ", '$[" + place + "]." + std::string(key.input) + "')";
  const auto or_usual = [&](const std::string& value, const std::string& otherwise) {
    return "CASE WHEN json_array_length(" + list + ") > " + place + " THEN coalesce(" + value + ", " + otherwise +
           ") END";
  };
  if constexpr (std::is_enum_v<Value>) {
    return or_usual(given, "'" + std::string(name_of(usual)) + "'");
  } else if constexpr (std::is_same_v<Value, double>) {
    const std::string number = quantity.range.infinity_allowed
                                   ? "CASE " + given + " WHEN 'infinite' THEN 9e999 ELSE " + given + " END"
                                   : given;
    return "CAST(" + or_usual(number, twelve_digits(usual)) + " AS REAL)";
  } else {
    return given;
  }
}

}  // namespace

const QuantityColumn* layer_column(std::string_view key) {
  static std::mutex mutex;
  static std::map<std::string, QuantityColumn, std::less<>> kept;
  const std::lock_guard lock(mutex);
  if (const auto found = kept.find(key); found != kept.end()) return &found->second;
  const std::optional<LayerKey> parts = layer_key(key);
  if (!parts) return nullptr;
  const BondedLayers usual(parts->layer + 1);
  RollingScene scene;
  scene.lower_layers = scene.coating_layers = usual;
  const QuantityColumn* column = nullptr;
  visit_input(scene, key, [&](const Quantity& quantity, const auto& value) {
    QuantityColumn& one = kept[std::string(key)];
    one = {{std::string(key), column_type(value), expression_of(*parts, quantity, value)}, quantity, true};
    column = &one;
  });
  return column;
}

}  // namespace rollres
