#pragma once

/// The keys of a study file with their meaning: what its readers accept and what its JSON schema describes.

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "studies/text/strict_json.hpp"

namespace rollres {

struct FileKey {
  std::string_view key, meaning;
};

inline constexpr std::array study_keys{
    FileKey{"$schema", "schema of this file, for editors"},
    FileKey{"study", "name of the study in the database"},
    FileKey{"comment", "a text that the program ignores"},
    FileKey{"scene",
            "name of a scene file, relative to this file, or a scene; what the axes give may be missing in it"},
    FileKey{"set", "inputs that replace those of the scene"},
    FileKey{"axes", "inputs that vary; every combination of their values is one point"},
    FileKey{"sample", "points spread over ranges of inputs; each is combined with every combination of the axes"},
    FileKey{"constraints", "conditions between inputs; points that break one are dropped"},
    FileKey{"compute", "outputs that the study is about, in the order of its tables"},
    FileKey{"fields", "whether the fields of every solution are kept"},
    FileKey{"chart", "the chart of the study"},
    FileKey{"charts", "several charts; the first is drawn unless another is asked for"},
};

inline constexpr std::array interval_keys{
    FileKey{"from", "first value"},
    FileKey{"to", "last value"},
    FileKey{"points", "number of values, both ends included"},
    FileKey{"spacing", "same differences (linear, the default) or same ratios (logarithmic)"},
};

inline constexpr std::array zip_keys{
    FileKey{"zip", "inputs that vary together, each with as many values as the others"},
};

inline constexpr std::array sample_keys{
    FileKey{"method", "how the points are spread"},
    FileKey{"points", "number of points"},
    FileKey{"seed", "the same seed gives the same points; 0, the default, gives the plain sequence of Sobol'"},
    FileKey{"ranges", "inputs that vary, each from one value to another"},
};

inline constexpr std::array range_keys{
    FileKey{"from", "one end"},
    FileKey{"to", "the other end"},
    FileKey{"spacing", "spread evenly (linear, the default) or evenly in the logarithm (logarithmic)"},
};

inline constexpr std::array chart_keys{
    FileKey{"name", "by which rollres chart --chart asks for it"},
    FileKey{"x", "an input that varies, or an output"},
    FileKey{"y", "an output; with map an input that varies"},
    FileKey{"family", "an input that varies; one curve for each of its values"},
    FileKey{"map", "an output: a contour map of it over the inputs x and y, in place of curves"},
};

inline constexpr std::array<std::string_view, 2> spacing_names{"linear", "logarithmic"};

/// Most points of a study, of an axis and of a sample.
inline constexpr int most_points = 1'000'000;

/// Refuses keys of `object` that are not among `known`.
/// @throws std::invalid_argument naming place, key, value and the nearest known key
void refuse_unknown_keys(const Json& object, std::span<const FileKey> known, const std::string& place);

/// The text under a key, one of `names`. @throws std::invalid_argument if it is something else
std::string needed_name(const Json& object, const std::string& key, std::span<const std::string_view> names,
                        const std::string& place, const std::string& rule);

}  // namespace rollres
