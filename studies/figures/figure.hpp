#pragma once

/// The figures of a solution: those of Zehil and Gavin (2013), 3 and 4 for a cylinder, 5 to 15 for a sphere, and three
/// of the inside of the layers, drawn by gnuplot as SVG and PNG. The script and the data stay beside each picture.

#include "core/newton/surface_window.hpp"
#include "studies/drawing/chart_frame.hpp"

namespace rollres {

/// Colours of what sticks and what slips.
inline constexpr const char *stick_colour = "#0072B2", *slip_colour = "#D55E00";

/// Half-lengths of the contact that are shown on all sides of it.
constexpr double figure_margin = 1.5;

/// What figures are drawn from.
struct FigureSource {
  RollingScene scene;
  RollingSolution solution;
  SurfaceFields surface;  ///< of a window wider than the contact
  SurfaceVelocity velocity;

  /// @param solution with fields
  FigureSource(const RollingScene& scene, const RollingSolution& solution);
};

/// One figure: the number it has in the paper, and its name.
struct Figure {
  int number;
  std::string_view name;
  std::optional<int> dimension;  // of the contact; absent: of both
  bool of_friction;              ///< empty without it
  std::string_view title;
  PictureText (*draw)(const Figure&, const FigureSource&, const ChartFiles&);

  /// Name of its files, without suffix: "figure_06_sigma_z".
  std::string file_name() const;
};

/// All figures, by number.
std::span<const Figure> all_figures();

/// The figures of a scene, or those of them that are wanted by number ("6", "06") or name ("sigma_z").
/// @throws std::invalid_argument naming a wish that is no figure (with the nearest name), or none of this scene
std::vector<Figure> figures_for(const RollingScene& scene, const std::vector<std::string>& names = {});

/// Whether the edges of the contact are known better than its nodes tell.
bool exact_edges(const RollingSolution& solution);

/// Runs of neighbouring nodes of one zone of a cylinder's contact, from border to border [m].
std::vector<std::array<double, 2>> zone_runs(Zone zone, const SurfaceFields& fields, const RollingSolution& solution);

/// Draws a figure into a folder.
/// @throws std::runtime_error as draw_pictures
ChartFiles draw_figure(const Figure& figure, const FigureSource& source, const std::filesystem::path& directory);

}  // namespace rollres
