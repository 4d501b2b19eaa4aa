#include "studies/fit/design_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <set>

#include "fitting/descent/latin_hypercube.hpp"
#include "studies/scene_io/scene_inputs.hpp"

namespace rollres {

namespace {

DesignRange range_of_data(const FitFile& file, const std::string& key) {
  DesignRange range{key, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const MeasuredScene& row : file.scenes) {
    if (is_of_material(row.output)) continue;
    const double value = real_input(row.scene, key);
    if (!std::isfinite(value)) continue;
    range.lowest = std::min(range.lowest, value);
    range.highest = std::max(range.highest, value);
  }
  const double beyond = key == "speed" ? 10 : key == "load" ? 3 : 1;
  if (range.lowest > 0) range.lowest /= beyond, range.highest *= beyond;
  return range;
}

/// Places to begin with: all corners where they are few, and a Latin hypercube.
std::vector<Eigen::VectorXd> first_places(std::size_t inputs) {
  constexpr std::size_t most_corners = 5;  // of so many inputs
  std::vector<Eigen::VectorXd> places;
  const auto n = static_cast<Eigen::Index>(inputs);
  if (inputs <= most_corners)
    for (std::size_t corner = 0; corner < (std::size_t{1} << inputs); ++corner) {
      Eigen::VectorXd place(n);
      for (Eigen::Index k = 0; k < n; ++k) place[k] = (corner >> k) & 1U ? 1 : 0;
      places.push_back(place);
    }
  const int count = 30 + 10 * static_cast<int>(inputs);
  const Eigen::MatrixXd sample = latin_hypercube(count, n, 1);
  for (Eigen::Index i = 0; i < sample.rows(); ++i) places.emplace_back(sample.row(i).transpose());
  return places;
}

}  // namespace

MeasuredScene DesignSpace::at(std::size_t set, const Eigen::VectorXd& place) const {
  MeasuredScene scene = sets[set];
  for (std::size_t k = 0; k < ranges.size(); ++k)
    set_input(scene.scene, ranges[k].key, ranges[k].at(place[static_cast<Eigen::Index>(k)]));
  return scene;
}

Eigen::VectorXd place_of(const DesignSpace& space, const RollingScene& scene) {
  Eigen::VectorXd place(std::ssize(space.ranges));
  for (std::size_t k = 0; k < space.ranges.size(); ++k)
    place[static_cast<Eigen::Index>(k)] = space.ranges[k].part_of(real_input(scene, space.ranges[k].key));
  return place;
}

std::vector<MeasuredScene> examples_of(const FitFile& file,
                                       const std::function<std::string(const MeasuredScene&)>& group_of) {
  std::set<std::string> seen;
  std::vector<MeasuredScene> groups;
  for (const MeasuredScene& row : file.scenes)
    if (!is_of_material(row.output) && seen.insert(group_of(row)).second) groups.push_back(row);
  return groups;
}

DesignSpace design_space(const FitFile& file) {
  DesignSpace space{file.design.ranges, examples_of(file, [](const MeasuredScene& row) { return row.set; })};
  if (space.sets.empty()) return space;
  std::vector<std::string> keys{"speed"};
  if (space.sets.front().scene.load) keys.emplace_back("load");
  keys.insert(keys.end(), file.varying.begin(), file.varying.end());
  for (const std::string& key : keys) {
    if (space.range_of(key) || !find_input(key)->real()) continue;
    if (const DesignRange range = range_of_data(file, key); range.highest > range.lowest) space.ranges.push_back(range);
  }
  return space;
}

void search_from(const DesignSpace& space, std::size_t set, const Eigen::VectorXd& place, const RatePlaces& rate) {
  const auto inputs = static_cast<unsigned>(space.ranges.size());
  constexpr unsigned fewest = 2;  // variables of BOBYQA
  nlopt::opt search(inputs >= fewest ? nlopt::LN_BOBYQA : nlopt::LN_COBYLA, inputs);
  search.set_lower_bounds(0.0);
  search.set_upper_bounds(1.0);
  search.set_initial_step(0.1);
  search.set_xtol_abs(1e-3);
  search.set_maxeval(20 + 10 * static_cast<int>(inputs));
  const std::function<double(const std::vector<double>&)> value = [&](const std::vector<double>& at) {
    constexpr double nothing = 1e3;
    const double found = rate({space.at(set, Eigen::Map<const Eigen::VectorXd>(at.data(), std::ssize(at)))}).front();
    return std::isfinite(found) ? found : nothing;
  };
  const auto objective = [](const std::vector<double>& at, std::vector<double>&, void* data) {
    return (*static_cast<const std::function<double(const std::vector<double>&)>*>(data))(at);
  };
  search.set_min_objective(objective, const_cast<std::function<double(const std::vector<double>&)>*>(&value));
  std::vector<double> at(place.data(), place.data() + place.size());
  double least = 0;
  try {
    search.optimize(at, least);
  } catch (const nlopt::roundoff_limited&) {  // as near as it gets
  }
}

void search_space(const DesignSpace& space, const RatePlaces& rate) {
  struct Start {
    std::size_t set;
    Eigen::VectorXd place;
    double value;
  };
  std::vector<Start> starts;
  std::vector<MeasuredScene> scenes;
  for (const Eigen::VectorXd& place : first_places(space.ranges.size()))
    for (std::size_t set = 0; set < space.sets.size(); ++set) {
      starts.push_back({set, place, 0});
      scenes.push_back(space.at(set, place));
    }
  const std::vector<double> values = rate(scenes);
  for (std::size_t i = 0; i < starts.size(); ++i) starts[i].value = values[i];
  std::erase_if(starts, [](const Start& start) { return !std::isfinite(start.value); });
  stable_sort(starts, [](const Start& a, const Start& b) { return a.value < b.value; });
  constexpr std::size_t most = 3;
  constexpr double apart = 0.2;
  std::vector<Start> taken;
  for (const Start& start : starts) {
    if (taken.size() == most) break;
    if (any_of(taken, [&](const Start& other) {
          return other.set == start.set && (other.place - start.place).norm() < apart;
        }))
      continue;
    taken.push_back(start);
    search_from(space, start.set, start.place, rate);
  }
}

}  // namespace rollres
