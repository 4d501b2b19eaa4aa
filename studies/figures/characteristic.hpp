#pragma once

/// The characteristic of a rolling body: the forces and the moment that it takes, over its load, along an axis (skew,
/// creepage, camber, pivot), with the friction that bounds them; below it the contacts of some points, to one scale,
/// with what of them sticks and what slips. Drawn by gnuplot as SVG and PNG; script and data stay beside them.

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"
#include "studies/drawing/chart.hpp"

namespace rollres {

struct CharacteristicPoint {
  double place;  ///< on the axis, in its unit
  RollingScene scene;
  RollingSolution solution;  ///< converged, with fields
};

struct CharacteristicRequest {
  std::string title, subtitle = {};
  ChartAxis x;
  std::vector<CharacteristicPoint> points;  ///< two at least, in the order of their places; bodies of one kind
};

/// How much of a contact slips, from 0 to 1: of its area, or of a cylinder's of its length.
double slipping_share(const RollingSolution& solution);

/// @throws std::invalid_argument where no point has friction: nothing sticks or slips
/// @throws std::runtime_error as draw_pictures
ChartFiles draw_characteristic(const CharacteristicRequest& request, const std::filesystem::path& name);

}  // namespace rollres
