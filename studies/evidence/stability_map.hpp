#pragma once

/// The map of a method: speed against friction, a point for each scene, its outcome by colour and by mark.

#include <filesystem>
#include <string>
#include <vector>

#include "studies/drawing/chart.hpp"
#include "studies/evidence/stability.hpp"

namespace rollres {

/// The data file: one block for each outcome, its columns speed, friction and the scene's number.
std::string stability_map_data(const std::vector<Trial>& trials);

/// The gnuplot script; failures are drawn over the rest.
std::string stability_map_script(const std::vector<Trial>& trials, const ChartFiles& files);

/// Draws the trials of one method and one indenter, of which there is at least one.
/// @throws as draw_chart
ChartFiles draw_stability_map(const std::vector<Trial>& trials, const std::filesystem::path& name,
                              const std::string& gnuplot = "gnuplot");

}  // namespace rollres
