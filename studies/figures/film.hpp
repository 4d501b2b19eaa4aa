#pragma once

/// A film of a study: stick and slip and the tractions on the layer, point by point along an axis, above the chart of
/// the rolling resistance with the place where the film is. One animated GIF, drawn by gnuplot; script and data stay
/// beside it.

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"
#include "studies/drawing/chart.hpp"

namespace rollres {

/// One picture of a film: a converged solution with its fields.
struct FilmFrame {
  std::string words;  ///< what it shows: "speed = 20 mm/s"
  ChartPoint point;   ///< in the chart, in the units of its axes
  RollingScene scene;
  RollingSolution solution;
};

/// The bodies of all pictures are of one kind.
struct FilmRequest {
  std::string title, subtitle = {};
  ChartAxis x, y;                 ///< of the chart
  std::vector<FilmFrame> frames;  ///< two at least, in the order in which they are shown
  double seconds = 0.25;          ///< that each is shown
};

struct FilmFiles {
  std::filesystem::path film, script, data;
};

/// A suffix .gif, .gp or .dat of `name` is dropped; folders are made.
/// @throws std::runtime_error if a file cannot be written, or if gnuplot is missing or fails (with its own words)
FilmFiles draw_film(const FilmRequest& request, const std::filesystem::path& name);

}  // namespace rollres
