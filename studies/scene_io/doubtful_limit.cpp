#include "studies/scene_io/doubtful_limit.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <stdexcept>
#include <vector>

#include "core/scene/solution.hpp"
#include "studies/scene_io/doubtful_number.hpp"
#include "studies/scene_io/scene_inputs.hpp"

namespace rollres {

namespace {

struct FormulaToken {
  enum class Kind { name, number, sign };
  Kind kind;
  std::string text;
  double value = 0;
};

std::vector<FormulaToken> tokens_of(std::string_view text) {
  constexpr const char* in_names = "0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ[].";
  std::vector<FormulaToken> tokens;
  while (!text.empty()) {
    const auto letter = static_cast<unsigned char>(text.front());
    std::size_t size = 1;
    FormulaToken token{FormulaToken::Kind::sign, {}};
    if (std::isalpha(letter) || letter == '_') {
      token.kind = FormulaToken::Kind::name;
      size = std::min(text.find_first_not_of(in_names), text.size());
    } else if (std::isdigit(letter) || letter == '.') {
      const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), token.value);
      if (error == std::errc{}) {
        token.kind = FormulaToken::Kind::number;
        size = static_cast<std::size_t>(stop - text.data());
      }
    } else if (text.size() > 1 && (text[1] == '=' || text[1] == text[0])) {
      size = 2;  // <= >= == != && ||
    }
    token.text = text.substr(0, size);
    text.remove_prefix(size);
    if (!std::isspace(letter)) tokens.push_back(std::move(token));
  }
  return tokens;
}

bool is_one_of(const FormulaToken& token, std::initializer_list<std::string_view> texts) {
  return std::find(texts.begin(), texts.end(), token.text) != texts.end();
}

}  // namespace

std::optional<Quantity> quantity_named(const std::string& name) {
  if (const InputKind* const input = find_number(name)) return input->quantity;
  return output_quantity(name);
}

void refuse_doubtful_limits(std::string_view formula, Body body) {
  const std::vector<FormulaToken> tokens = tokens_of(formula);
  // Beside a sign of arithmetic, or with a unit in brackets, it is a part of something else.
  const auto ends = [&](std::size_t place) {
    return place >= tokens.size() || is_one_of(tokens[place], {"(", ")", ",", "?", ":", "&&", "||"});
  };
  for (std::size_t at = 1; at + 1 < tokens.size(); ++at) {
    if (!is_one_of(tokens[at], {"<", "<=", ">", ">=", "==", "!="})) continue;
    if (!ends(at - 2) || !ends(at + 2)) continue;  // before the first: a place beyond all
    const FormulaToken &left = tokens[at - 1], &right = tokens[at + 1];
    using enum FormulaToken::Kind;
    const bool named_first = left.kind == name && right.kind == number;
    if (!named_first && !(left.kind == number && right.kind == name)) continue;
    const FormulaToken &named = named_first ? left : right, &limit = named_first ? right : left;
    const std::optional<Quantity> quantity = quantity_named(named.text);
    if (!quantity) continue;
    const std::string doubt = doubt_of_limit(*quantity, quantity->unit_for(body), limit.value);
    if (!doubt.empty())
      throw std::invalid_argument(left.text + " " + tokens[at].text + " " + right.text + ": " + doubt);
  }
}

}  // namespace rollres
