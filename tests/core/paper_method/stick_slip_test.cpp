// Covers line_stick_slip, surface_stick_slip, tangential_problem too.

#include "core/paper_method/stick_slip.hpp"

#include <Eigen/LU>

#include "tests/catch.hpp"
#include "tests/core/active_set_scenes.hpp"

using namespace rollres;
using namespace rollres::test;
using D = Direction;

namespace {

/// System (16) of Zehil and Gavin (2013), as printed but for the sign of its first row's definitions and with C_UU in
/// q1, for the zones found; with T = QR its second row is that of the system before (19), with + x2^T F_R / R.
struct PrintedSystem {
  Eigen::VectorXd force;  // at the sticking nodes
  std::vector<int> stick;
  double rotation_ratio;
  bool case_a;
};

PrintedSystem printed_system(const RollingScene& scene, const Solved& solved) {
  const ContactState& state = solved.state;
  const SurfaceGrid& grid = solved.grid;
  const double a = grid.spacing_x, R = scene.radius, V = scene.speed;
  PrintedSystem printed;
  std::vector<int> slip, contact;
  for (int node = 0; node < grid.columns; ++node) {
    if (state.zone[node] == Zone::stick) printed.stick.push_back(node);
    if (state.zone[node] == Zone::slip) slip.push_back(node);
    if (state.zone[node] != Zone::free) contact.push_back(node);
  }
  const auto n = static_cast<Eigen::Index>(printed.stick.size());
  const int ref = printed.stick.back();
  printed.case_a = state.zone[ref + 1] == Zone::slip;
  const auto known = [&](int node) {  // displacement u from F_R and from the friction of slipping nodes
    double u = 0;
    for (const int source : contact) u -= solved.table(D::u, D::w, node - source) * state.pressure[source] * a;
    for (const int source : slip) u += solved.table(D::u, D::u, node - source) * state.shear_x[source] * a;
    return u;
  };
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + 2, n + 2);
  Eigen::VectorXd rhs(n + 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) matrix(i, j) = -solved.table(D::u, D::u, printed.stick[i] - printed.stick[j]);
    const double q2 = grid.x(ref) - grid.x(printed.stick[i]);
    matrix(i, n) = -R / V * q2;
    matrix(i, n + 1) = 1;
    rhs[i] = known(printed.stick[i]) - q2;
    matrix(n + 1, i) = -solved.table(D::u, D::u, ref + 1 - printed.stick[i]);
  }
  matrix(n + 1, n) = a * R / V;
  matrix(n + 1, n + 1) = 1;
  rhs[n + 1] = a + known(ref + 1);
  const auto q3 = [&](int node) { return 1 + std::sqrt(1 - std::pow(grid.x(node) / R, 2)); };
  rhs[n] = scene.drive == Drive::torque ? -*scene.driving_torque / R : 0;
  for (const int node : contact)
    if (scene.drive == Drive::top_force) rhs[n] -= grid.x(node) * state.pressure[node] * a / R;
  for (const int node : slip) rhs[n] -= (scene.drive == Drive::top_force ? q3(node) : 1) * state.shear_x[node] * a;
  for (Eigen::Index i = 0; i < n; ++i) matrix(n, i) = scene.drive == Drive::top_force ? q3(printed.stick[i]) : 1;
  const Eigen::VectorXd solution = matrix.fullPivLu().solve(rhs);
  printed.force = solution.head(n);
  printed.rotation_ratio = R * solution[n] / V;
  return printed;
}

}  // namespace

TEST_CASE("the rows of differences have the solution of the printed system (16), in cases A and B",
          "[core][stick_slip]") {
  int case_a = 0, case_b = 0;
  for (const Drive drive : {Drive::top_force, Drive::torque, Drive::free})
    for (const double friction : {0.2, 3.0}) {
      RollingScene scene = paper_scene(Indenter::cylinder);
      scene.drive = drive;
      scene.friction_coefficient = friction;
      if (drive == Drive::torque) scene.driving_torque = 3;
      const Solved solved = solve_on(scene, 7.5e-3);
      REQUIRE(solved.state.status == Status::converged);
      const PrintedSystem printed = printed_system(scene, solved);
      (printed.case_a ? case_a : case_b)++;
      CHECK(solved.state.rotation_ratio == Approx(printed.rotation_ratio).epsilon(1e-9));
      const double largest = printed.force.cwiseAbs().maxCoeff();
      for (Eigen::Index i = 0; i < printed.force.size(); ++i)
        CHECK(std::abs(solved.state.shear_x[printed.stick[i]] * solved.grid.spacing_x - printed.force[i]) <
              1e-8 * largest);
    }
  CHECK(case_a > 0);
  CHECK(case_b > 0);
}

TEST_CASE("sticking nodes of a row of the sphere move as eqs. (27) and (28) say", "[core][stick_slip]") {
  RollingScene scene = paper_scene(Indenter::sphere);
  scene.spacing = 0.6e-3;
  const Solved solved = solve_on(scene, 6e-3);
  REQUIRE(solved.state.status == Status::converged);
  const SurfaceGrid& grid = solved.grid;
  const auto displacement = [&](D direction, int column, int row) {
    double sum = 0;
    for (int j = 0; j < grid.rows; ++j)
      for (int i = 0; i < grid.columns; ++i) {
        const int node = grid.index(i, j);
        if (solved.state.zone[node] == Zone::free) continue;
        sum += grid.cell_area() * (-solved.table(direction, D::w, column - i, row - j) * solved.state.pressure[node] +
                                   solved.table(direction, D::u, column - i, row - j) * solved.state.shear_x[node] +
                                   solved.table(direction, D::v, column - i, row - j) * solved.state.shear_y[node]);
      }
    return sum;
  };
  int checked = 0;
  for (int row = 0; row < grid.rows; ++row) {
    int ref = grid.columns - 1;
    while (ref >= 0 && solved.state.zone[grid.index(ref, row)] != Zone::stick) --ref;
    const double roll = std::sqrt(1 - std::pow(grid.y(row) / scene.radius, 2));
    for (int i = ref; i >= 0 && solved.state.zone[grid.index(i, row)] == Zone::stick; --i, ++checked) {
      const double ahead = displacement(D::u, ref + 1, row), side = displacement(D::v, ref + 1, row);
      const double g = (ref + 1 - i) * grid.spacing_x;
      // Displacements are of the order of 1e-4 m.
      CHECK(std::abs(displacement(D::u, i, row) - ahead + g * (roll * solved.state.rotation_ratio - 1)) < 1e-13);
      CHECK(std::abs(displacement(D::v, i, row) - side) < 1e-13);
    }
  }
  CHECK(checked > 80);
}

TEST_CASE("a drive that friction cannot bear has no steady state, and the coefficient named is the least that has one",
          "[core][stick_slip]") {
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
    RollingScene scene = paper_scene(indenter);
    scene.spacing = indenter == Indenter::cylinder ? 0.25e-3 : 0.7e-3;
    scene.friction_coefficient = 0.005;
    const Solved below = solve_on(scene, 7.5e-3);
    CHECK(below.state.status == Status::no_steady_state);
    REQUIRE_THAT(below.state.reason, Catch::Contains("a friction coefficient of about "));
    const std::string words = "coefficient of about ";
    const double needed = std::stod(below.state.reason.substr(below.state.reason.find(words) + words.size()));
    scene.friction_coefficient = 1.02 * needed;
    CHECK(solve_on(scene, 7.5e-3).state.status == Status::converged);
    scene.friction_coefficient = 0.98 * needed;
    CHECK(solve_on(scene, 7.5e-3).state.status == Status::no_steady_state);
  }
}

TEST_CASE("without re-sticking, friction that ends up against the slip is reported and not returned as an answer",
          "[core][stick_slip]") {
  RollingScene scene = paper_scene(Indenter::cylinder);
  scene.drive = Drive::free;
  scene.friction_coefficient = 0.03;
  CHECK(solve_on(scene, 7.5e-3).state.status == Status::converged);
  scene.resticking = Resticking::off;
  const Solved printed = solve_on(scene, 7.5e-3);
  CHECK(printed.state.status == Status::not_converged);
  CHECK_THAT(printed.state.reason, Catch::Contains("friction points against the slip at "));
}

TEST_CASE("the sphere's printed rule ends with its state in words", "[core][stick_slip]") {
  RollingScene scene = paper_scene(Indenter::sphere);
  scene.spacing = 0.6e-3;
  scene.slip_rule = SlipRule::printed;
  for (const SlipStencil stencil : {SlipStencil::forward, SlipStencil::central, SlipStencil::backward}) {
    scene.slip_stencil = stencil;
    const Solved printed = solve_on(scene, 6e-3);
    CAPTURE(name_of(stencil));
    CHECK(printed.state.status == Status::not_converged);
    CHECK_THAT(printed.state.reason, Catch::Contains("sticking nodes bear more than the limit of friction"));
  }
}
