#include "db/queries/select.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace rollres {

namespace {

double number_in(const Filter& filter) {
  if (filter.value == "infinite") return std::numeric_limits<double>::infinity();
  const char* begin = filter.value.data();
  const char* end = begin + filter.value.size();
  if (begin != end && *begin == '+') ++begin;
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || std::isnan(value))
    throw std::invalid_argument(filter.column + " = " + filter.value + ": must be a number");
  return value;
}

/// SQL of a condition; appends what it binds.
std::string condition(const Filter& filter, const Column& column, std::vector<Cell>& bound) {
  const std::string& name = column.sql();
  const bool equal = filter.comparison == Comparison::equal, differs = filter.comparison == Comparison::not_equal;
  if (filter.value.empty()) {
    const std::string absent = "(" + name + " IS NULL" + (column.type == "TEXT" ? " OR " + name + " = '')" : ")");
    if (equal) return absent;
    if (differs) return "NOT " + absent;
    throw std::invalid_argument(filter.column + ": needs a value to compare with");
  }
  if (filter.comparison == Comparison::contains) {
    bound.emplace_back(filter.value);
    return "instr(" + name + ", ?) > 0";
  }
  if (column.type == "TEXT") {
    constexpr const char* operators[] = {" = ?", " IS NOT ?", " < ?", " <= ?", " > ?", " >= ?"};
    bound.emplace_back(filter.value);
    return name + operators[static_cast<int>(filter.comparison)];
  }
  const double value = number_in(filter);
  const double slack = std::isinf(value) ? 0.0 : filter.slack * std::abs(value);
  const double low = value - slack, high = value + slack;
  switch (filter.comparison) {
    case Comparison::equal:
    case Comparison::not_equal:
      bound.emplace_back(low);
      bound.emplace_back(high);
      return equal ? name + " BETWEEN ? AND ?" : "(" + name + " IS NULL OR " + name + " NOT BETWEEN ? AND ?)";
    case Comparison::less:
      bound.emplace_back(low);
      return name + " < ?";
    case Comparison::less_or_equal:
      bound.emplace_back(high);
      return name + " <= ?";
    case Comparison::greater:
      bound.emplace_back(high);
      return name + " > ?";
    default:
      bound.emplace_back(low);
      return name + " >= ?";
  }
}

}  // namespace

Filter parse_filter(std::string_view text) {
  const std::size_t begin = text.find_first_of("=!<>~");
  if (begin == std::string_view::npos || begin == 0)
    throw std::invalid_argument(std::string(text) + ": must be a column, one of = != < <= > >= ~ and a value");
  const bool twofold = begin + 1 < text.size() && text[begin + 1] == '=' && text[begin] != '~';
  const std::string_view sign = text.substr(begin, twofold ? 2 : 1);
  constexpr std::pair<std::string_view, Comparison> signs[] = {{"=", Comparison::equal},
                                                               {"==", Comparison::equal},
                                                               {"!=", Comparison::not_equal},
                                                               {"<", Comparison::less},
                                                               {"<=", Comparison::less_or_equal},
                                                               {">", Comparison::greater},
                                                               {">=", Comparison::greater_or_equal},
                                                               {"~", Comparison::contains}};
  const auto known =
      std::find_if(std::begin(signs), std::end(signs), [&](const auto& one) { return one.first == sign; });
  if (known == std::end(signs))
    throw std::invalid_argument(std::string(text) + ": a single ! compares nothing; use !=");
  auto trimmed = [](std::string_view word) {
    while (word.starts_with(' ')) word.remove_prefix(1);
    while (word.ends_with(' ')) word.remove_suffix(1);
    return std::string(word);
  };
  Filter filter{trimmed(text.substr(0, begin)), known->second, trimmed(text.substr(begin + sign.size()))};
  filter.slack = slack_of_written(filter.value);
  return filter;
}

double slack_of_written(std::string_view text) {
  double number = 0;
  const std::size_t sign = text.starts_with('+') || text.starts_with('-') ? 1 : 0;
  const auto [end, error] = std::from_chars(text.data() + sign, text.data() + text.size(), number);
  if (error != std::errc() || !(number > 0) || std::isinf(number)) return 0;
  const std::string_view written(text.data() + sign, static_cast<std::size_t>(end - text.data()) - sign);
  const std::string_view mantissa = written.substr(0, written.find_first_of("eE"));
  const std::size_t first = mantissa.find_first_not_of("0.");
  const auto digits = std::count_if(mantissa.begin() + static_cast<std::ptrdiff_t>(first), mantissa.end(),
                                    [](char letter) { return letter != '.'; });
  constexpr std::ptrdiff_t fewest_shown = 5;
  const double leading = std::pow(10, std::floor(std::log10(number) + 1e-15));
  const double half_unit = 0.5 * leading * std::pow(0.1, static_cast<double>(std::max(digits, fewest_shown) - 1));
  return std::max(half_unit / number, 1e-12);
}

std::string where_clause(const std::vector<Filter>& filters, const Columns& known, std::vector<Cell>& bound) {
  std::string clause;
  for (const Filter& filter : filters)
    clause += (clause.empty() ? " WHERE " : " AND ") + condition(filter, column_named(known, filter.column), bound);
  return clause;
}

}  // namespace rollres
