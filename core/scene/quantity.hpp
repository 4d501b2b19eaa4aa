#pragma once

/// What a quantity is: the one place where its key, symbol, unit, range and meaning stand.
/// The readers of files, the range check, `--set`, the columns of the database, the axes of a sweep and the labels
/// of a chart all walk the same lists, through `visit_inputs` (scene.hpp) and `visit_outputs` (solution.hpp).

#include <algorithm>
#include <array>
#include <compare>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace rollres {

/// Body that rolls: a cylinder (plane strain, solved per metre of its length), a sphere, a crowned roller, or a roller
/// whose profile along the axle is given; or a given pressure in place of a body.
enum class Indenter { cylinder, sphere, roller, profile, pressure };

/// Dimension of its contact problem: 2 (per metre of length, no y) or 3.
constexpr int dimension_of(Indenter body) { return body == Indenter::cylinder ? 2 : 3; }

/// Of what loads, forces, torques, powers and areas of contact are: of a metre of a cylinder, of a cylinder whose width
/// is given, or of a sphere, a roller or a given pressure. Their units depend on it.
struct Body {
  Indenter indenter = Indenter::cylinder;
  bool of_width = false;  ///< a cylinder whose width is given

  constexpr Body(Indenter body, bool width_given = false)
      : indenter(body), of_width(body == Indenter::cylinder && width_given) {}
  constexpr bool per_metre() const { return indenter == Indenter::cylinder && !of_width; }
  /// "cylinder", "cylinder with a width", "sphere", "roller", "profiled roller", "given pressure".
  std::string_view name() const;
  friend constexpr auto operator<=>(const Body&, const Body&) = default;
};

/// Values a number may take; `above` and `below` are excluded, the others included.
struct Range {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  bool lowest_excluded = false;
  bool infinity_allowed = false;  ///< the text "infinite" stands for +infinity

  /// True for a finite number inside (or +infinity where that is allowed); false for NaN.
  bool contains(double value) const;
  /// The rule in words, ready for a message: "must be > 0", "must be from 0 to 0.5".
  std::string rule() const;
};

inline constexpr Range any_number{};
inline constexpr Range positive{.lowest = 0.0, .lowest_excluded = true};
inline constexpr Range not_negative{.lowest = 0.0};

/// One named number, count, choice or text of a scene or of its solution.
struct Quantity {
  std::string_view key;      ///< the name used everywhere: "layer_thickness"
  std::string_view symbol;   ///< "H"; empty if there is none
  std::string_view unit;     ///< SI unit for a whole body: "m", "N"; "1" if dimensionless, "" for text
  std::string_view meaning;  ///< one line
  Range range = any_number;
  std::string_view unit_2d = {};  ///< unit per metre of a cylinder where it differs ("N/m")

  /// Whether it is counted per metre of a cylinder without a width.
  bool grows_with_width() const { return !unit_2d.empty(); }
  /// The rule of its range, with the unit between two ends: "must be from -1.4 to 1.4 rad".
  std::string rule() const;
  /// SI unit for this body.
  std::string_view unit_for(Body body) const { return body.per_metre() && grows_with_width() ? unit_2d : unit; }
};

/// Whether a quantity of this name is a temperature, or a list of them, and no difference of two: a scale with an
/// origin of its own (degC) has a meaning.
inline bool is_temperature(std::string_view key) {
  return key.ends_with("temperature") || key.ends_with("temperatures");
}

/// Names of an enumeration's values in the order of its declaration; specialised beside each enumeration.
template <class Choice>
struct ChoiceNames;

template <>
struct ChoiceNames<Indenter> {
  static constexpr std::array<std::string_view, 5> names{"cylinder", "sphere", "roller", "profile", "pressure"};
};

template <class Choice>
std::string_view name_of(Choice choice) {
  return ChoiceNames<Choice>::names[static_cast<std::size_t>(choice)];
}

/// Position of `name` in `names`, or -1.
int find_name(std::span<const std::string_view> names, std::string_view name);

/// Whether a list has this value in it.
template <class List, class Value>
bool contains(const List& list, const Value& value) {
  return std::find(std::begin(list), std::end(list), value) != std::end(list);
}
/// Of whole lists.
using std::ranges::all_of, std::ranges::any_of, std::ranges::none_of, std::ranges::count_if, std::ranges::find_if;
using std::ranges::max_element, std::ranges::min_element, std::ranges::minmax_element, std::ranges::stable_sort;

/// Whether a word is one of `words`, which have blanks between them.
bool has_word(std::string_view words, std::string_view word);

/// The known name closest to a misspelt one (Damerau-Levenshtein distance); if none is near, the shortest that has it
/// as a part, as "rolling_resistance" has "resistance"; else empty.
std::string nearest_name(std::span<const std::string_view> names, std::string_view misspelt);

}  // namespace rollres
