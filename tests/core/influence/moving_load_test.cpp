// Covers sphere_passage, directional_expansion too.
/// A single moving sphere on layers with inertia: influence coefficients against closed forms, lines of loads and
/// trains.

#include <cmath>
#include <random>

#include "core/influence/directional_half_space.hpp"
#include "core/influence/influence.hpp"
#include "core/influence/piecewise_field.hpp"
#include "core/model/contact_surface.hpp"
#include "core/numerics/quadrature.hpp"
#include "tests/catch.hpp"
#include "tests/infinite.hpp"

using namespace rollres;

namespace {

using Component = std::vector<double> InfluenceTable::*;
constexpr Component all_components[] = {&InfluenceTable::ww, &InfluenceTable::uu, &InfluenceTable::vv,
                                        &InfluenceTable::uv, &InfluenceTable::uw, &InfluenceTable::vw};

RollingScene with_inertia(double rayleigh) {
  RollingScene scene;
  scene.indenter = Indenter::sphere;
  scene.radius = 0.1;
  scene.layer_thickness = 0.004;
  scene.layer_density = 1000;
  scene.static_shear_modulus = 1e6;
  scene.material = MaterialModel::elastic;
  scene.load = 1;
  scene.inertia = Inertia::on;
  scene.speed = 1;
  scene.speed = std::sqrt(rayleigh / rayleigh_number(scene));
  return scene;
}

SurfaceGrid square_cells(double spacing, int columns, int rows) {
  SurfaceGrid grid;
  grid.spacing_x = grid.spacing_y = spacing;
  grid.columns = columns;
  grid.rows = rows;
  return grid;
}

double largest(const InfluenceTable& table) {
  double size = 0;
  for (const Component c : {&InfluenceTable::ww, &InfluenceTable::uu, &InfluenceTable::vv})
    for (const double value : table.*c) size = std::max(size, std::abs(value));
  return size;
}

double difference(const InfluenceTable& a, const InfluenceTable& b) {
  double most = 0;
  for (const Component c : all_components)
    for (std::size_t i = 0; i < (a.*c).size(); ++i) most = std::max(most, std::abs((a.*c)[i] - (b.*c)[i]));
  return most / largest(b);
}

/// Averages over a cell by a fine rule.
template <class Function>
Coefficients cell_average(double x, double y, double cell_x, double cell_y, const Function& value) {
  const QuadratureRule rule = gauss_legendre(24);
  Coefficients sum = Coefficients::Zero();
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    for (std::size_t j = 0; j < rule.nodes.size(); ++j)
      sum += rule.weights[i] * rule.weights[j] *
             value(x + cell_x * (rule.nodes[i] - 0.5), y + cell_y * (rule.nodes[j] - 0.5));
  return sum;
}

}  // namespace

TEST_CASE("corner functions are the double antiderivatives of what falls like 1/r in any direction",
          "[core][moving_load]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  Harmonics g(6, 7);
  for (Eigen::Index n = 0; n < g.cols(); ++n)
    for (Eigen::Index c = 0; c < 6; ++c) g(c, n) = n == 0 && c == coefficient::uv ? 0 : any(random);
  const DirectionalHalfSpace corner(g);
  for (const auto& [x, y] : {std::pair{1.0, 0.0}, {2.0, -1.0}, {-1.5, 0.2}, {0.1, 3.0}, {0.0, -0.9}, {1e4, 3e3}}) {
    CAPTURE(x, y);
    const Coefficients expected = cell_average(x, y, 0.8, 0.6, [&](double px, double py) -> Coefficients {
      return harmonic_sum(g, direction_waves(px, py, g.cols())) / std::hypot(px, py);
    });
    const CellFunctions cell(x, y, 0.8, 0.6, g.cols());
    CHECK((harmonic_sum(corner.harmonics(cell.far), cell.values) - expected).abs().maxCoeff() <
          1e-8 * expected.abs().maxCoeff());
  }
}

TEST_CASE("smooth fields are integrated over rectangles on either side of the axes", "[core][moving_load]") {
  const auto field = [](double x, double y) -> Coefficients {
    const double even = std::exp(-x * x - 0.5 * y * y) / (1 + x * x);
    Coefficients value;
    value << even, 2 * even, 3 * even, x * y * even, x * even, y * even;
    return value;
  };
  const PiecewiseField panels({0, 1, 2, 4}, 15, [&](double px, double py) -> Eigen::VectorXd {
    return field(px, py).matrix().replicate(2, 1);  // of two surfaces
  });
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.4, 0.1}, {1.7, 2.2}, {-1.0, 0.3}, {0.3, -2.0}}) {
    CAPTURE(x, y);
    const Coefficients expected = cell_average(x, y, 0.9, 1.1, field) * (0.9 * 1.1);
    const Eigen::VectorXd integral = panels.strip(y - 0.55, y + 0.55)(x - 0.45, x + 0.45);
    CHECK((integral.head<6>().array() - expected).abs().maxCoeff() < 1e-9);
    CHECK(integral.head<6>().isApprox(integral.tail<6>(), 1e-14));
  }
}

TEST_CASE("an elastic half-space answers a moving load in each direction as waves across it do",
          "[core][moving_load]") {
  // Normal compliance of an incompressible half-space for waves of speed v, e = rho v^2/G, over 1/(G k):
  // e / (4 sqrt(1 - e) - (2 - e)^2), the denominator Rayleigh's function (Achenbach 1973, section 5.11). A symbol
  // c(phi)/k has the response c(theta + pi/2)/(2 pi r).
  RollingScene scene = with_inertia(0.8);
  scene.layer_thickness = infinite;
  const double modulus = *scene.static_shear_modulus, cell = 1e-3;
  const InfluenceTable table = influence_table(scene, square_cells(cell, 12, 12));
  const auto response = [&](double x, double y) -> Coefficients {
    const double r = std::hypot(x, y), wave_speed = scene.speed * y / r;
    const double e = scene.layer_density * wave_speed * wave_speed / modulus;
    const double compliance = e < 1e-6 ? 0.5 : e / (4 * std::sqrt(1 - e) - (2 - e) * (2 - e));
    return Coefficients::Constant(compliance / (2 * M_PI * modulus * r));
  };
  for (const auto& [column, row] : {std::pair{3, 0}, {5, 2}, {-4, 4}, {2, 8}, {0, 11}, {12, 5}}) {
    CAPTURE(column, row);
    const double expected = cell_average(column * cell, row * cell, cell, cell, response)(0);
    CHECK(table(Direction::w, Direction::w, column, row) == Approx(expected).epsilon(1e-6));
  }
}

TEST_CASE("a line of moving forces is a moving line load", "[core][moving_load][long]") {
  for (const bool viscoelastic : {false, true}) {
    CAPTURE(viscoelastic);
    RollingScene scene = with_inertia(0.7);
    if (viscoelastic) {
      scene.material = MaterialModel::zener;
      scene.stiffening = 2;
      scene.creep_time = 0.01 / scene.speed;
    }
    SurfaceGrid grid = square_cells(1e-3, 20, 30);
    grid.spacing_y = 5e-3;  // 30 rows reach to where the layer is at rest
    const InfluenceTable forces = influence_table(scene, grid);
    scene.indenter = Indenter::cylinder;
    grid.rows = 1;
    const InfluenceTable line = influence_table(scene, grid);
    const double peak = *std::max_element(line.uu.begin(), line.uu.end());
    for (const Component c : {&InfluenceTable::ww, &InfluenceTable::uu, &InfluenceTable::uw})
      for (int column = -20; column <= 20; ++column) {
        double sum = 0;
        for (int row = -30; row <= 30; ++row)
          sum += (forces.*c)[static_cast<std::size_t>(forces.index(column, std::abs(row)))] * 5e-3;
        CHECK(sum == Approx((line.*c)[static_cast<std::size_t>(line.index(column, 0))]).margin(1e-5 * peak));
      }
  }
}

TEST_CASE("a moving force is one of a train far apart", "[core][moving_load][long]") {
  // A train has the exact compliance of every wave, without expansions to 1e-5; its sum is truncated, which tells at
  // the loaded cell and along the axes through it.
  RollingScene scene = with_inertia(0.5);
  scene.poisson_ratio = 0.45;
  scene.material = MaterialModel::zener;
  scene.stiffening = 2;
  scene.creep_time = 1e-3 / scene.speed;
  BondedLayer other;
  static_cast<MaterialInputs&>(other) = scene;
  other.layer_density = 1200;
  other.layer_thickness = 0.002;
  other.static_shear_modulus = 3e6;
  other.creep_time = 3e-4 / scene.speed;
  scene.lower_layers = {other};
  other.layer_thickness = 0.003;
  other.static_shear_modulus = 2e6;
  scene.coating_layers = {other};
  scene.drive = Drive::rotation;
  scene.rotation_ratio = GENERATE(1.0, -0.7);  // the coating flows backwards, its memory lies ahead
  const SurfaceGrid grid = square_cells(2e-3, 8, 8);
  const InfluenceTable passage = influence_table(scene, grid);
  scene.period = 0.15;
  scene.series_terms = 4 * 75;
  const InfluenceTable train = influence_table(scene, grid);
  const double peak = largest(passage);
  for (const Component c : all_components)
    for (int row = 2; row <= 8; ++row)
      for (int column = -8; column <= 8; ++column) {
        if (std::abs(column) < 2) continue;
        const auto i = static_cast<std::size_t>(passage.index(column, row));
        CHECK((passage.*c)[i] == Approx((train.*c)[i]).margin(1e-5 * peak));
      }
}

TEST_CASE("moving loads: a layer on a half-space of its own material is that half-space, two equal layers are one",
          "[core][moving_load][long]") {
  RollingScene half_space = with_inertia(0.6);
  half_space.material = MaterialModel::zener;
  half_space.stiffening = 4;
  half_space.creep_time = 1e-4;
  RollingScene layered = half_space;
  half_space.layer_thickness = infinite;
  BondedLayer lower;
  static_cast<MaterialInputs&>(lower) = layered;
  lower.layer_density = layered.layer_density;
  lower.layer_thickness = infinite;
  layered.lower_layers = {lower};
  const SurfaceGrid grid = square_cells(1e-3, 20, 10);
  CHECK(difference(influence_table(layered, grid), influence_table(half_space, grid)) < 1e-7);

  RollingScene one = layered;
  one.lower_layers.clear();
  layered.layer_thickness = 0.4 * one.layer_thickness;
  layered.lower_layers[0].layer_thickness = 0.6 * one.layer_thickness;
  CHECK(difference(influence_table(layered, grid), influence_table(one, grid)) < 1e-5);
}

TEST_CASE("moving loads without weight are those without inertia", "[core][moving_load]") {
  RollingScene scene = with_inertia(1e-9);
  scene.material = MaterialModel::zener;
  scene.stiffening = 9;
  scene.creep_time = 0.01 / scene.speed;
  const SurfaceGrid grid = square_cells(1e-3, 20, 10);
  const InfluenceTable with = influence_table(scene, grid);
  scene.inertia = Inertia::off;
  CHECK(difference(with, influence_table(scene, grid)) < 1e-7);
}
