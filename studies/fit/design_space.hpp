#pragma once

/// Where further measurements could be made, and the best place in there.

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "studies/fit/fit_file.hpp"

namespace rollres {

/// The ranges of a design, and an example of each data set with all else that it has.
struct DesignSpace {
  std::vector<DesignRange> ranges;
  std::vector<MeasuredScene> sets;

  bool empty() const { return ranges.empty() || sets.empty(); }
  /// That of an input; null if it does not vary.
  const DesignRange* range_of(std::string_view key) const {
    const auto found = find_if(ranges, [&](const auto& range) { return range.key == key; });
    return found == ranges.end() ? nullptr : &*found;
  }
  /// The scene at a place in the unit cube.
  MeasuredScene at(std::size_t set, const Eigen::VectorXd& place) const;
};

/// The ranges that the file gives, and of what varies in its data, of the speed and of the load, those of the data: the
/// speed down to a tenth and up to ten times, the load from a third to three times.
DesignSpace design_space(const FitFile& file);

/// One scene of resistance for each group of rows; @param group_of  what rows of a group share
std::vector<MeasuredScene> examples_of(const FitFile& file,
                                       const std::function<std::string(const MeasuredScene&)>& group_of);

/// What places are worth, the least being best; infinite: nothing. Several are asked for at once where they are known.
using RatePlaces = std::function<std::vector<double>(const std::vector<MeasuredScene>&)>;

/// Looks for the best place: at the corners and a Latin hypercube in each data set, then by BOBYQA (NLopt) from the
/// best of these that lie apart. What is best is known to the rating, which saw it.
void search_space(const DesignSpace& space, const RatePlaces& rate);

/// From one place on.
void search_from(const DesignSpace& space, std::size_t set, const Eigen::VectorXd& place, const RatePlaces& rate);

/// The place of a scene in the unit cube.
Eigen::VectorXd place_of(const DesignSpace& space, const RollingScene& scene);

}  // namespace rollres
