#include "studies/evidence/verification.hpp"

#include <cmath>

#include "core/reference/reference_rollers.hpp"
#include "core/reference/reference_solutions.hpp"
#include "studies/evidence/verification_checks.hpp"
#include "studies/evidence/verification_heat.hpp"
#include "studies/evidence/verification_inside.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

using namespace verification;

constexpr const char *paper_2d = "Zehil and Gavin (2013), 5.1", *paper_3d = "Zehil and Gavin (2013), 5.2",
                     *dense_program = "independent dense program",
                     *contact_program = "CONTACT, after Wang and Knothe (1993)",
                     *rollers = "Bentall and Johnson (1967)",
                     *contact_rollers = "CONTACT, after Bentall and Johnson (1967)",
                     *contact_sphere = "CONTACT, Cattaneo to Carter";

RollingScene with_method(RollingScene scene, Method method) {
  scene.method = method;
  return scene;
}

double count(const RollingSolution& solution, int nodes) {
  return solution.status == Status::converged ? nodes : RollingSolution::absent;
}

/// Where the power goes with consistent kinematics.
void add_energy(Checks& checks, const std::string& body, RollingScene scene, double tolerance, const char* why) {
  scene.kinematics = Kinematics::consistent;
  const RollingSolution s = checks.solve(scene);
  checks.add({body + ": power lost in layer and friction, by the fields", "balance of power, R_r V", "W",
              s.rolling_resistance * scene.speed, s.viscous_loss + s.frictional_loss, tolerance, why});
}

void add_laws(Checks& checks, const std::string& body, const RollingSolution& solution) {
  checks.add({body + ": violation of the laws of contact", "laws of contact", "1", 0, solution.law_violation, 1e-8,
              "the solver's tolerance"});
}

void check_paper_cylinder(Checks& checks) {
  const std::string body = "paper's cylinder";
  const RollingScene scene = paper_scene("paper_cylinder");
  const RollingSolution grid = checks.solve(with_method(scene, Method::newton));
  checks.add({body + ": nodes in contact", paper_2d, "1", 31, count(grid, grid.contact_nodes), 0, "a count"});
  checks.add({body + ": nodes that slip", paper_2d, "1", 4, count(grid, grid.slip_nodes), 0, "a count"});
  checks.add({body + ": mean pressure", paper_2d, "Pa", 2.58e6, grid.mean_pressure, 0.005 / 2.58, "three digits"});
  checks.add({body + ": approach", dense_program, "m", 0.3698e-3, grid.approach, 0.00005 / 0.3698, "four digits"});
  add_energy(checks, body, without_grid(scene), 1e-7, "the default tolerance");
  add_laws(checks, body, grid);

  const RollingSolution paper = checks.solve(with_method(scene, Method::active_set));
  checks.add({body + ": R_r by the paper's algorithms", "method newton", "N/m", grid.rolling_resistance,
              paper.rolling_resistance, 1e-8, "the solvers' tolerance"});
  RollingScene fine = with_method(scene, Method::newton);
  *fine.spacing /= 16;
  const RollingSolution continuous = checks.solve(without_grid(scene));
  checks.add({body + ": R_r on a grid of a/16", "method spectral", "N/m", continuous.rolling_resistance,
              checks.solve(fine).rolling_resistance, 1e-4, "first order in the spacing"});
  checks.add({body + ": R_r, continuous edges", dense_program, "N/m", 357.1785671916, continuous.rolling_resistance,
              1e-8, "the default tolerance"});
  checks.add({body + ": RΩ/V, continuous edges", dense_program, "1", 1.040730611, continuous.rotation_ratio, 1e-9,
              "ten digits"});
  RollingScene smooth = without_grid(scene);
  smooth.friction_coefficient = 0;
  checks.add({body + ": R_r without friction", dense_program, "N/m", 370.2717666,
              checks.solve(smooth).rolling_resistance, 1e-8, "the default tolerance"});
}

void check_paper_sphere(Checks& checks) {
  const std::string body = "paper's sphere";
  const RollingScene scene = paper_scene("paper_sphere");
  const RollingSolution s = checks.solve(scene);
  const double cell = 1e-6;
  checks.add({body + ": leading edge", paper_3d, "m", 4.25e-3, s.leading_edge, cell, "a node"});
  checks.add({body + ": trailing edge", paper_3d, "m", -3.75e-3, s.trailing_edge, cell, "a node"});
  checks.add({body + ": mean pressure", paper_3d, "Pa", 2.56e6, s.mean_pressure, 0.005 / 2.56, "three digits"});
  RollingScene train = scene;
  train.period = 0.05;
  checks.add({body + ": R_r, with a period of 50 mm", paper_3d, "N", 3.07, checks.solve(train).rolling_resistance,
              0.005 / 3.07, "three digits; the paper does not tell its period"});
  checks.add({body + ": R_r", dense_program, "N", 3.099, s.rolling_resistance, 0.0005 / 3.099, "four digits"});
  checks.add({body + ": approach", dense_program, "m", 0.5766e-3, s.approach, 0.00005 / 0.5766, "four digits"});
  checks.add({body + ": R_r by the paper's algorithms", "method newton", "N", s.rolling_resistance,
              checks.solve(with_method(scene, Method::active_set)).rolling_resistance, 1e-7, "the solvers' tolerance"});
  add_energy(checks, body, scene, 5e-3, "the edges lie between nodes");
  add_laws(checks, body, s);
}

/// Memory V tau in terms of the rubbery half-width.
RollingScene with_memory(RollingScene scene, double half_width, double ratio, double stiffening) {
  scene.material = MaterialModel::zener;
  scene.stiffening = stiffening;
  scene.creep_time = ratio * half_width / scene.speed;
  return scene;
}

void check_hertz(Checks& checks) {
  const std::string source = "Hertz (1881)";
  const RollingScene line = on_half_space(Indenter::cylinder), sphere = on_half_space(Indenter::sphere);
  const RollingSolution flat = checks.solve(line), round = checks.solve(sphere);
  const HertzLine hertz = hertz_line(line.radius, *line.load, shear_modulus);
  const HertzSphere ball = hertz_sphere(sphere.radius, *sphere.load, shear_modulus);
  checks.add({"cylinder on a half-space: half-width", source, "m", hertz.half_width, 0.5 * flat.contact_area, 1e-8,
              "the default tolerance"});
  checks.add({"cylinder on a half-space: largest pressure", source, "Pa", hertz.peak_pressure, flat.peak_pressure, 1e-8,
              "the default tolerance"});
  checks.add({"sphere on a half-space: approach", source, "m", ball.approach, round.approach, 1e-3,
              "a grid of 40 cells across"});
  checks.add({"sphere on a half-space: largest pressure", source, "Pa", ball.peak_pressure, round.peak_pressure, 1e-3,
              "a grid of 40 cells across"});
}

void check_hunter(Checks& checks) {
  struct Row {
    double ratio, stiffening;
  };
  for (const auto& [ratio, stiffening] : {Row{0.01, 1}, {0.1, 1}, {1.1, 1}, {10, 1}, {1.37, 9}, {1.63, 99}}) {
    const RollingScene scene = with_memory(on_half_space(Indenter::cylinder), line_width, ratio, stiffening);
    const HunterLine hunter =
        hunter_line(scene.radius, *scene.load, shear_modulus, stiffening, scene.creep_time, scene.speed);
    checks.add(
        {"cylinder on a Zener half-space: R_r, Vτ/a = " + short_number(ratio) + ", f = " + short_number(stiffening),
         "Hunter (1961)", "N/m", hunter.rolling_resistance, checks.solve(scene).rolling_resistance, 1e-8,
         "the default tolerance"});
  }
}

void check_contact_program(Checks& checks) {
  RollingScene scene = on_half_space(Indenter::cylinder);
  scene.material = MaterialModel::zener;
  scene.radius = 0.05;
  scene.static_shear_modulus = 952.5e6 / 4;
  scene.stiffening = 1;
  scene.load = 600e3;
  struct Row {
    const char* memory;
    double creep_time, pressure, creepage;
  };
  for (const auto& [memory, creep_time, pressure, creepage] :
       {Row{"9 ms", 0.009, 78.74e6, 0.01365}, {"45 ms", 0.045, 84.72e6, 0.01152}}) {
    scene.creep_time = creep_time;
    checks.add({"viscoelastic cylinder, τ = " + std::string(memory) + ": largest pressure", contact_program, "Pa",
                pressure, checks.solve(scene).peak_pressure, 0.003, "its body is a parabola, 0.2 %"});
    RollingScene braked = scene;
    braked.friction_coefficient = 0.3;
    braked.drive = Drive::torque;
    braked.driving_torque = -0.6 * braked.friction_coefficient * *scene.load * scene.radius;
    braked.spacing = 0.16e-3;  // its own
    checks.add({"viscoelastic cylinder, τ = " + std::string(memory) + ": creepage", contact_program, "1", creepage,
                1 - checks.solve(braked).rotation_ratio, 0.02, "one cell of 40"});
  }
}

void check_carter(Checks& checks) {
  RollingScene scene = on_half_space(Indenter::cylinder);
  scene.friction_coefficient = 0.3;
  const double torque = 0.64 * scene.friction_coefficient * *scene.load * scene.radius;
  const CarterLine carter = carter_line(scene.radius, *scene.load, shear_modulus, scene.friction_coefficient, torque);
  scene.drive = Drive::rotation;
  scene.rotation_ratio = 1 + carter.creepage;
  const RollingSolution s = checks.solve(scene);
  const std::string allowance = "the shear carries a part μ a/R of the load";
  checks.add(
      {"driven cylinder on a half-space: torque", "Carter (1926)", "N", torque, s.driving_torque, 2e-5, allowance});
  checks.add({"driven cylinder on a half-space: loss to friction", "Carter (1926)", "W/m",
              carter.rolling_resistance * scene.speed, s.frictional_loss, 2e-5, allowance});

  // Along the axle a half-space of ν = 1/2 yields twice as much as across it.
  RollingScene askew = on_half_space(Indenter::cylinder);
  askew.friction_coefficient = 0.3;
  askew.kinematics = Kinematics::consistent;
  askew.drive = Drive::free;
  constexpr double stick = 0.6;  // of the contact's length
  const double half_width = hertz_line(askew.radius, *askew.load, shear_modulus).half_width;
  askew.skew_angle = std::atan(2 * askew.friction_coefficient * (1 - stick) * half_width / askew.radius);
  checks.add({"cylinder askew on a half-space: axial force", "Carter (1926)", "N/m",
              -(1 - stick * stick) * askew.friction_coefficient * *askew.load, checks.solve(askew).axial_force, 2e-4,
              "the default grid"});
}

constexpr double rollers_half_width = 1e-4;  // of Hertz [m]

/// Bentall and Johnson's rollers as CONTACT has them: one rigid, the other a half-space.
RollingScene rollers_scene(double friction_coefficient, int cells) {
  RollingScene scene = on_half_space(Indenter::cylinder);
  scene.radius = 0.025;
  scene.static_shear_modulus = 15059.0866e6;
  scene.poisson_ratio = 0.41600128;
  scene.load = 16201.9;
  scene.friction_coefficient = friction_coefficient;
  scene.drive = Drive::free;
  scene.spacing = rollers_half_width / cells;
  return scene;
}

void check_rollers(Checks& checks) {
  const RollingScene slippery = rollers_scene(1e-5, 240);
  RollingScene rough = rollers_scene(10, 960);
  const FullSlipLine slips = full_slip_line(slippery.radius, *slippery.load, *slippery.static_shear_modulus,
                                            slippery.poisson_ratio, slippery.friction_coefficient);
  const NoSlipLine sticks = no_slip_line(rough.radius, *rough.load, *rough.static_shear_modulus, rough.poisson_ratio);
  rough.spacing = sticks.half_width / 960.5;  // whole cells in contact
  const RollingSolution slipping = checks.solve(slippery);
  checks.add({"free roller in full slip: creepage", rollers, "1", slips.creepage, 1 - slipping.rotation_ratio, 1e-3,
              "half a cell where the slip turns, a/240"});
  checks.add({"free roller in full slip: loss to friction", rollers, "W/m", slips.rolling_resistance * slippery.speed,
              slipping.frictional_loss, 3e-4, "order 3/2 in the spacing, a/240"});
  checks.add({"free roller without slip: creepage", rollers, "1", sticks.creepage,
              1 - checks.solve(rough).rotation_ratio, 1.5e-3, "first order in the spacing, a/960"});
}

void check_contact_rollers(Checks& checks) {
  const char *digits = "four digits", *grid = "its grid is not told; ours, a/240, is within 3e-4 of the limit";
  const RollingScene low = rollers_scene(1e-4, 240), free = rollers_scene(0.05, 240);
  const RollingSolution slipping = checks.solve(low), partly = checks.solve(free);
  checks.add(
      {"free roller, μ = 1e-4: creepage", contact_rollers, "1", 5.260e-4, 1 - slipping.rotation_ratio, 1e-3, grid});
  checks.add({"free roller, μ = 1e-4: largest pressure", contact_rollers, "Pa", 103.1e6, slipping.peak_pressure,
              0.05 / 103.1, digits});
  checks.add(
      {"free roller, μ = 0.05: creepage", contact_rollers, "1", 4.294e-4, 1 - partly.rotation_ratio, 1e-3, grid});
  checks.add({"free roller, μ = 0.05: largest pressure", contact_rollers, "Pa", 103.6e6, partly.peak_pressure,
              0.05 / 103.6, digits});
  checks.add({"free roller, μ = 0.05: loss to friction", contact_rollers, "W/m", 9.475e-3, partly.frictional_loss, 1e-3,
              grid});
  for (const auto& [share, creepage] : {std::pair{0.75, 2.108e-4}, {-0.75, 5.392e-4}}) {
    RollingScene driven = free;
    driven.drive = Drive::torque;
    driven.driving_torque = share * free.friction_coefficient * *free.load * free.radius;
    checks.add({"roller, μ = 0.05, T = " + short_number(share) + " μPR: creepage", contact_rollers, "1", creepage,
                1 - checks.solve(driven).rotation_ratio, 1e-3, grid});
  }
}

/// Two spheres of one material, braked: a coating, 46 half-widths thick, stands for the second one.
void check_two_spheres(Checks& checks) {
  // The radius times 1,000, load and creepage over it: the contact is the same, and the circle a parabola.
  const double enlarged = 1000;
  RollingScene scene = on_half_space(Indenter::sphere);
  scene.radius = 0.16875 * enlarged;
  scene.static_shear_modulus = 1e6;
  scene.poisson_ratio = 0.28;
  BondedLayer second;
  second.layer_thickness = 0.16;
  static_cast<MaterialInputs&>(second) = scene;
  scene.coating_layers = {second};
  scene.load = 0.4705 / enlarged;
  scene.friction_coefficient = 0.4013;
  scene.drive = Drive::torque;
  scene.driving_torque = -0.657 * scene.friction_coefficient * *scene.load * scene.radius;
  scene.spacing = 0.25e-3;  // its own
  const RollingSolution s = checks.solve(scene);
  const std::string body = "two spheres of one material, braked: ";
  checks.add({body + "cells in contact", contact_sphere, "1", 621, count(s, s.contact_nodes), 0, "a count"});
  checks.add({body + "cells that slip", contact_sphere, "1", 275, count(s, s.slip_nodes), 0, "a count"});
  checks.add({body + "largest pressure", contact_sphere, "Pa", 0.01834e6, s.peak_pressure * enlarged, 0.0005 / 1.834,
              "four digits"});
  checks.add({body + "creepage", contact_sphere, "1", 3.101e-3, (1 - s.rotation_ratio) * enlarged, 5e-4,
              "four digits, and 3e-4 for the coating's thickness"});
}

void check_kalker(Checks& checks) {
  RollingScene scene = on_half_space(Indenter::sphere);
  scene.friction_coefficient = 1;
  scene.drive = Drive::rotation;
  const double creepage = 1e-3 * sphere_width / unit_radius;  // a thousandth of that at which all slips
  const auto force = [&](double ratio) {
    scene.rotation_ratio = ratio;
    return -checks.solve(scene).driving_force;
  };
  // The rolling radius varies over the contact: the difference of two creepages is free of it.
  const double difference = force(1 + creepage) - force(1 - creepage);
  const double unit_force = kalker_force(sphere_width, shear_modulus, 2 * creepage) / kalker_circle(0.5).c11;
  checks.add({"sphere at small creepage: C11", "Kalker (1990)", "1", kalker_circle(0.5).c11, difference / unit_force,
              0.02, "first order on a grid of 40 cells across"});
}

void check_layers(Checks& checks) {
  for (const ElasticLayerRow& row : elastic_layer_table) {
    const std::string ratio = "a/H = " + short_number(row.width_ratio);
    const bool thin = row.width_ratio > 10;
    RollingScene line = on_half_space(Indenter::cylinder), sphere = on_half_space(Indenter::sphere);
    line.layer_thickness = line_width / row.width_ratio;
    line.load = row.cylinder_load * M_PI * shear_modulus * line_width * line_width / unit_radius;
    checks.add({"cylinder on an elastic layer: approach, " + ratio, "integral equation", "m",
                row.cylinder_approach * line_width * line_width / unit_radius, checks.solve(line).approach,
                thin ? 1e-3 : 1e-5, thin ? "solved on a grid" : "six digits"});
    sphere.layer_thickness = sphere_width / row.width_ratio;
    sphere.load = row.sphere_load * shear_modulus * std::pow(sphere_width, 3) / unit_radius;
    checks.add({"sphere on an elastic layer: approach, " + ratio, "Lebedev and Ufliand (1958)", "m",
                sphere_width * sphere_width / (unit_radius * row.sphere_flatness), checks.solve(sphere).approach, 1e-3,
                thin ? "a layer of two cells" : "a grid of 40 cells across"});
  }
}

void check_speed_limits(Checks& checks) {
  const ElasticLayerRow& row = elastic_layer_table[3];
  RollingScene slow = with_memory(on_half_space(Indenter::cylinder), line_width, 1e-5, 1);
  slow.layer_thickness = line_width / row.width_ratio;
  slow.load = row.cylinder_load * M_PI * shear_modulus * line_width * line_width / unit_radius;
  checks.add({"slow cylinder on a layer: R_r, Vτ/a = 1e-5", "P V τ'/R", "N/m",
              slow_rolling_resistance(*slow.load, slow.radius, slow.speed, slow_loss_time(1, slow.creep_time)),
              checks.solve(slow).rolling_resistance, 3e-5, "first order in Vτ/a"});

  RollingScene fast = with_memory(on_half_space(Indenter::sphere), sphere_width, 1e4, 1);
  fast.tolerance = 1e-3;
  const HertzSphere glassy = hertz_sphere(fast.radius, *fast.load, 2 * shear_modulus);
  checks.add({"fast sphere on a half-space: R_r, Vτ/a = 1e4", "∫ p (d - r²/2R) dA/(V τ\")", "N",
              fast_rolling_resistance(*fast.load, glassy.approach, glassy.mean_square_position(), fast.radius,
                                      fast.speed, fast_loss_time(1, fast.creep_time)),
              checks.solve(fast).rolling_resistance, 1e-3, "the wanted tolerance"});
}

}  // namespace

double VerificationRow::difference() const { return expected == 0 ? std::abs(got) : std::abs(got / expected - 1); }

std::vector<VerificationRow> verify(const Evaluate& evaluate) {
  Checks checks(evaluate);
  check_paper_cylinder(checks);
  check_paper_sphere(checks);
  check_hertz(checks);
  check_hunter(checks);
  check_contact_program(checks);
  check_carter(checks);
  check_skewed_paper_cylinder(checks);
  check_rollers(checks);
  check_contact_rollers(checks);
  check_two_spheres(checks);
  check_kalker(checks);
  check_turned_spheres(checks);
  check_given_pressures(checks);
  check_layers(checks);
  check_speed_limits(checks);
  check_inside_cylinder(checks);
  check_inside_sphere(checks);
  check_heat(checks);
  return std::move(checks).rows();
}

}  // namespace rollres
