#include "studies/scene_io/fields_file.hpp"

#include <cassert>
#include <cmath>
#include <type_traits>
#include <vector>

#include "core/model/indenter_shape.hpp"
#include "core/newton/surface_window.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "studies/text/files.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/vtk_array.hpp"

namespace rollres {

namespace {

constexpr double strip_width = 0.25;  // of a cylinder's strip, over its length

struct Column {
  std::string name, unit;
  std::vector<double> values;
};

/// @param speed  over which slips are told: square to the axle of a skewed cylinder [m/s]
std::vector<Column> columns_of(double speed, const SurfaceFields& fields) {
  std::vector<Column> columns;
  auto add = [&](const char* name, const char* unit, const std::vector<double>& values, double factor) {
    if (values.empty()) return;  // y in two dimensions
    assert(values.size() == static_cast<std::size_t>(fields.grid.size()));
    columns.push_back({name, unit, values});
    for (double& value : columns.back().values) value = factor * value + 0.0;  // no negative zero
  };
  add("w", "m", fields.w, 1.0);
  add("u", "m", fields.u, 1.0);
  add("v", "m", fields.v, 1.0);
  add("sigma_z", "Pa", fields.pressure, -1.0);
  add("tau_xz", "Pa", fields.shear_x, 1.0);
  add("tau_yz", "Pa", fields.shear_y, 1.0);
  add("slip_x", "m/s", fields.slip_x, speed);
  add("slip_y", "m/s", fields.slip_y, speed);
  return columns;
}

double slip_speed(const RollingScene& scene, const RollingSolution& solution) {
  return scene.speed * (std::isfinite(solution.skew_angle) ? std::cos(solution.skew_angle) : 1);
}

std::string triple(double x, double y, double z) { return shortest(x) + ' ' + shortest(y) + ' ' + shortest(z); }

/// A text as VTK's ASCII format has it: the codes of its bytes, and zero.
std::string text_array(const std::string& name, const std::string& text) {
  std::string codes;
  for (const char byte : text) codes += std::to_string(static_cast<int>(static_cast<unsigned char>(byte))) + ' ';
  return "<DataArray type=\"String\" Name=\"" + name + "\" NumberOfTuples=\"1\" format=\"ascii\">\n" + codes +
         "0\n</DataArray>\n";
}

std::string field_data(const RollingScene& scene, const RollingSolution& solution) {
  std::string text =
      "<FieldData>\n" + text_array("scene", scene_json(scene)) + text_array("zone", "0 free, 1 stick, 2 slip");
  visit_outputs(solution, [&](const Quantity& quantity, const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>)
      if (std::isfinite(value))
        text += "<DataArray type=\"Float64\" Name=\"" + std::string(quantity.key) +
                unit_in_brackets(quantity.unit_for(body_of(scene))) + "\" NumberOfTuples=\"1\" format=\"ascii\">\n" +
                shortest(value) + "\n</DataArray>\n";
  });
  return text + "</FieldData>\n";
}

/// Height of the body's lower surface at each node [m]; beside the body, that of its axis.
std::vector<double> body_surface(const RollingScene& scene, const SurfaceGrid& grid, double approach) {
  std::vector<double> heights;
  const IndenterShape shape{ContactModel(scene)};
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const double x = grid.x(column), y = dimension_of(scene.indenter) == 3 ? grid.y(row) : 0;
      heights.push_back((shape.covers(x, y) ? shape.profile(x, y) : scene.radius) - approach);
    }
  return heights;
}

}  // namespace

std::string fields_csv(const RollingScene& scene, const SurfaceFields& fields, const RollingSolution& solution) {
  const bool sphere = dimension_of(scene.indenter) == 3;
  const std::vector<Column> columns = columns_of(slip_speed(scene, solution), fields);
  std::string text = sphere ? "x [m],y [m]" : "x [m]";
  for (const Column& column : columns) text += ',' + column.name + " [" + column.unit + ']';
  text += ",zone\n";
  for (int row = 0; row < fields.grid.rows; ++row)
    for (int i = 0; i < fields.grid.columns; ++i) {
      const auto node = static_cast<std::size_t>(fields.grid.index(i, row));
      text += shortest(fields.grid.x(i));
      if (sphere) text += ',' + shortest(fields.grid.y(row));
      for (const Column& column : columns)
        text += ',' + (std::isfinite(column.values[node]) ? shortest(column.values[node]) : std::string());
      text += ',' + std::string(name_of(fields.zone[node])) + '\n';
    }
  return text;
}

std::string fields_vti(const RollingScene& scene, const SurfaceFields& fields, const RollingSolution& solution) {
  std::vector<Column> columns = columns_of(slip_speed(scene, solution), fields);
  std::erase_if(columns, [](const Column& column) {
    return !all_of(column.values, [](double value) { return std::isfinite(value); });
  });
  const SurfaceGrid& grid = fields.grid;
  const bool strip = dimension_of(scene.indenter) == 2;  // the one row twice, that it is seen as a surface
  const double width = strip ? strip_width * grid.spacing_x * (grid.columns - 1) : 0;
  const std::string extent =
      "0 " + std::to_string(grid.columns - 1) + " 0 " + std::to_string(strip ? 1 : grid.rows - 1) + " 0 0";
  std::string text = vtk_head("ImageData") + "<ImageData WholeExtent=\"" + extent + "\" Origin=\"" +
                     triple(grid.x(0), strip ? -0.5 * width : grid.y(0), 0) + "\" Spacing=\"" +
                     triple(grid.spacing_x, strip ? width : grid.spacing_y, 1) + "\">\n" + field_data(scene, solution) +
                     "<Piece Extent=\"" + extent + "\">\n" +
                     "<PointData Scalars=\"sigma_z [Pa]\" Vectors=\"displacement [m]\">\n";
  const auto of_all_rows = [&](const auto& values) {
    auto all = values;
    if (strip) all.insert(all.end(), values.begin(), values.end());
    return all;
  };
  for (const Column& column : columns)
    text += vtk_array(column.name + " [" + column.unit + "]", of_all_rows(column.values));
  const auto component = [&](const std::vector<double>& values, std::size_t node) {
    return node < values.size() && std::isfinite(values[node]) ? values[node] : 0.0;
  };
  const auto vectors = [&](const char* name, const std::vector<double>& x, const std::vector<double>& y,
                           const std::vector<double>& z, double factor_z) {
    std::vector<double> values;
    for (std::size_t node = 0; node < static_cast<std::size_t>(grid.size()); ++node)
      for (const double value : {component(x, node), component(y, node), factor_z * component(z, node) + 0.0})
        values.push_back(value);
    text += vtk_array(name, of_all_rows(values), 3);
  };
  vectors("displacement [m]", fields.u, fields.v, fields.w, 1);
  vectors("traction [Pa]", fields.shear_x, fields.shear_y, fields.pressure, -1);
  const SurfaceVelocity velocity = surface_velocity(scene, fields);
  vectors("velocity [m/s]", velocity.x, velocity.y, {}, 1);
  if (std::isfinite(solution.approach)) vectors("body [m]", {}, {}, body_surface(scene, grid, solution.approach), 1);
  std::vector<std::int8_t> zones;
  for (const Zone zone : fields.zone) zones.push_back(static_cast<std::int8_t>(zone));
  text += vtk_array("zone", of_all_rows(zones));
  return text + "</PointData>\n</Piece>\n</ImageData>\n</VTKFile>\n";
}

void write_fields(const std::filesystem::path& directory, const RollingScene& scene, const SurfaceFields& fields,
                  const RollingSolution& solution) {
  make_directory(directory);
  write_file(directory / "fields.csv", fields_csv(scene, fields, solution));
  write_file(directory / "fields.vti", fields_vti(scene, fields, solution));
}

}  // namespace rollres
