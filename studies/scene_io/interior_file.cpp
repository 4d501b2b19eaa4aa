#include "studies/scene_io/interior_file.hpp"

#include <array>
#include <cmath>

#include "core/derivatives/objective.hpp"
#include "core/model/scene_rules.hpp"
#include "core/scene/layer_name.hpp"
#include "studies/text/files.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/vtk_array.hpp"

namespace rollres {

namespace {

struct Field {
  std::string name, unit;
  const Eigen::ArrayXXd* values;
};

/// Those that a section has.
std::vector<Field> fields_of(const VolumeFields& f) {
  struct Kind {
    const char* axes;
    Component component;
  };
  constexpr std::array<Kind, components> kinds{{{"x", Component::x},
                                                {"y", Component::y},
                                                {"z", Component::z},
                                                {"xz", Component::xz},
                                                {"yz", Component::yz},
                                                {"xy", Component::xy}}};
  constexpr int normal = 3;
  std::vector<Field> all{{"u", "m", &f.u}, {"v", "m", &f.v}, {"w", "m", &f.w}};
  for (int i = 0; i < static_cast<int>(kinds.size()); ++i)
    all.push_back(
        {(i < normal ? "sigma_" : "tau_") + std::string(kinds[i].axes), "Pa", &f.stress_of(kinds[i].component)});
  for (int i = 0; i < static_cast<int>(kinds.size()); ++i)
    all.push_back({(i < normal ? "strain_" : "shear_strain_") + std::string(kinds[i].axes), "1",
                   &f.strain_of(kinds[i].component)});
  all.push_back({"loss_density", "W/m3", &f.loss_density});
  std::erase_if(all, [](const Field& field) { return field.values->size() == 0; });
  return all;
}

std::string heading(const Field& field) { return field.name + " [" + field.unit + "]"; }

std::string number(double value) { return shortest(value + 0.0); }

/// "inside" or "coating"; of faces "face_0", the surface, and from there on the bonds.
std::string file_name(const std::vector<InteriorSection>& sections, std::size_t place) {
  const InteriorSection& section = sections[place];
  if (!section.is_face()) return section.on_body ? "coating" : "inside";
  const auto first = find_if(
      sections, [&](const InteriorSection& other) { return other.is_face() && other.on_body == section.on_body; });
  return std::string(section.on_body ? "coating_" : "") + "face_" + std::to_string(&section - &*first);
}

}  // namespace

std::string interior_csv(const std::vector<InteriorSection>& sections) {
  if (sections.empty()) return {};
  // Of an upright section y tells something where it is not the plane of symmetry.
  const bool with_y = sections.front().is_face() || sections.front().y.front() != 0;
  std::string text = with_y ? "x [m],y [m],z [m],layer" : "x [m],z [m],layer";
  for (const Field& field : fields_of(sections.front().fields)) text += ',' + heading(field);
  text += '\n';
  for (const InteriorSection& section : sections) {
    const std::vector<Field> fields = fields_of(section.fields);
    for (std::size_t row = 0; row < section.z.size(); ++row)
      for (std::size_t across = 0; across < section.y.size(); ++across)
        for (std::size_t column = 0; column < section.x.size(); ++column) {
          text += number(section.x[column]) + ',' + (with_y ? number(section.y[across]) + ',' : std::string()) +
                  number(section.z[row]) + ',' + layer_name(section.on_body, section.layer[row]);
          const auto place = static_cast<Eigen::Index>(row * section.y.size() + across);
          for (const Field& field : fields)
            text += ',' + number((*field.values)(static_cast<Eigen::Index>(column), place));
          text += '\n';
        }
  }
  return text;
}

std::string interior_vtr(const InteriorSection& section) {
  const std::size_t columns = section.x.size(), across = section.y.size(), rows = section.z.size();
  const std::string extent =
      "0 " + std::to_string(columns - 1) + " 0 " + std::to_string(across - 1) + " 0 " + std::to_string(rows - 1);
  std::string text = vtk_head("RectilinearGrid") + "<RectilinearGrid WholeExtent=\"" + extent +
                     "\">\n<Piece Extent=\"" + extent + "\">\n<PointData Scalars=\"loss_density [W/m3]\">\n";
  // z rises in the file: under the body the rows come from the bottom.
  const auto row_at = [&](std::size_t place) { return section.on_body ? place : rows - 1 - place; };
  for (const Field& field : fields_of(section.fields)) {
    std::vector<double> values;
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t y = 0; y < across; ++y)
        for (std::size_t column = 0; column < columns; ++column)
          values.push_back(
              (*field.values)(static_cast<Eigen::Index>(column), static_cast<Eigen::Index>(row_at(row) * across + y)));
    text += vtk_array(heading(field), values);
  }
  std::vector<double> z;
  for (std::size_t place = 0; place < rows; ++place) z.push_back(section.z[row_at(place)] + 0.0);
  text += "</PointData>\n<Coordinates>\n";
  text += vtk_array("x [m]", section.x) + vtk_array("y [m]", section.y) + vtk_array("z [m]", z);
  return text + "</Coordinates>\n</Piece>\n</RectilinearGrid>\n</VTKFile>\n";
}

std::string losses_csv(const InteriorSummary& summary, const RollingScene& scene) {
  std::string text = "layer,z [m],loss [" + std::string(body_of(scene).per_metre() ? "W/m2" : "W/m") +
                     "],share [1],strain_amplitude [1]\n";
  double sum = 0;
  for (const LineOfFlow& line : summary.lines) {
    sum += line.thickness * line.loss;
    text += layer_name(line.on_body, line.layer) + ',' + number(line.z) + ',' + number(body_length(scene) * line.loss) +
            ',' + number(summary.loss != 0 ? sum / summary.loss : 0) + ',' + number(line.strain_amplitude) + '\n';
  }
  return text;
}

std::string bonds_csv(const InteriorSummary& summary, Indenter indenter) {
  const bool sphere = dimension_of(indenter) == 3;
  std::string text = sphere ? "bond_below,z [m],largest_shear [Pa],shear_x [m],shear_y [m],largest_tension [Pa],"
                              "tension_x [m],tension_y [m]\n"
                            : "bond_below,z [m],largest_shear [Pa],shear_x [m],largest_tension [Pa],tension_x [m]\n";
  for (const Bond& bond : summary.bonds) {
    const auto place = [&](double x, double y) { return ',' + (sphere ? number(x) + ',' + number(y) : number(x)); };
    text += layer_name(bond.on_body, bond.layer) + ',' + number(bond.z) + ',' + number(bond.shear) +
            place(bond.shear_x, bond.shear_y) + ',' + number(bond.tension) +
            (bond.tension > 0 ? place(bond.tension_x, bond.tension_y) : std::string(sphere ? ",," : ",")) + '\n';
  }
  return text;
}

std::string interior_text(const InteriorSummary& summary, const RollingScene& scene) {
  const bool sphere = dimension_of(scene.indenter) == 3;
  const std::string unit(real_output("interior_loss").unit_for(body_of(scene)));
  const auto place = [&](double x, double y) {
    return " at x = " + readable(x, "m") + (sphere ? ", y = " + readable(y, "m") : std::string());
  };
  std::string text = "\ninside the layers\n";
  for (const LayerLoss& layer : summary.layers) {
    constexpr double rounding = 1e-12;
    const bool lossless = std::abs(layer.loss) <= rounding * std::abs(summary.loss);
    text += "  " + layer_name(layer.on_body, layer.layer) + ": loss " +
            (lossless ? "none" : readable(body_length(scene) * layer.loss, unit));
    if (summary.loss != 0 && !lossless) text += " (" + short_number(100 * layer.loss / summary.loss, 4) + " %)";
    text += ", strain amplitude " + short_number(layer.strain_amplitude, 4) + ", largest " +
            short_number(layer.peak_strain_amplitude, 4) + '\n';
    for (const Bond& bond : summary.bonds)
      if (bond.layer == layer.layer && bond.on_body == layer.on_body)
        text += "    bond at z = " + readable(bond.z, "m") + ": shear " + readable(bond.shear, "Pa") +
                place(bond.shear_x, bond.shear_y) + ", " +
                (bond.tension > 0 ? "tension " + readable(bond.tension, "Pa") + place(bond.tension_x, bond.tension_y)
                                  : std::string("no tension")) +
                '\n';
  }
  return text;
}

bool has_interior(const RollingScene& scene, const RollingSolution& solution) {
  return why_no_interior(scene).empty() && solution.fields.grid.size() > 0;
}

void write_interior(const std::filesystem::path& directory, const RollingScene& scene,
                    const RollingSolution& solution) {
  const ContactModel solved = ContactModel(scene).with_answer(solution);
  const std::vector<InteriorSection> sections = interior_sections(solved, solution.fields);
  const InteriorSummary summary = inside_of_answer(scene, solution);
  make_directory(directory);
  std::vector<InteriorSection> upright, faces;
  for (std::size_t place = 0; place < sections.size(); ++place) {
    write_file(directory / (file_name(sections, place) + ".vtr"), interior_vtr(sections[place]));
    (sections[place].is_face() ? faces : upright).push_back(sections[place]);
  }
  write_file(directory / "inside.csv", interior_csv(upright));
  if (!faces.empty()) write_file(directory / "faces.csv", interior_csv(faces));
  write_file(directory / "losses.csv", losses_csv(summary, scene));
  write_file(directory / "bonds.csv", bonds_csv(summary, scene.indenter));
}

}  // namespace rollres
