#include "studies/scene_io/interior_file.hpp"

#include <algorithm>

#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/studies/temporary_directory.hpp"
#include "tests/studies/vtk_numbers.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

TEST_CASE("what is inside the layers is written as tables and as a grid for ParaView", "[studies][fields]") {
  RollingScene scene = frictionless(paper_cylinder());
  scene.spacing.reset();
  const RollingSolution solution = solve(scene);
  REQUIRE(has_interior(scene, solution));
  const TemporaryDirectory folder;
  write_interior(folder.path, scene, solution);
  const std::string table = file_text(folder / "inside.csv"), grid = file_text(folder / "inside.vtr");
  CHECK(table.starts_with("x [m],z [m],layer,u [m],w [m],sigma_x [Pa],sigma_z [Pa],tau_xz [Pa],strain_x [1]"));
  CHECK_THAT(table, Contains(",layer,"));
  const auto lines = std::count(table.begin(), table.end(), '\n');
  CHECK_THAT(grid, Contains("<RectilinearGrid WholeExtent=\"0 280 0 0 0 39\">"));
  CHECK(lines == 281 * 40 + 1);
  CHECK(vtk_numbers<double>(grid, "loss_density [W/m3]").size() == 281 * 40);
  const std::vector<double> heights = vtk_numbers<double>(grid, "z [m]");
  REQUIRE(heights.size() == 40);
  CHECK(std::is_sorted(heights.begin(), heights.end()));
  CHECK(heights.front() == -scene.layer_thickness);
  CHECK(
      file_text(folder / "losses.csv").starts_with("layer,z [m],loss [W/m2],share [1],strain_amplitude [1]\nlayer,-"));
  CHECK(file_text(folder / "bonds.csv").starts_with("bond_below,z [m],largest_shear [Pa]"));
  CHECK_FALSE(std::filesystem::exists(folder / "coating.vtr"));
  CHECK_THAT(interior_text(interior_summary(scene, solution.fields, InteriorField::Detail::inside), scene),
             Contains("layer: loss 18.") && Contains("(100 %)"));
  RollingScene wide = scene;
  wide.width = 0.1;
  *wide.load *= *wide.width;
  CHECK_THAT(interior_text(interior_summary(wide, solution.fields, InteriorField::Detail::inside), wide),
             Contains("layer: loss 1.8") && Contains(" W (100 %)"));
  write_interior(folder.path / "wide", wide, solution);
  const auto first_loss = [&](const std::string& file) {
    const std::string text = file_text(folder / file), line = text.substr(text.find('\n') + 1);
    const std::size_t place = line.find(',', line.find(',') + 1) + 1;
    return std::stod(line.substr(place));
  };
  CHECK(file_text(folder / "wide/losses.csv").starts_with("layer,z [m],loss [W/m],"));
  CHECK(first_loss("wide/losses.csv") == Approx(0.1 * first_loss("losses.csv")));
  scene.period = 1;
  CHECK_FALSE(has_interior(scene, solution));
}

TEST_CASE("a sphere's inside is written as a section at y = 0 and as faces", "[studies][fields][long]") {
  RollingScene scene = paper_sphere();
  scene.spacing = 0.5e-3;
  const RollingSolution solution = solve(scene);
  REQUIRE(has_interior(scene, solution));
  const TemporaryDirectory folder;
  write_interior(folder.path, scene, solution);
  CHECK(file_text(folder / "inside.csv").starts_with("x [m],z [m],layer,u [m],w [m],sigma_x [Pa],sigma_y [Pa],"));
  const std::string faces = file_text(folder / "faces.csv");
  CHECK(faces.starts_with("x [m],y [m],z [m],layer,u [m],v [m],w [m],sigma_x [Pa],"));
  CHECK(std::count(faces.begin(), faces.end(), '\n') == 1 + 2 * 121 * 81);
  const std::string surface = file_text(folder / "face_0.vtr"), base = file_text(folder / "face_1.vtr");
  CHECK(surface.find("WholeExtent=\"0 120 0 80 0 0\"") != std::string::npos);
  CHECK(vtk_numbers<double>(base, "z [m]") == std::vector<double>{-0.005});
  CHECK(vtk_numbers<double>(surface, "z [m]") == std::vector<double>{0});
  CHECK(file_text(folder / "losses.csv").starts_with("layer,z [m],loss [W/m],share [1],strain_amplitude [1]\n"));
  CHECK(file_text(folder / "bonds.csv").starts_with("bond_below,z [m],largest_shear [Pa],shear_x [m],shear_y [m],"));
}
