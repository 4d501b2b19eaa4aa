#include "studies/scene_io/interior_file.hpp"

#include <array>
#include <cmath>

#include "core/scene/layer_name.hpp"
#include "studies/scene_io/vtk_array.hpp"
#include "studies/text/files.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

struct Field {
  const char *name, *unit;
  Eigen::ArrayXXd InteriorFields::*values;
};

constexpr std::array<Field, 9> fields{{{"u", "m", &InteriorFields::u},
                                       {"w", "m", &InteriorFields::w},
                                       {"sigma_x", "Pa", &InteriorFields::sigma_x},
                                       {"sigma_z", "Pa", &InteriorFields::sigma_z},
                                       {"tau_xz", "Pa", &InteriorFields::tau_xz},
                                       {"strain_x", "1", &InteriorFields::strain_x},
                                       {"strain_z", "1", &InteriorFields::strain_z},
                                       {"shear_strain_xz", "1", &InteriorFields::shear_strain},
                                       {"loss_density", "W/m3", &InteriorFields::loss_density}}};

std::string heading(const Field& field) { return std::string(field.name) + " [" + field.unit + "]"; }

std::string number(double value) { return shortest(value + 0.0); }

}  // namespace

std::string interior_csv(const std::vector<InteriorSection>& sections) {
  std::string text = "x [m],z [m],layer";
  for (const Field& field : fields) text += ',' + heading(field);
  text += '\n';
  for (const InteriorSection& section : sections)
    for (std::size_t row = 0; row < section.z.size(); ++row)
      for (std::size_t column = 0; column < section.x.size(); ++column) {
        text += number(section.x[column]) + ',' + number(section.z[row]) + ',' +
                layer_name(section.on_body, section.layer[row]);
        for (const Field& field : fields)
          text += ',' + number((section.fields.*field.values)(static_cast<Eigen::Index>(column),
                                                              static_cast<Eigen::Index>(row)));
        text += '\n';
      }
  return text;
}

std::string interior_vtr(const InteriorSection& section) {
  const std::size_t columns = section.x.size(), rows = section.z.size();
  const std::string extent = "0 " + std::to_string(columns - 1) + " 0 0 0 " + std::to_string(rows - 1);
  std::string text = vtk_head("RectilinearGrid") + "<RectilinearGrid WholeExtent=\"" + extent +
                     "\">\n<Piece Extent=\"" + extent + "\">\n<PointData Scalars=\"loss_density [W/m3]\">\n";
  // z rises in the file: under the body the rows come from the bottom.
  const auto row_at = [&](std::size_t place) { return section.on_body ? place : rows - 1 - place; };
  for (const Field& field : fields) {
    std::vector<double> values;
    for (std::size_t place = 0; place < rows; ++place)
      for (std::size_t column = 0; column < columns; ++column)
        values.push_back((section.fields.*field.values)(static_cast<Eigen::Index>(column),
                                                        static_cast<Eigen::Index>(row_at(place))));
    text += vtk_array(heading(field), values);
  }
  std::vector<double> z;
  for (std::size_t place = 0; place < rows; ++place) z.push_back(section.z[row_at(place)] + 0.0);
  text += "</PointData>\n<Coordinates>\n";
  text += vtk_array("x [m]", section.x) + vtk_array("y [m]", std::array{0.0}) + vtk_array("z [m]", z);
  return text + "</Coordinates>\n</Piece>\n</RectilinearGrid>\n</VTKFile>\n";
}

std::string losses_csv(const InteriorSummary& summary) {
  std::string text = "layer,z [m],loss [W/m2],share [1],strain_amplitude [1]\n";
  double sum = 0;
  for (const LineOfFlow& line : summary.lines) {
    sum += line.thickness * line.loss;
    text += layer_name(line.on_body, line.layer) + ',' + number(line.z) + ',' + number(line.loss) + ',' +
            number(summary.loss != 0 ? sum / summary.loss : 0) + ',' + number(line.strain_amplitude) + '\n';
  }
  return text;
}

std::string bonds_csv(const InteriorSummary& summary) {
  std::string text = "bond_below,z [m],largest_shear [Pa],shear_x [m],largest_tension [Pa],tension_x [m]\n";
  for (const Bond& bond : summary.bonds)
    text += layer_name(bond.on_body, bond.layer) + ',' + number(bond.z) + ',' + number(bond.shear) + ',' +
            number(bond.shear_x) + ',' + number(bond.tension) + ',' +
            (bond.tension > 0 ? number(bond.tension_x) : std::string()) + '\n';
  return text;
}

std::string interior_text(const InteriorSummary& summary) {
  std::string text = "\ninside the layers\n";
  for (const LayerLoss& layer : summary.layers) {
    constexpr double rounding = 1e-12;
    const bool lossless = std::abs(layer.loss) <= rounding * std::abs(summary.loss);
    text +=
        "  " + layer_name(layer.on_body, layer.layer) + ": loss " + (lossless ? "none" : readable(layer.loss, "W/m"));
    if (summary.loss != 0 && !lossless) text += " (" + short_number(100 * layer.loss / summary.loss, 4) + " %)";
    text += ", strain amplitude " + short_number(layer.strain_amplitude, 4) + ", largest " +
            short_number(layer.peak_strain_amplitude, 4) + '\n';
    for (const Bond& bond : summary.bonds)
      if (bond.layer == layer.layer && bond.on_body == layer.on_body)
        text +=
            "    bond at z = " + readable(bond.z, "m") + ": shear " + readable(bond.shear, "Pa") +
            " at x = " + readable(bond.shear_x, "m") + ", " +
            (bond.tension > 0 ? "tension " + readable(bond.tension, "Pa") + " at x = " + readable(bond.tension_x, "m")
                              : std::string("no tension")) +
            '\n';
  }
  return text;
}

bool has_interior(const RollingScene& scene, const RollingSolution& solution) {
  return scene.indenter == Indenter::cylinder && !scene.period && solution.method != Method::finite_strain &&
         solution.fields.grid.size() > 0;
}

void write_interior(const std::filesystem::path& directory, const RollingScene& scene,
                    const RollingSolution& solution) {
  const RollingScene solved = solved_scene(scene, solution);
  const std::vector<InteriorSection> sections = interior_sections(solved, solution.fields);
  const InteriorSummary summary = interior_summary(solved, solution.fields, InteriorField::Detail::surface);
  make_directory(directory);
  write_file(directory / "inside.csv", interior_csv(sections));
  for (const InteriorSection& section : sections)
    write_file(directory / (section.on_body ? "coating.vtr" : "inside.vtr"), interior_vtr(section));
  write_file(directory / "losses.csv", losses_csv(summary));
  write_file(directory / "bonds.csv", bonds_csv(summary));
}

}  // namespace rollres
