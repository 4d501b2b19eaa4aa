#include "studies/text/words.hpp"

#include <algorithm>
#include <optional>

#include "core/scene/scene_input.hpp"

namespace rollres {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::vector<std::string> split_at_commas(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= text.size() && !text.empty();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    words.emplace_back(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return words;
}

std::string shortened(std::string text) {
  constexpr std::size_t longest = 80;
  if (text.size() <= longest) return text;
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // not inside a UTF-8 letter
  return text.substr(0, end) + "...";
}

std::string replaced(std::string_view text, std::initializer_list<std::pair<char, std::string_view>> by) {
  std::string out;
  for (const char letter : text) {
    const auto found = find_if(by, [&](const auto& one) { return one.first == letter; });
    out += found == by.end() ? std::string_view(&letter, 1) : found->second;
  }
  return out;
}

std::string unknown(const std::string& what, std::span<const std::string_view> known, std::string_view name,
                    const std::string& otherwise) {
  const std::string nearest = nearest_name(known, name);
  if (!nearest.empty()) return what + "; did you mean " + nearest + "?";
  return otherwise.empty() ? what : what + "; " + otherwise;
}

std::string unknown(const std::string& what, const std::vector<std::string>& known, std::string_view name,
                    const std::string& otherwise) {
  return unknown(what, std::vector<std::string_view>(known.begin(), known.end()), name, otherwise);
}

std::string shell_word(std::string_view text) { return "'" + replaced(text, {{'\'', "'\\''"}}) + "'"; }

std::string file_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char letter) {
        return letter <= 0x20 || letter == 0x7f ||
               std::string_view("/\\:*?\"<>|").find(static_cast<char>(letter)) != std::string_view::npos;
      },
      '_');
  if (name == "." || name == "..") name = "_";
  constexpr std::size_t longest = 120;  // file systems take 255 bytes, suffix included
  if (name.size() > longest) name.resize(longest);
  return name;
}

std::string in_words(std::string_view key) {
  if (const std::optional<LayerKey> layered = layer_key(key))
    return in_words(layered->input) + " of " + layered->layer_in_words();
  std::string words(key);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string formula_in_words(std::string_view formula) {
  std::string words;
  const auto in_key = [](char letter) { return std::isalnum(static_cast<unsigned char>(letter)) || letter == '_'; };
  for (std::size_t begin = 0, end = 0; begin < formula.size(); begin = end) {
    if (in_key(formula[begin])) {
      // "coating_layers[0].layer_thickness" is one key, the bracket of "4 [MPa]" none.
      for (end = begin; end < formula.size() && in_key(formula[end]);) ++end;
      const std::size_t close = formula.find("].", end);
      if (end < formula.size() && formula[end] == '[' && close != std::string_view::npos)
        for (end = close + 2; end < formula.size() && in_key(formula[end]);) ++end;
      words += in_words(formula.substr(begin, end - begin));
      continue;
    }
    const std::string_view two = formula.substr(begin, 2);
    const bool less = two == "<=", more = two == ">=";
    end = begin + (less || more ? 2 : 1);
    words += less ? "≤" : more ? "≥" : std::string(1, formula[begin]);
  }
  return words;
}

std::string_view symbol_beside_name(const Quantity& quantity) {
  return layer_key(quantity.key) ? quantity.symbol.substr(0, quantity.symbol.find(' ')) : quantity.symbol;
}

}  // namespace rollres
