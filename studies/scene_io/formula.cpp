#include "studies/scene_io/formula.hpp"

#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <deque>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <type_traits>

#include "core/model/absent_outputs.hpp"
#include "core/scene/scene_input.hpp"
#include "studies/scene_io/dimension.hpp"
#include "studies/scene_io/doubtful_number.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/units.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

template <class Value>
constexpr bool is_number =
    std::is_arithmetic_v<std::decay_t<Value>> || std::is_same_v<std::decay_t<Value>, std::optional<double>>;

double as_number(const std::optional<double>& value) { return value.value_or(RollingSolution::absent); }
double as_number(double value) { return value; }

double number_of(const RollingScene& scene, std::string_view key) {
  double found = RollingSolution::absent;
  visit_input(scene, key, [&](const Quantity&, const auto& value) {
    if constexpr (is_number<decltype(value)>) found = as_number(value);
  });
  return found;
}

/// The number with this key: of the solution where it has one, else of the scene.
double number_of(const RollingScene& scene, const RollingSolution& solution, std::string_view key) {
  const double of_answer = output_number(solution, key);
  return std::isnan(of_answer) ? number_of(scene, key) : of_answer;
}

bool is_number_of_layer(std::string_view key) {
  const InputKind* const input = layer_key(key) ? find_input(key) : nullptr;
  return input && input->choices.empty() && !input->list;
}

/// Whether it is a number of a list of the solution: "bond_shears[1]".
bool is_number_of_answer(std::string_view key) { return element_key(key) && output_quantity(key); }

/// What names consist of: those of further layers' inputs have brackets and a dot.
constexpr const char* name_letters = "0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ[].";

std::string constant_name(std::size_t number) { return "constant_" + std::to_string(number); }

/// The right side as a formula in SI: "2 MPa" becomes 2000000 if the left side is a pressure.
std::string in_si(const std::string& right, const Formula& left, Body body) {
  const std::string unit = unit_of(left, body);
  const bool begins_as_number = !right.empty() && (std::isdigit(static_cast<unsigned char>(right.front())) ||
                                                   right.front() == '.' || right.front() == '-');
  if (unit.empty() || unit == "1" || !begins_as_number || plain_number(right)) return right;
  try {
    return text_of(InputValue(unit == "K" && is_temperature(left.text()) ? kelvin(right) : si_value(right, unit)));
  } catch (const std::invalid_argument& error) {
    const std::size_t unit_place = right.find_first_not_of("+-.0123456789eE ");
    const bool number_and_word = unit_place != std::string::npos &&
                                 std::string_view("*/^()<>?:,[").find(right[unit_place]) == std::string_view::npos;
    if (number_and_word) throw std::invalid_argument(right + ": " + error.what() + " for " + left.text());
    return right;  // a formula that begins with a number
  }
}

/// Refuses a number alone, beside a formula of some unit, that looks as if it were in mm, MPa or degC.
void refuse_doubtful_side(const Formula& formula, std::string_view other, Body body) {
  const std::optional<double> limit = plain_number(std::string(trimmed(other)));
  if (!limit || formula.keys().empty()) return;
  const std::string unit = unit_of(formula, body);
  const Quantity nameless{formula.text(), "", unit, ""};
  if (const std::string doubt = doubt_of_limit(quantity_named(formula.text()).value_or(nameless), unit, *limit);
      !doubt.empty())
    throw std::invalid_argument(formula.text() + ": limit " + std::string(trimmed(other)) + ": " + doubt);
}

/// A name as what the scene holds for it: "(radius / 0.5)" for diameter.
std::string held_formula(const std::string& name) {
  const InputKind* const kind = layer_key(name) ? nullptr : find_input(name);
  if (!kind || kind->held_as.empty()) return name;
  return "(" + std::string(kind->held_as) + " / " + text_of(InputValue(kind->factor)) + ")";
}

/// muParser would read "load = 3" as an order, and a text up to its first NUL.
void refuse_assignment(const std::string& text) {
  if (text.find('\0') != std::string::npos) throw std::invalid_argument("a formula must have no NUL character");
  constexpr std::string_view comparing = "=<>!";
  for (std::size_t at = text.find('='); at != std::string::npos; at = text.find('=', at + 1))
    if ((at == 0 || comparing.find(text[at - 1]) == std::string_view::npos) && text.substr(at + 1, 1) != "=")
      throw std::invalid_argument(shortened(text) + ": = assigns nothing in a formula; == compares");
}

/// The place of the one comparison in a condition.
std::size_t sign_in(const std::string& text) {
  const std::size_t sign = text.find_first_of("<>");
  if (sign == std::string::npos || text.find_first_of("<>", sign + 1) != std::string::npos ||
      text.find_first_of("=!") < sign || sign == 0 || text.find_first_not_of(" =", sign + 1) == std::string::npos)
    throw std::invalid_argument((text.empty() ? "\"\"" : shortened(text)) +
                                ": must be two formulas with one of <= < >= > between them");
  return sign;
}

}  // namespace

std::string unit_of(const Formula& formula, Body body) {
  if (formula.keys().size() != 1 || formula.keys().front() != formula.text())
    return unit_of_value(formula, body).value_or("");
  std::string_view unit;
  if (const InputKind* const input = find_input(formula.text())) unit = input->quantity.unit_for(body);
  if (const std::optional<Quantity> output = output_quantity(formula.text())) unit = output->unit_for(body);
  return std::string(unit);
}

std::string with_definitions(std::string_view text, const FormulaDefinitions& definitions) {
  std::string complete;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t name = text.find_first_of(name_letters, begin);
    complete += text.substr(begin, name - begin);
    if (name == std::string_view::npos) break;
    const std::size_t end = std::min(text.find_first_not_of(name_letters, name), text.size());
    const std::string_view word = text.substr(name, end - name);
    const auto found = find_if(definitions, [&](const auto& one) { return one.first == word; });
    complete += found == definitions.end() ? held_formula(std::string(word)) : "(" + found->second + ")";
    begin = end;
  }
  return complete;
}

std::vector<std::string_view> number_keys(FormulaNames names) {
  std::vector<std::string_view> keys;
  auto add = [&](const Quantity& quantity, const auto& value) {
    if constexpr (is_number<decltype(value)>)
      if (find_name(keys, quantity.key) < 0) keys.push_back(quantity.key);
  };
  const RollingScene scene;
  const RollingSolution solution;
  visit_inputs(scene, add);
  if (names == FormulaNames::inputs_and_outputs) visit_outputs(solution, add);
  return keys;
}

bool is_function(const std::string& name) { return name == "pi" || mu::Parser().GetFunDef().contains(name); }

struct Formula::Parts {
  std::string text;
  std::vector<std::string_view> known;
  std::vector<std::string> keys;
  std::deque<double> values;  // of the keys; muParser holds pointers to them
  std::vector<FormulaConstant> constants;
  std::deque<double> constant_values;
  mu::Parser parser;
  std::mutex mutex;

  static double* place_for(const char* name, void* self) {
    auto& parts = *static_cast<Parts*>(self);
    for (std::size_t i = 0; i < parts.constants.size(); ++i)
      if (name == constant_name(i)) return &parts.constant_values[i];
    const bool of_answer = is_number_of_answer(name), answered = find_name(parts.known, "rolling_resistance") >= 0;
    const bool known = find_name(parts.known, name) >= 0 || is_number_of_layer(name) || (of_answer && answered);
    if (!known && (of_answer || find_name(number_keys(FormulaNames::inputs_and_outputs), name) >= 0))
      throw std::invalid_argument(shortened(parts.text) + ": " + name +
                                  " is an output; here only inputs are known, before a scene is solved");
    if (!known) {
      std::vector<std::string_view> all = parts.known;
      for (const std::string_view key : keys_like(name))
        if (is_number_of_layer(key)) all.push_back(key);
      throw std::invalid_argument(
          unknown(shortened(parts.text) + ": " + name + ": unknown key", all, name, "see rollres quantities"));
    }
    parts.keys.emplace_back(name);
    parts.values.push_back(1);
    return &parts.values.back();
  }

  /// The text with a name in place of each number with a unit.
  std::string with_constants_named(std::string_view all) {
    std::string named;
    for (std::size_t begin = 0; begin < all.size();) {
      const auto letter = static_cast<unsigned char>(all[begin]);
      const std::size_t end = std::isalpha(letter) || letter == '_'
                                  ? std::min(all.find_first_not_of(name_letters, begin), all.size())
                                  : begin + 1;
      double number = 0;
      const auto [stop, error] = std::from_chars(all.data() + begin, all.data() + all.size(), number);
      const auto after = static_cast<std::size_t>(stop - all.data());
      const std::size_t bracket = std::min(all.find_first_not_of(' ', after), all.size());
      if (!(std::isdigit(letter) || letter == '.') || error != std::errc{}) {
        named += all.substr(begin, end - begin);
        begin = end;
      } else if (bracket == all.size() || all[bracket] != '[') {
        named += all.substr(begin, after - begin);
        begin = after;
      } else {
        const std::size_t close = all.find(']', bracket);
        if (close == std::string_view::npos) throw std::invalid_argument(text + ": a [ has no ]");
        const UnitInSi unit = refusing_at(
            text, [&] { return unit_in_si(std::string(trimmed(all.substr(bracket + 1, close - bracket - 1)))); });
        named += constant_name(constants.size());
        constants.push_back({number * unit.size, unit.exponents});
        constant_values.push_back(constants.back().value);
        begin = close + 1;
      }
    }
    return named;
  }

  /// The formula's value with those of its keys, and with each constant times its factor.
  template <class NumberOf>
  double value(const NumberOf& number_of_key, std::span<const double> factors = {}) {
    const std::lock_guard lock(mutex);
    for (std::size_t i = 0; i < constants.size(); ++i)
      constant_values[i] = constants[i].value * (factors.empty() ? 1 : factors[i]);
    std::transform(keys.begin(), keys.end(), values.begin(), number_of_key);
    const bool absent = any_of(values, [](double one) { return std::isnan(one); });
    return absent ? RollingSolution::absent : parser.Eval();
  }
};

Formula::Formula(const std::string& text, FormulaNames names, const FormulaDefinitions& definitions)
    : parts_(std::make_shared<Parts>()) {
  parts_->text = trimmed(text);
  parts_->known = number_keys(names);
  refuse_assignment(parts_->text);
  try {
    parts_->parser.DefineNameChars(name_letters);
    parts_->parser.DefineConst("pi", std::numbers::pi);
    parts_->parser.SetVarFactory(&Parts::place_for, parts_.get());
    parts_->parser.SetExpr(parts_->with_constants_named(with_definitions(parts_->text, definitions)));
    parts_->parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    throw std::invalid_argument(shortened(parts_->text) + ": " + shortened(error.GetMsg()));
  }
  int results = 0;
  parts_->parser.Eval(results);
  if (results != 1) throw std::invalid_argument(shortened(parts_->text) + ": must be one formula, without commas");
}

const std::string& Formula::text() const { return parts_->text; }
const std::vector<std::string>& Formula::keys() const { return parts_->keys; }
const std::vector<FormulaConstant>& Formula::constants() const { return parts_->constants; }

double Formula::operator()(const RollingScene& scene, const RollingSolution& solution) const {
  return parts_->value([&](const std::string& key) { return number_of(scene, solution, key); });
}

double Formula::operator()(const RollingScene& scene) const {
  return parts_->value([&](const std::string& key) { return number_of(scene, key); });
}

double Formula::operator()(const std::function<double(const std::string&)>& number_of_key) const {
  return parts_->value(number_of_key);
}

double Formula::operator()(const std::function<double(const std::string&)>& number_of_key,
                           std::span<const double> factors) const {
  return parts_->value(number_of_key, factors);
}

void refuse_different_units(const Formula& formula, Body body) {
  refuse_doubtful_limits(formula.text(), body);
  if (unit_of_value(formula, body)) return;
  throw std::invalid_argument(
      formula.text() + ": its terms have different units; a number without brackets has none: " +
      units_in(formula, body) + "; write the unit of a number in brackets, as in 2 [kN/m2] * approach");
}

void refuse_absent(const Formula& formula, const RollingScene& scene) {
  for (const std::string& key : formula.keys())
    if (const std::string why = why_absent(scene, key); !why.empty())
      throw std::invalid_argument((formula.text() == key ? key : formula.text() + ": " + key) +
                                  " is not computed: " + why);
}

Condition::Condition(const std::string& text, FormulaNames names, Body body, const FormulaDefinitions& definitions)
    : text_(trimmed(text)),
      sign_(sign_in(text_)),
      at_most_(text_[sign_] == '<'),
      strict_(text_.substr(sign_ + 1, 1) != "="),
      left_(text_.substr(0, sign_), names, definitions),
      right_(in_si(std::string(trimmed(std::string_view(text_).substr(sign_ + (strict_ ? 1 : 2)))), left_, body), names,
             definitions) {
  refuse_different_units(left_, body);
  refuse_different_units(right_, body);
  refuse_doubtful_side(left_, std::string_view(text_).substr(sign_ + (strict_ ? 1 : 2)), body);
  refuse_doubtful_side(right_, std::string_view(text_).substr(0, sign_), body);
}

double Condition::excess(const RollingScene& scene, const RollingSolution& solution) const {
  const double difference = left_(scene, solution) - right_(scene, solution);
  return at_most_ ? difference : -difference;
}

bool Condition::holds(const RollingScene& scene, const RollingSolution& solution) const {
  return holds_with(excess(scene, solution));
}

double Condition::excess(const RollingScene& scene) const {
  const double difference = left_(scene) - right_(scene);
  return at_most_ ? difference : -difference;
}

bool Condition::holds(const RollingScene& scene) const { return holds_with(excess(scene)); }

}  // namespace rollres
