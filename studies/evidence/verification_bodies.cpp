#include <cmath>

#include "core/reference/reference_solutions.hpp"
#include "studies/evidence/verification_checks.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres::verification {

/// By FFT on uniform cells, its own straight cylinder being 2e-4 off the continuous one.
void check_skewed_paper_cylinder(Checks& checks) {
  struct Row {
    double degrees, resistance;
  };
  for (const auto& [degrees, resistance] : {Row{0.5, 370.27}, {1, 384.84}, {3, 508.9}}) {
    RollingScene scene = without_grid(paper_scene("paper_cylinder"));
    scene.kinematics = Kinematics::consistent;
    scene.drive = Drive::free;
    scene.skew_angle = degrees * M_PI / 180;
    checks.add({"paper's cylinder, skew " + short_number(degrees) + "°: R_r", "independent program by FFT", "N/m",
                resistance, checks.solve(scene).rolling_resistance, 2e-3, "its cells"});
  }
}

namespace {

/// By FFT and Newton's method on uniform cells, whole, extrapolated.
void check_turned_paper_sphere(Checks& checks) {
  struct Row {
    const char* motion;
    double skew, camber, pivot, resistance, force, moment;  // [deg], [deg], [1/m], [N], [N], [N m]
  };
  for (const Row& row : {Row{"skew 1°", 1, 0, 0, 3.290, -12.01, 9.92e-3},
                         {"camber 10°", 0, 10, 0, 3.375, 11.78, 33.00e-3},
                         {"pivot 20/m", 0, 0, 20, 4.196, 20.03, 56.4e-3}}) {
    RollingScene scene = paper_scene("paper_sphere");
    scene.kinematics = Kinematics::consistent;
    scene.drive = Drive::free;
    scene.skew_angle = row.skew * M_PI / 180;
    scene.camber_angle = row.camber * M_PI / 180;
    scene.pivot = row.pivot;
    scene.spacing = 0.125e-3;
    const RollingSolution s = checks.solve(scene);
    const std::string body = std::string("paper's sphere, ") + row.motion + ": ";
    constexpr const char* source = "independent program by FFT";
    checks.add({body + "R_r", source, "N", row.resistance, s.rolling_resistance, 1e-3, "four digits, and the cells"});
    checks.add({body + "F_y", source, "N", row.force, s.lateral_force, 6e-3, "cells of an eighth of a millimetre"});
    checks.add({body + "M_z", source, "N m", row.moment, s.spin_moment, 6e-3, "likewise"});
  }
}

/// Lateral creepage and spin so small that nearly nothing slips.
void check_kalker_sideways(Checks& checks) {
  constexpr double small = 1e-4;
  RollingScene scene = on_half_space(Indenter::sphere);
  scene.friction_coefficient = 1;
  scene.kinematics = Kinematics::consistent;
  scene.drive = Drive::rotation;
  scene.rotation_ratio = 1;
  scene.spacing = sphere_width / 34;
  constexpr const char* source = "Kalker (1967), extrapolated by an independent program";
  const double creepage = small * sphere_width / unit_radius,
               scale = kalker_force(sphere_width, shear_modulus, creepage) / kalker_circle(0.5).c11;
  RollingScene askew = scene;
  askew.skew_angle = -creepage;
  checks.add({"sphere at small creepage: C22", source, "1", 3.989, checks.solve(askew).lateral_force / scale, 4e-3,
              "68 cells across"});
  scene.pivot = creepage / sphere_width;
  const RollingSolution spun = checks.solve(scene);
  checks.add({"sphere at small spin: C23", source, "1", 1.634, spun.lateral_force / scale, 1e-2, "68 cells across"});
  checks.add({"sphere at small spin: C33", source, "1", 1.165, spun.spin_moment / (scale * sphere_width), 4e-3,
              "68 cells across"});
}

}  // namespace

void check_turned_spheres(Checks& checks) {
  check_turned_paper_sphere(checks);
  check_kalker_sideways(checks);
}

namespace {

RollingScene pressed(double radius, double load) {
  RollingScene scene = on_half_space(Indenter::sphere);
  scene.indenter = Indenter::pressure;
  scene.kinematics = Kinematics::consistent;
  scene.radius = radius;
  scene.load = load;
  return scene;
}

BondedLayer elastic_layer(double thickness, double young, double poisson) {
  BondedLayer layer;
  layer.layer_thickness = thickness;
  layer.poisson_ratio = poisson;
  layer.material = MaterialModel::elastic;
  layer.static_shear_modulus = young / (2 * (1 + poisson));
  return layer;
}

}  // namespace

void check_given_pressures(Checks& checks) {
  constexpr double radius = 0.01, load = 100;
  const RollingScene disc = pressed(radius, load);
  const double yield = (1 - disc.poisson_ratio) / (2 * shear_modulus);  // (1 - nu^2)/E
  checks.add({"disc of pressure on a half-space: deflection of its middle", "Boussinesq (1885)", "m",
              2 * yield * load / (M_PI * radius), checks.solve(disc).deflection, 2e-5,
              "63 cells across, extrapolated"});
  RollingScene square = disc;
  square.pressure_shape = PressureShape::rectangle;
  checks.add({"square of pressure on a half-space: deflection of its middle", "Love (1929)", "m",
              2 * yield * load / (M_PI * radius) * std::log(1 + std::sqrt(2)), checks.solve(square).deflection, 2e-5,
              "63 cells across, extrapolated"});

  // A wheel on 150 mm of asphalt, taken as elastic, 600 mm of base and ground.
  RollingScene road = pressed(0.15, 1.1e6 * M_PI * 0.15 * 0.15);
  static_cast<MaterialInputs&>(road) = elastic_layer(0.15, 3e9, 0.3);
  road.layer_thickness = 0.15;
  road.lower_layers = {elastic_layer(0.6, 200e6, 0.35), elastic_layer(INFINITY, 40e6, 0.4)};
  road.deflection_places_x = {0, -1};
  road.deflection_places_y = {0.3, 0.3};
  const RollingSolution found = checks.solve(road);
  const auto deflection = [&](std::size_t place) {
    return place < found.deflections.size() ? found.deflections[place] : RollingSolution::absent;
  };
  constexpr const char *source = "Hankel's integral, by another program", *why = "its five digits";
  checks.add(
      {"disc of pressure on three layers: deflection beside it", source, "m", 0.80953e-3, deflection(0), 2e-5, why});
  checks.add(
      {"disc of pressure on three layers: deflection behind it", source, "m", 0.45250e-3, deflection(1), 3e-5, why});
}

}  // namespace rollres::verification
