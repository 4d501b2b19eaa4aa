#include "studies/figures/figure.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "core/interior/interior_summary.hpp"
#include "core/model/scene_rules.hpp"
#include "studies/figures/figure_map.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

constexpr int cylinder = 2, sphere = 3;

constexpr std::array<Figure, 16> figures{{
    {3, "displacements", cylinder, false, "Displacements of the layer's surface", displacement_lines},
    {4, "tractions", cylinder, false, "Tractions on the layer", traction_lines},
    {5, "zones", sphere, false, "Stick and slip", zone_map},
    {6, "sigma_z", sphere, false, "Normal traction on the layer", contour_map},
    {7, "tau_xz", sphere, true, "Shear traction along the motion", contour_map},
    {8, "tau_xz_surface", sphere, true, "Shear traction along the motion", relief},
    {9, "tau_yz", sphere, true, "Shear traction across the motion", contour_map},
    {10, "w", sphere, false, "Vertical displacement of the surface", contour_map},
    {11, "u", sphere, false, "Displacement along the motion", contour_map},
    {12, "u_surface", sphere, false, "Displacement along the motion", relief},
    {13, "v", sphere, false, "Displacement across the motion", contour_map},
    {14, "friction", sphere, true, "Friction on the layer", friction_arrows},
    {15, "velocity", sphere, false, "Velocity of the layer's surface", velocity_arrows},
    {16, "shear_strain", {}, false, "Shear strain inside the layers", section_map},
    {17, "loss_density", {}, false, "Power lost inside the layers, per volume", section_map},
    {18, "temperature", cylinder, false, "Temperature through the warmed layers, and what warms them",
     temperature_lines},
}};

/// The paper's last figure; what follows is ours.
constexpr int last_of_paper = 15;

const Figure& figure_named(const std::string& wish) {
  int number = 0;
  const char* const end = wish.data() + wish.size();
  const bool is_number = std::from_chars(wish.data(), end, number).ptr == end;
  std::vector<std::string_view> names;
  for (const Figure& figure : figures) {
    if ((is_number && figure.number == number) || figure.name == wish) return figure;
    names.push_back(figure.name);
  }
  if (is_number) names.clear();
  throw std::invalid_argument(unknown("--figure = " + wish + ": no such figure", names, wish, "there are 3 to 18"));
}

/// Why a scene has no such figure; empty if it has.
std::string hindrance(const Figure& figure, const RollingScene& scene) {
  if (figure.dimension && *figure.dimension != dimension_of(scene.indenter))
    return std::string("a figure of a ") + (*figure.dimension == cylinder ? "cylinder" : "sphere or roller") +
           ", and indenter = " + std::string(name_of(scene.indenter));
  if (figure.of_friction && scene.friction_coefficient == 0) return "friction_coefficient = 0 leaves it empty";
  if (figure.draw == temperature_lines && scene.heat == Heat::off) return "heat = off: its layers are not warmed";
  return figure.number > last_of_paper ? why_no_interior(scene) : "";
}

}  // namespace

FigureSource::FigureSource(const RollingScene& given_scene, const RollingSolution& given_solution)
    : scene(given_scene),
      solution(given_solution),
      surface(surface_around(ContactModel(scene).with_answer(solution), solution, figure_margin)),
      velocity(surface_velocity(scene, surface)) {}

std::string Figure::file_name() const {
  return "figure_" + std::string(number < 10 ? "0" : "") + std::to_string(number) + "_" + std::string(name);
}

std::span<const Figure> all_figures() { return figures; }

std::vector<Figure> figures_for(const RollingScene& scene, const std::vector<std::string>& names) {
  std::vector<Figure> wanted;
  for (const std::string& wish : names) {
    const Figure& figure = figure_named(wish);
    if (const std::string why = hindrance(figure, scene); !why.empty())
      throw std::invalid_argument("--figure = " + wish + ": " + why);
    if (none_of(wanted, [&](const Figure& other) { return other.number == figure.number; })) wanted.push_back(figure);
  }
  if (names.empty())
    std::copy_if(figures.begin(), figures.end(), std::back_inserter(wanted),
                 [&](const Figure& figure) { return hindrance(figure, scene).empty(); });
  return wanted;
}

ChartFiles draw_figure(const Figure& figure, const FigureSource& source, const std::filesystem::path& directory) {
  const ChartFiles files = chart_files(directory / figure.file_name());
  const PictureText text = figure.draw(figure, source, files);
  draw_pictures(
      files, text.data, text.script,
      {std::string(figure.title),
       (figure.number > last_of_paper ? ""
                                      : "figure " + std::to_string(figure.number) + " of Zehil and Gavin (2013), ") +
           std::string("of a ") + std::string(Body(source.scene.indenter).name()) + " that rolls along x"});
  return files;
}

}  // namespace rollres
