#include "studies/scene_io/doubtful_number.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <stdexcept>

#include "core/scene/scene_input.hpp"
#include "core/scene/solution.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

bool temperature(const Quantity& quantity) {
  return is_temperature(quantity.key) || own_key(quantity.key).starts_with("shift_temperatures");
}

/// Moduli of the material; not stresses, nor the moduli of strain sweeps, of which only ratios count.
bool modulus(std::string_view own) {
  constexpr std::array<std::string_view, 5> keys{"static_shear_modulus", "static_young_modulus", "relaxation_moduli",
                                                 "storage_moduli", "loss_moduli"};
  return find_name(keys, own.substr(0, own.find('['))) >= 0;
}

constexpr double stiff = 1e12;  // [Pa]

/// Of what a number is: stresses of answers are limited in MPa, as moduli are given in it.
enum class Use { input, limit };

/// The unit that was meant instead; empty if the number looks like one in SI.
/// @param unit  of the quantity, for the body
std::string_view meant_unit(const Quantity& quantity, std::string_view unit, double value, Use use) {
  constexpr double long_one = 1, soft = 1e3, cold = 150;  // [m], [Pa], [K]
  constexpr double turned = 0.35, of_no_polymer = 1e3;    // [rad], [J/mol]
  if (!std::isfinite(value)) return "";
  if (unit == "m") return value > long_one ? "mm" : "";
  if (temperature(quantity)) return value < cold ? "degC" : "";
  if (unit == "rad") return std::abs(value) > turned ? "deg" : "";
  if (unit == "J/mol") return value > 0 && value < of_no_polymer ? "kJ/mol" : "";
  const std::string_view own = own_key(quantity.key);
  if (!modulus(own) && !(use == Use::limit && unit == "Pa")) return "";
  const bool of_series = modulus(own) && own.find('[') != std::string_view::npos;  // as small as one likes
  return value > stiff || (value > 0 && value < soft && !of_series) ? "MPa" : "";
}

bool looks_like_si(const Quantity& quantity, double value) {
  return meant_unit(quantity, quantity.unit, value, Use::input).empty();
}

std::string with_unit(double value, std::string_view unit) { return shortest(value) + " " + std::string(unit); }

/// "did you mean ...?" Of a modulus that is too large, no other unit makes one.
std::string question(double value, std::string_view meant, const std::string& guess) {
  return value > stiff && meant == "MPa" ? "is above 1 TPa." : "did you mean " + guess + "?";
}

/// @param meant  empty if there is no doubt
std::string doubt_in_quotes(std::string_view meant, std::string_view unit, double value) {
  if (meant.empty()) return "";
  return question(value, meant, '"' + with_unit(value, meant) + '"') + " A number without a unit is in " +
         std::string(unit) + ": write \"" + with_unit(value, unit) + "\" if that is meant";
}

}  // namespace

std::string doubt_of(const Quantity& quantity, double value) {
  return doubt_in_quotes(meant_unit(quantity, quantity.unit, value, Use::input), quantity.unit, value);
}

std::string doubt_of_measured(std::string_view unit, double value) {
  return doubt_of_filter({.key = {}, .symbol = {}, .unit = unit, .meaning = {}}, value);
}

std::string doubt_of_filter(const Quantity& quantity, double value) {
  return doubt_in_quotes(meant_unit(quantity, quantity.unit, value, Use::limit), quantity.unit, value);
}

std::string doubt_of_limit(const Quantity& quantity, std::string_view unit, double value) {
  const std::string_view meant = meant_unit(quantity, unit, value, Use::limit);
  if (meant.empty()) return "";
  const std::string number = shortest(value), in_si = " [" + std::string(unit) + "]";
  constexpr double freezing = 273.15;  // [K]; formulas have no unit with an origin of its own
  const std::string guess = meant == "degC"
                                ? with_unit(value, meant) + ", which is " + short_number(value + freezing, 6) + in_si
                                : number + " [" + std::string(meant) + "]";
  return question(value, meant, guess) + " A number without a unit is in " + std::string(unit) + ": write " + number +
         in_si + " if that is meant";
}

std::size_t telling_place(const Quantity& quantity, const std::vector<double>& values) {
  const auto found = temperature(quantity) ? min_element(values) : max_element(values);
  return static_cast<std::size_t>(found - values.begin());
}

Json written_input(const Quantity& quantity, double value) {
  if (std::isinf(value)) return "infinite";
  if (!std::isfinite(value)) return nullptr;
  return looks_like_si(quantity, value) ? Json(value) : Json(with_unit(value, quantity.unit));
}

Json written_input(const Quantity& quantity, const std::vector<double>& values) {
  if (values.empty() || looks_like_si(quantity, values[telling_place(quantity, values)])) return values;
  Json texts = Json::array();
  for (const double value : values) texts.push_back(with_unit(value, quantity.unit));
  return texts;
}

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
  return contains(texts, token.text);
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
