#pragma once

/// Reads what varies in a study: the objects "axes" and "sample" of its file. For sources only: it needs nlohmann_json.

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "studies/scene_io/scene_entries.hpp"
#include "studies/study/study.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// An axis as it was given: a list of values, or two ends and where the values lie between them.
struct GivenAxis {
  std::string key;
  std::string place;
  Json shown;                          ///< as it stands in messages
  std::vector<SceneEntry> values;      ///< of a list; else the two ends
  std::vector<double> positions = {};  ///< from 0 to 1; empty for a list
  bool logarithmic = false;
  std::string group = {};  ///< as in Axis

  bool choice() const { return !find_input(key)->choices.empty(); }
  std::size_t size() const { return positions.empty() ? values.size() : positions.size(); }
};

/// The value at a share of the way from one end to the other, whose own value stands there exactly.
double spaced_value(double from, double to, double share, bool logarithmic);

/// Group of the axes of a sample, and of those of what scatters.
inline constexpr const char* sample_group = "sample";
inline constexpr const char* uncertain_group = "uncertain";

/// What the file varies but for its variants, the sample last but for what scatters.
/// @param place      the file
/// @param variants   how many variants each combination is met with
/// @param uncertain  axes of what scatters
/// @throws std::invalid_argument naming place, key, value and rule; values are read later, by `axes_of`
std::vector<GivenAxis> given_axes(const Json& study, const std::string& place, std::size_t variants = 1,
                                  const std::vector<GivenAxis>& uncertain = {});

/// The neighbours that vary together, as places in `axes`.
template <class AnyAxis>
std::vector<std::vector<std::size_t>> groups_of(const std::vector<AnyAxis>& axes) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (i == 0 || axes[i].group.empty() || axes[i].group != axes[i - 1].group) groups.emplace_back();
    groups.back().push_back(i);
  }
  return groups;
}

/// Calls `visit` with the place of every axis in its list of values, for every combination; the last group varies
/// fastest.
/// @param size_of  how many values a group of axes has, given the places of its axes
template <class AnyAxis, class SizeOf, class Visit>
void for_each_combination(const std::vector<AnyAxis>& axes, SizeOf&& size_of, Visit&& visit) {
  const auto groups = groups_of(axes);
  std::vector<std::size_t> sizes, at(axes.size(), 0);
  for (const auto& group : groups) sizes.push_back(size_of(group));
  if (contains(sizes, 0U)) return;
  while (true) {
    visit(at);
    std::size_t group = groups.size();
    while (group > 0) {
      --group;
      const std::size_t next = at[groups[group].front()] + 1 < sizes[group] ? at[groups[group].front()] + 1 : 0;
      for (const std::size_t axis : groups[group]) at[axis] = next;
      if (next > 0) break;
      if (group == 0) return;
    }
    if (groups.empty()) return;
  }
}

/// The axes with their values in SI.
/// @param usual  the body of the study where no axis varies it
/// @throws std::invalid_argument if a value is wrong for the body, or for one of the bodies, that goes with it
std::vector<Axis> axes_of(const std::vector<GivenAxis>& given, Body usual);

}  // namespace rollres
