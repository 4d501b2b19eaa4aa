#include <optional>
#include <type_traits>

#include "core/messages/message_text.hpp"
#include "core/model/scene_rules.hpp"
#include "db/file/digest.hpp"
#include "db/rows/result_store.hpp"

namespace rollres {

namespace {

std::string canonical(double value) { return twelve_digits(value); }
std::string canonical(const std::optional<double>& value) { return value ? canonical(*value) : ""; }
std::string canonical(const std::vector<double>& list) {
  return joined(list, " ", [](double value) { return canonical(value); });
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

/// The inputs of a scene at their defaults, in the order of the list: where they are, and as text.
struct Defaults {
  RollingScene scene;
  std::vector<const void*> places = {};
  std::vector<std::string> texts = {};

  Defaults() {
    visit_inputs(scene, [&](const Quantity&, const auto& value) {
      places.push_back(&value);
      texts.push_back(canonical(value));
    });
  }
  Defaults(const Defaults&) = delete;
};

}  // namespace

std::string evaluation_key(const RollingScene& scene, std::string_view solver) {
  static const Defaults defaults;
  std::string text = "solver=" + std::string(solver);
  std::size_t input = 0;
  const auto add = [&](const Quantity& quantity, const auto& value) {
    const std::size_t at = input++;
    if (value == *static_cast<const std::decay_t<decltype(value)>*>(defaults.places[at])) return;
    if (const std::string here = canonical(value); here != defaults.texts[at])
      text.append("\n").append(quantity.key).append("=").append(here);
  };
  const Method method = resolved_method(scene);  // the same whether it was named or chosen by itself
  visit_inputs(scene, [&](const Quantity& quantity, const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Method>)
      add(quantity, method);
    else
      add(quantity, value);
  });
  return digest(text);
}

}  // namespace rollres
