#include "core/scene/quantity.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

namespace rollres {

namespace {

std::string short_number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// Damerau-Levenshtein distance with adjacent transpositions (optimal string alignment).
int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t rows = a.size() + 1, columns = b.size() + 1;
  std::vector<int> cost(rows * columns);
  auto at = [&](std::size_t i, std::size_t j) -> int& { return cost[i * columns + j]; };
  for (std::size_t i = 0; i < rows; ++i) at(i, 0) = static_cast<int>(i);
  for (std::size_t j = 0; j < columns; ++j) at(0, j) = static_cast<int>(j);
  for (std::size_t i = 1; i < rows; ++i)
    for (std::size_t j = 1; j < columns; ++j) {
      const int change = a[i - 1] == b[j - 1] ? 0 : 1;
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  return at(rows - 1, columns - 1);
}

/// Whether some whole words of a name are the part: "resistance" of "rolling_resistance".
bool is_part_of(std::string_view part, std::string_view name) {
  const std::size_t at = part.empty() ? std::string_view::npos : name.find(part);
  if (at == std::string_view::npos) return false;
  const std::size_t end = at + part.size();
  return (at == 0 || name[at - 1] == '_') && (end == name.size() || name[end] == '_');
}

}  // namespace

bool Range::contains(double value) const {
  if (std::isnan(value)) return false;
  if (std::isinf(value)) return infinity_allowed && value > 0;
  return (lowest_excluded ? value > lowest : value >= lowest) && value <= highest;
}

std::string Range::rule() const {
  const bool below = std::isfinite(lowest), above = std::isfinite(highest);
  std::string text;
  if (below && lowest == highest)
    text = "must be " + short_number(lowest);
  else if (below && above)
    text = "must be " + std::string(lowest_excluded ? "above " : "from ") + short_number(lowest) +
           (lowest_excluded ? " and up to " : " to ") + short_number(highest);
  else if (below)
    text = std::string("must be ") + (lowest_excluded ? "> " : ">= ") + short_number(lowest);
  else if (above)
    text = "must be <= " + short_number(highest);
  else
    text = "must be a finite number";
  if (infinity_allowed) text += " or \"infinite\"";
  return text;
}

std::string Quantity::rule() const {
  const bool between = std::isfinite(range.lowest) && std::isfinite(range.highest);
  return range.rule() + (between && !unit.empty() && unit != "1" ? " " + std::string(unit) : "");
}

std::string_view Body::name() const {
  if (indenter == Indenter::profile) return "profiled roller";
  if (indenter == Indenter::pressure) return "given pressure";
  return of_width ? "cylinder with a width" : name_of(indenter);
}

int find_name(std::span<const std::string_view> names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

bool has_word(std::string_view words, std::string_view word) {
  const auto blank = [&](std::size_t at) { return at >= words.size() || words[at] == ' '; };
  for (std::size_t at = words.find(word); at != std::string_view::npos; at = words.find(word, at + 1))
    if (blank(at - 1) && blank(at + word.size())) return !word.empty();
  return false;
}

std::string nearest_name(std::span<const std::string_view> names, std::string_view misspelt) {
  std::string nearest;
  int smallest = std::max(2, static_cast<int>(misspelt.size()) / 3) + 1;
  for (const std::string_view name : names) {
    const int distance = edit_distance(name, misspelt);
    if (distance < smallest) {
      smallest = distance;
      nearest = name;
    }
  }
  if (!nearest.empty()) return nearest;
  for (const std::string_view name : names)
    if (is_part_of(misspelt, name) && (nearest.empty() || name.size() < nearest.size())) nearest = name;
  return nearest;
}

}  // namespace rollres
