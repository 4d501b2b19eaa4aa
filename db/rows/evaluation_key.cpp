#include <charconv>
#include <optional>
#include <type_traits>

#include "core/surface/scene_rules.hpp"
#include "db/file/digest.hpp"
#include "db/rows/result_store.hpp"

namespace rollres {

namespace {

std::string canonical(double value) { return twelve_digits(value); }
std::string canonical(const std::optional<double>& value) { return value ? canonical(*value) : ""; }
std::string canonical(const std::vector<double>& list) {
  std::string text;
  for (const double value : list) text += (text.empty() ? "" : " ") + canonical(value);
  return text;
}
std::string canonical(const BondedLayers& layers);
std::string canonical(int value) { return std::to_string(value); }
template <class Choice>
requires std::is_enum_v<Choice> std::string canonical(Choice choice) { return std::string(name_of(choice)); }

std::string canonical(const BondedLayers& layers) {
  std::string text;
  for (const BondedLayer& layer : layers) {
    visit_layer_inputs(layer, [&](const Quantity&, const auto& value) { text += canonical(value) + ","; });
    text += ";";
  }
  return text;
}

}  // namespace

std::string evaluation_key(const RollingScene& given, std::string_view solver) {
  RollingScene scene = given;
  scene.method = resolved_method(given);  // the same whether it was named or chosen by itself
  std::vector<std::string> defaults;
  const RollingScene plain;
  visit_inputs(plain, [&](const Quantity&, const auto& value) { defaults.push_back(canonical(value)); });
  std::string text = "solver=" + std::string(solver);
  auto usual = defaults.begin();
  visit_inputs(scene, [&](const Quantity& quantity, const auto& value) {
    const std::string here = canonical(value);
    if (here != *usual++) text += "\n" + std::string(quantity.key) + "=" + here;
  });
  return digest(text);
}

}  // namespace rollres
