#include "studies/text/key_words.hpp"

#include <algorithm>
#include <optional>

#include "core/scene/scene_input.hpp"

namespace rollres {

std::string in_words(std::string_view key) {
  if (const std::optional<LayerKey> layered = layer_key(key))
    return in_words(layered->input) + " of " + layered->layer_in_words();
  std::string words(key);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string_view symbol_beside_name(const Quantity& quantity) {
  return layer_key(quantity.key) ? quantity.symbol.substr(0, quantity.symbol.find(' ')) : quantity.symbol;
}

}  // namespace rollres
