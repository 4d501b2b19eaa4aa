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

}  // namespace rollres::verification
