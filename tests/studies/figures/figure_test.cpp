#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/solve/rolling_contact.hpp"
#include "studies/figures/figure_map.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"
#include "tests/studies/figure_blocks.hpp"

// Covers figure_fields, figure_lines, figure_map, figure_nodes, figure_section and figure_temperature, too.

using namespace rollres;

namespace {

const ChartFiles no_files{"f.gp", "f.dat", "f.svg", "f.png"};

Figure figure(int number) {
  const auto all = all_figures();
  return *std::find_if(all.begin(), all.end(), [&](const Figure& one) { return one.number == number; });
}

FigureSource source_of(const RollingScene& scene) { return {scene, solve(scene)}; }

const FigureSource& sphere_source() {
  static const FigureSource source = source_of(paper_sphere());
  return source;
}

std::size_t node_at(const SurfaceGrid& grid, double x, double y) {
  return static_cast<std::size_t>(grid.index(static_cast<int>(std::lround((x - grid.x(0)) / grid.spacing_x)),
                                             static_cast<int>(std::lround((y - grid.y(0)) / grid.spacing_y))));
}

std::vector<RollingScene> cylinder_by_all_methods() {
  RollingScene gridless = paper_cylinder();
  gridless.spacing.reset();
  return {gridless, paper_cylinder(), with_method(paper_cylinder(), Method::newton_dense),
          with_method(paper_cylinder(), Method::active_set)};
}

}  // namespace

TEST_CASE("figure 3: u has one slope across the stick zone and a steeper one in the slip behind it",
          "[studies][figure]") {
  for (const RollingScene& scene : cylinder_by_all_methods()) {
    const FigureSource source = source_of(scene);
    CAPTURE(name_of(source.solution.method));
    const auto blocks = figure_blocks(displacement_lines(figure(3), source, no_files).data);
    const FigureBlock& rows = blocks.at("fields").front();  // x [mm], u [mm], w [mm], zone
    const double ahead = rows.back()[0], behind = rows.front()[0];
    CHECK(ahead > 1e3 * source.solution.leading_edge + 4);
    CHECK(behind < 1e3 * source.solution.trailing_edge - 4);
    const double creep = source.solution.rotation_ratio - 1;
    int stick = 0, slip_behind = 0;
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
      const double slope = (rows[i + 1][1] - rows[i][1]) / (rows[i + 1][0] - rows[i][0]);
      if (rows[i][3] == 1 && rows[i + 1][3] == 1) {
        CHECK(slope == Approx(creep).epsilon(1e-5));
        ++stick;
      }
      if (rows[i][3] == 2 && rows[i + 1][3] == 2 && rows[i][0] < 0) {
        CHECK(slope > 1.01 * creep);
        ++slip_behind;
      }
    }
    CHECK(stick > 20);
    CHECK(slip_behind >= 2);
    // The layer meets the cylinder at a higher place than it leaves it.
    const auto touches = [](const std::vector<double>& row) { return row[3] != 0; };
    const auto first = std::find_if(rows.begin(), rows.end(), touches);
    const auto last = std::find_if(rows.rbegin(), rows.rend(), touches);
    CHECK((*last)[2] > (*first)[2] + 0.05);
  }
}

TEST_CASE("figure 4: the shear is at the bound of friction in the slip behind, and its negative area is the larger",
          "[studies][figure]") {
  for (const RollingScene& scene : cylinder_by_all_methods()) {
    const FigureSource source = source_of(scene);
    CAPTURE(name_of(source.solution.method));
    const auto blocks = figure_blocks(traction_lines(figure(4), source, no_files).data);
    double positive = 0, negative = 0, deepest = 0, place = 0;
    for (const auto& row : blocks.at("fields").front()) {  // x, sigma_z, tau_xz, -mu sigma_z, mu sigma_z, zone
      if (row[5] == 2 && row[0] < 0) CHECK(row[2] == Approx(row[3]).margin(1e-9));
      CHECK(std::abs(row[2]) <= row[3] + 1e-7);
      (row[2] > 0 ? positive : negative) += row[2];
      if (row[1] < deepest) deepest = row[1], place = row[0];
    }
    CHECK(-negative > positive);
    CHECK(-negative < 1.6 * positive);
    CHECK(deepest == Approx(-1e-6 * source.solution.peak_pressure).epsilon(2e-3));
    CHECK(place > 0.3);  // towards the leading edge [mm]

    // The bar: slip behind the stick, together as long as the contact.
    double length = 0;
    for (const char* name : {"stick", "slip"})
      for (const auto& box : blocks.at(name).front()) length += box[3] - box[2];
    CHECK(length == Approx(1e3 * source.solution.contact_area).epsilon(1e-6));
    CHECK(blocks.at("slip").front().front()[3] == Approx(blocks.at("stick").front().front()[2]).margin(0.2));
  }
}

TEST_CASE("figure 5: the slip is a crescent at the back, thicker at the sides than in the middle",
          "[studies][figure]") {
  const auto blocks = figure_blocks(zone_map(figure(5), sphere_source(), no_files).data);
  const FigureBlock &stick = blocks.at("stick_nodes").front(), &slip = blocks.at("slip_nodes").front();
  CHECK(static_cast<int>(slip.size()) == sphere_source().solution.slip_nodes);
  CHECK(static_cast<int>(stick.size() + slip.size()) == sphere_source().solution.contact_nodes);
  const auto thickness = [&](double y) {
    return std::count_if(slip.begin(), slip.end(),
                         [&](const auto& at) { return at[0] < 0 && std::abs(at[1] - y) < 0.01; });
  };
  CHECK(thickness(0) == 1);
  CHECK(thickness(2.5) >= 3);
  CHECK(thickness(2.5) == thickness(-2.5));
  // The outline runs outside all nodes in contact and inside all others, within half a cell.
  double leading = 0, trailing = 0;
  for (const auto& row : blocks.at("contact_edge").front()) {
    leading = std::max(leading, row[0]);
    trailing = std::min(trailing, row[0]);
  }
  CHECK(leading == Approx(4.25 + 0.125).margin(0.1));
  CHECK(trailing == Approx(-3.75 - 0.125).margin(0.1));
}

TEST_CASE("figures 6, 7 and 9: tractions have the paper's ranges and signs", "[studies][figure]") {
  const FigureSource& source = sphere_source();
  const SurfaceFields& fields = source.surface;
  const auto extent = [&](std::string_view name) {
    const std::vector<double> values = shown_field(source, name).values;
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return std::pair(*least, *most);
  };
  CHECK(extent("sigma_z").first == Approx(-3.944e6).epsilon(2e-3));
  CHECK(extent("sigma_z").second == 0);
  CHECK(extent("tau_yz").second == Approx(0.343e6).epsilon(0.02));
  CHECK(extent("tau_yz").first == -extent("tau_yz").second);
  // Pushed backwards in front, dragged forward at the sides behind, backwards again in the thin middle of the slip.
  CHECK(fields.shear_x[node_at(fields.grid, 2.5e-3, 0)] < -0.1e6);
  CHECK(fields.shear_x[node_at(fields.grid, -1e-3, 3e-3)] > 0.2e6);
  CHECK(fields.shear_x[node_at(fields.grid, -3.75e-3, 0)] < 0);
  // The layer is held together as it moves away from the axis.
  CHECK(fields.shear_y[node_at(fields.grid, 0, 2e-3)] < 0);
  CHECK(fields.shear_y[node_at(fields.grid, 0, -2e-3)] > 0);

  for (const int number : {6, 7, 9}) {
    CAPTURE(number);
    const auto blocks = figure_blocks(contour_map(figure(number), source, no_files).data);
    CHECK(blocks.at("loop").size() >= 8);
    CHECK(blocks.count("outside") == 1);
  }
}

TEST_CASE("a contour map without loops above or below zero has no loop over them, which gnuplot goes through once",
          "[studies][figure]") {
  RollingScene deep = paper_sphere();  // of a half-space nothing rises beside the contact
  deep.layer_thickness = INFINITY;
  const std::string script = contour_map(figure(10), source_of(deep), no_files).script;
  CHECK(script.find("positive") == std::string::npos);
  CHECK(script.find("for [i in negative]") != std::string::npos);
  CHECK(contour_map(figure(10), sphere_source(), no_files).script.find("for [i in positive]") != std::string::npos);
}

TEST_CASE("figure 10: w is -0.22 and -0.12 mm at the two ends of the contact, and positive farther out",
          "[studies][figure]") {
  const SurfaceFields& fields = sphere_source().surface;
  const SurfaceGrid& grid = fields.grid;
  CHECK(fields.w[node_at(grid, -3.75e-3, 0)] == Approx(-0.22e-3).margin(0.005e-3));
  CHECK(fields.w[node_at(grid, 4.25e-3, 0)] == Approx(-0.12e-3).margin(0.005e-3));
  for (const double y : {-8e-3, 8e-3}) CHECK(fields.w[node_at(grid, 0, y)] > 0);
  CHECK(fields.w[node_at(grid, 8e-3, 0)] > 0);
}

TEST_CASE("figure 11: contour lines of u cross the sticking axis at equal distances", "[studies][figure]") {
  const auto blocks = figure_blocks(contour_map(figure(11), sphere_source(), no_files).data);
  std::vector<double> crossings;
  for (const FigureBlock& loop : blocks.at("loop"))
    for (std::size_t i = 0; i + 1 < loop.size(); ++i) {
      const auto &a = loop[i], &b = loop[i + 1];
      if ((a[1] < 0) == (b[1] < 0)) continue;
      const double x = a[0] - a[1] * (b[0] - a[0]) / (b[1] - a[1]);
      if (x > -3.5 && x < 4.2) crossings.push_back(x);
    }
  std::sort(crossings.begin(), crossings.end());
  REQUIRE(crossings.size() >= 6);
  const double distance = crossings[1] - crossings[0];
  for (std::size_t i = 2; i < crossings.size(); ++i)
    CHECK(crossings[i] - crossings[i - 1] == Approx(distance).epsilon(1e-4));
}

TEST_CASE("figure 13: contour lines of v are parallel to x in the stick zone, and equally spaced",
          "[studies][figure]") {
  const auto blocks = figure_blocks(contour_map(figure(13), sphere_source(), no_files).data);
  std::vector<double> heights;
  int inside = 0;
  for (const FigureBlock& loop : blocks.at("loop"))
    for (std::size_t i = 0; i + 1 < loop.size(); ++i) {
      const auto &a = loop[i], &b = loop[i + 1];
      // A rectangle that sticks, with a cell around it.
      const auto sticks = [](const std::vector<double>& at) {
        return at[0] > -1.3 && at[0] < 3 && std::abs(at[1]) < 2.6;
      };
      if (!sticks(a) || !sticks(b)) continue;
      CHECK(std::abs(b[1] - a[1]) < 1e-6);
      ++inside;
      if (a[0] <= 1 && b[0] >= 1) heights.push_back(a[1]);
    }
  CHECK(inside > 50);
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end(), [](double a, double b) { return b - a < 1e-6; }),
                heights.end());
  REQUIRE(heights.size() >= 3);
  const double distance = heights[1] - heights[0];
  for (std::size_t i = 2; i < heights.size(); ++i) CHECK(heights[i] - heights[i - 1] == Approx(distance).epsilon(0.1));
}

TEST_CASE("figure 14: friction points inwards and vanishes near (-1 mm, 0)", "[studies][figure]") {
  const auto blocks = figure_blocks(friction_arrows(figure(14), sphere_source(), no_files).data);
  double least = 1, place = 0;
  for (const char* name : {"friction_stick", "friction_slip"})
    for (const auto& arrow : blocks.at(name).front()) {  // x, y [mm], tau_xz, tau_yz [MPa]
      if (std::abs(arrow[0]) < 3 && std::abs(arrow[1]) > 0.1 && std::abs(arrow[1]) < 3) CHECK(arrow[1] * arrow[3] < 0);
      if (arrow[1] == 0 && std::abs(arrow[2]) < least && std::abs(arrow[0]) < 3)
        least = std::abs(arrow[2]), place = arrow[0];
    }
  CHECK(place == Approx(-1).margin(0.3));
  CHECK(least < 0.01);
}

TEST_CASE("figure 15: the surface parts before the sphere and goes straight back under it", "[studies][figure]") {
  const auto blocks = figure_blocks(velocity_arrows(figure(15), sphere_source(), no_files).data);
  for (const auto& arrow : blocks.at("velocity_stick").front()) {  // x, y [mm], velocities [mm/s]
    CHECK(arrow[2] < 0);
    CHECK(std::abs(arrow[3]) < 1e-6);
  }
  double parting = 0, closing = 0;
  for (const auto& arrow : blocks.at("velocity_free").front()) {
    if (std::abs(arrow[1]) < 1 || std::abs(arrow[1]) > 4) continue;
    const double outwards = arrow[1] > 0 ? arrow[3] : -arrow[3];
    if (arrow[0] > 5 && arrow[0] < 7) parting = std::max(parting, outwards);
    if (arrow[0] > -7 && arrow[0] < -5) closing = std::max(closing, -outwards);
  }
  CHECK(parting > 0.1);
  CHECK(closing > 0);
  CHECK(closing < parting);  // recovery is the slower
}

TEST_CASE("a figure is asked for by number or name, and only where the scene has it", "[studies][figure]") {
  const auto numbers = [](const RollingScene& scene, const std::vector<std::string>& names = {}) {
    std::vector<int> found;
    for (const Figure& one : figures_for(scene, names)) found.push_back(one.number);
    return found;
  };
  CHECK(numbers(paper_cylinder()) == std::vector{3, 4, 16, 17});
  CHECK(numbers(paper_sphere()) == std::vector{5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17});
  CHECK(numbers(frictionless(paper_sphere())) == std::vector{5, 6, 10, 11, 12, 13, 15, 16, 17});
  CHECK(numbers(paper_sphere(), {"09", "w", "9"}) == std::vector{9, 10});
  const auto refused = [&](const RollingScene& scene, const std::string& wish) {
    CHECK_THROWS_AS(numbers(scene, {wish}), std::invalid_argument);
    try {
      numbers(scene, {wish});
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refused(paper_cylinder(), "6") == "--figure = 6: a figure of a sphere or roller, and indenter = cylinder");
  CHECK(refused(paper_sphere(), "sigmaz") == "--figure = sigmaz: no such figure; did you mean sigma_z?");
  CHECK(refused(paper_sphere(), "19") == "--figure = 19: no such figure; there are 3 to 18");
  CHECK(refused(frictionless(paper_sphere()), "tau_xz") ==
        "--figure = tau_xz: friction_coefficient = 0 leaves it empty");
}

TEST_CASE("figure 18: the temperature goes from the face to the bond, and the power lost is that of the resistance",
          "[studies][figure]") {
  RollingScene belt = paper_cylinder();
  belt.spacing.reset();
  CHECK_THROWS_WITH(figures_for(belt, {"temperature"}), Catch::Matchers::Contains("heat = off"));
  belt.kinematics = Kinematics::consistent;
  belt.friction_coefficient = 0;
  belt.width = 0.5;
  belt.heat = Heat::on;
  belt.thermal_conductivity = 0.2;
  belt.turn_length = 5;
  belt.surface_heat_transfer = 15;
  belt.core_heat_transfer = 10;
  belt.ambient_temperature = 293.15;
  const FigureSource source = source_of(belt);
  const RollingSolution& s = source.solution;
  REQUIRE(s.status == Status::converged);
  const auto blocks = figure_blocks(temperature_lines(figure(18), source, no_files).data);
  const FigureBlock& rows = blocks.at("temperature").front();  // depth [mm], T [degC]
  CHECK(rows.front()[0] == 0);
  CHECK(rows.back()[0] == Approx(1e3 * belt.layer_thickness));
  CHECK(rows.front()[1] == Approx(s.surface_temperature - 273.15).epsilon(1e-4));
  CHECK(rows.back()[1] == Approx(s.bond_temperature - 273.15).epsilon(1e-4));
  double warmest = 0;
  for (const auto& row : rows) warmest = std::max(warmest, row[1]);
  CHECK(std::abs(warmest - (s.peak_temperature - 273.15)) < 0.01 * (warmest - 20));
  // depth [mm], power lost [its unit]; what the trapezia between the nodes of the rule lack is of some per cent.
  const FigureBlock& lost = blocks.at("power lost").front();
  double sum = 0;
  for (std::size_t i = 1; i + 1 < lost.size(); ++i)
    sum += 0.5 * (lost[i][0] - lost[i - 1][0]) * (lost[i][1] + lost[i - 1][1]);
  const double power = s.rolling_resistance * belt.speed / (*belt.width * *belt.turn_length);  // [W/m2]
  const double unit = power / (1e-3 * sum);
  CHECK(std::pow(10, std::round(std::log10(unit))) == Approx(unit).epsilon(0.05));
  CHECK(blocks.at("materials").front().size() == 2);

  // In sublayers the materials stand in steps, whose middles lie on the profile.
  belt.reference_temperature = 293.15;
  belt.wlf_c1 = 8.86;
  belt.wlf_c2 = 101.6;
  belt.thermal_sublayers = 4;
  const auto in_steps = figure_blocks(temperature_lines(figure(18), source_of(belt), no_files).data);
  const FigureBlock& taken = in_steps.at("materials").front();  // T [degC], depth [mm]
  REQUIRE(taken.size() == 8);
  CHECK(taken.back()[1] == Approx(1e3 * belt.layer_thickness));
  const FigureBlock& fine = in_steps.at("temperature").front();  // at each hundredth of the depth
  for (std::size_t i = 0; i < 4; ++i)
    CHECK(taken[2 * i][0] == Approx(0.5 * (fine[12 + 25 * i][1] + fine[13 + 25 * i][1])).epsilon(1e-3));
}
