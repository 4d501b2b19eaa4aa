#pragma once

/// The keys of files with their meaning and what may stand under them: what readers accept and what JSON schemas
/// describe. Here are those of a study.

#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "studies/study/sampling.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// What may stand under a key, as far as it does not depend on other keys.
struct KeyForm {
  enum Kind { own, text, name, number, positive, boolean, whole, one_of } kind = own;  ///< own: told where it is read
  int lowest = 0, highest = 0;                                                         ///< of a whole number
  std::span<const std::string_view> names = {};                                        ///< of one of some names
};
inline constexpr KeyForm a_text{KeyForm::text};          ///< may be empty
inline constexpr KeyForm a_name{KeyForm::name};          ///< a text that is not empty
inline constexpr KeyForm a_number{KeyForm::number};      ///< of some input: a number, or one with a unit
inline constexpr KeyForm a_positive{KeyForm::positive};  ///< a number > 0
inline constexpr KeyForm yes_or_no{KeyForm::boolean};
constexpr KeyForm whole_from(int lowest, int highest) { return {KeyForm::whole, lowest, highest}; }
constexpr KeyForm one_of(std::span<const std::string_view> names) { return {KeyForm::one_of, 0, 0, names}; }

struct FileKey {
  std::string_view key, meaning;
  KeyForm form = {};
  bool needed = false;
};
inline constexpr bool is_needed = true;

inline constexpr std::array<std::string_view, 2> spacing_names{"linear", "logarithmic"};

/// Most points of a study, of an axis and of a sample.
inline constexpr int most_points = 1'000'000;

inline constexpr std::array study_keys{
    FileKey{"$schema", "schema of this file, for editors", a_text},
    FileKey{"study", "name of the study in the database", a_name, is_needed},
    FileKey{"comment", "what the study is about: the title of its charts and reports", a_text},
    FileKey{"scene", "name of a scene file, relative to this file, or a scene; what the axes give may be missing in it",
            KeyForm{}, is_needed},
    FileKey{"set", "inputs that replace those of the scene"},
    FileKey{"axes",
            "inputs that vary, and under variant named sets of them; every combination of their values is one point"},
    FileKey{"sample", "points spread over ranges of inputs; each is combined with every combination of the axes"},
    FileKey{"uncertain", "inputs that scatter: their distributions, correlations and points"},
    FileKey{"constraints", "conditions between inputs; points that break one are dropped"},
    FileKey{"compute", "outputs that the study is about, in the order of its tables, and formulas with a name"},
    FileKey{"fields", "whether the fields of every solution are kept", yes_or_no},
    FileKey{"chart", "the chart of the study"},
    FileKey{"charts", "several charts; the first is drawn unless another is asked for"},
};

inline constexpr std::array interval_keys{
    FileKey{"from", "first value", a_number, is_needed},
    FileKey{"to", "last value", a_number, is_needed},
    FileKey{"points", "number of values, both ends included", whole_from(2, most_points), is_needed},
    FileKey{"spacing", "same differences (linear) or same ratios (logarithmic); default linear", one_of(spacing_names)},
};

inline constexpr std::array zip_keys{
    FileKey{"zip", "inputs that vary together, each with as many values as the others", KeyForm{}, is_needed},
    FileKey{"columns", "numbers that go with them, such as shares of time: name and list", KeyForm{}},
};

inline constexpr std::array sample_keys{
    FileKey{"method", "how the points are spread", one_of(ChoiceNames<SampleMethod>::names), is_needed},
    FileKey{"points", "number of points", whole_from(1, most_points), is_needed},
    FileKey{"seed", "the same seed gives the same points, 0 the plain sequence of Sobol'; default 0"},
    FileKey{"ranges", "inputs that vary, each from one value to another", KeyForm{}, is_needed},
};

inline constexpr std::array range_keys{
    FileKey{"from", "one end", a_number, is_needed},
    FileKey{"to", "the other end", a_number, is_needed},
    FileKey{"spacing", "spread evenly (linear) or evenly in the logarithm (logarithmic); default linear",
            one_of(spacing_names)},
};

inline constexpr std::array chart_keys{
    FileKey{"name", "by which rollres chart --chart asks for it", a_name},
    FileKey{"x", "an input that varies, or an output"},
    FileKey{"y", "an output; with map an input that varies"},
    FileKey{"family", "an input that varies, or variant; one curve for each of its values"},
    FileKey{"map", "an output: a contour map of it over the inputs x and y, in place of curves"},
};

/// Refuses keys of `object` that are not among `known`.
/// @throws std::invalid_argument naming place, key, value and the nearest known key
void refuse_unknown_keys(const Json& object, std::span<const FileKey> known, const std::string& place);

/// The text under a key, one of `names`. @throws std::invalid_argument if it is something else
std::string needed_name(const Json& object, const std::string& key, std::span<const std::string_view> names,
                        const std::string& place, const std::string& rule);

/// The same, or the first of them without the key.
std::string name_or_first(const Json& object, const std::string& key, std::span<const std::string_view> names,
                          const std::string& place);
template <class Choice>
Choice choice_or_first(const Json& object, const std::string& key, const std::string& place) {
  return static_cast<Choice>(
      find_name(ChoiceNames<Choice>::names, name_or_first(object, key, ChoiceNames<Choice>::names, place)));
}

/// Whether true stands under a key. @throws std::invalid_argument unless it is true, false or missing
bool is_true(const Json& object, const std::string& key, const std::string& place);

/// The number under a key, greater than 0 and at most `highest`, or `usual` without it.
double positive_or(const Json& object, const std::string& key, double usual, const std::string& place,
                   double highest = std::numeric_limits<double>::infinity());

/// Refuses what is no text under the keys that are ignored.
void refuse_ignored_other_than_texts(const Json& object, const std::string& place);

}  // namespace rollres
