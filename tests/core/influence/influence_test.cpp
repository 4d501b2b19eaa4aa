// Covers passage_quadrature, layer_tables too.

#include "core/influence/influence.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "core/influence/elastic_kernel.hpp"
#include "core/influence/passage_kernel.hpp"
#include "core/influence/periodic_kernel.hpp"
#include "core/numerics/quadrature.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

constexpr double H = 0.005, tau = 0.25;
constexpr std::array<double, 3> speeds{1e-4, 0.05, 30};

/// Zener solid of unit G'(0) with f = 1.
CreepSpectrum zener() { return {0.5, {{0.5, tau}}}; }

template <class Table>  // const or not
auto components(Table& t) {
  return std::array{&t.ww, &t.uu, &t.uw, &t.vv, &t.uv, &t.vw};
}

/// Train of period columns * cell, columns odd, from the single passage: the elastic images decay within 30 H, the
/// creeping ones behind the body are a geometric series.
InfluenceTable train(Indenter indenter, double speed, const Layer& layer, double cell, int columns, int reach_x,
                     int reach_y) {
  const PassageKernel kernel(dimension_of(indenter), layer, cell, cell, columns + reach_x, reach_y);
  const InfluenceTable passage = kernel.table(zener(), speed, columns + reach_x, reach_y);
  InfluenceTable sum(reach_x, reach_y);
  const double series = 1 / (1 - std::exp(-columns * cell / (speed * tau)));
  const auto from = components(passage);
  const auto to = components(sum);
  for (std::size_t c = 0; c < to.size(); ++c) {
    if (to[c]->empty()) continue;
    const auto at = [&](int i, int j) { return (*from[c])[static_cast<std::size_t>(passage.index(i, j))]; };
    for (int j = 0; j <= reach_y; ++j)
      for (int i = -reach_x; i <= reach_x; ++i)
        (*to[c])[static_cast<std::size_t>(sum.index(i, j))] =
            at(i, j) + at(i + columns, j) + series * at(i - columns, j);
  }
  return sum;
}

/// Sum over the wavenumbers of `aliases` whole aliases on either side.
InfluenceTable series(double speed, const Layer& layer, double cell, int columns, int aliases, int reach_x,
                      int reach_y) {
  const auto symbols = [&](double along) -> SymbolsAcross {
    return [&layer, along, j = zener()(-along * speed)](double across) -> SurfaceCompliance {
      const LayerSymbols c = layer_symbols(std::hypot(along, across), layer);
      return {j * c.normal, j * c.longitudinal, j * c.cross, j * c.transverse};
    };
  };
  return periodic_table(symbols, columns * cell, aliases * columns + (columns - 1) / 2, cell, cell, reach_x, reach_y);
}

/// Largest value of a component of table - other - (minus - its other), relative to the component in `table`.
struct Disagreement {
  double largest = 0;         // relative to the largest coefficient of the component
  double away_from_axes = 0;  // the same over nodes off both axes, without the nearest neighbours
};
Disagreement disagreement(const InfluenceTable& table, const auto& other) {
  Disagreement result;
  const auto values = components(table);
  for (std::size_t c = 0; c < values.size(); ++c) {
    if (values[c]->empty()) continue;
    double scale = 0, worst = 0, away = 0;
    for (const double value : *values[c]) scale = std::max(scale, std::abs(value));
    for (int j = 0; j <= table.reach_y(); ++j)
      for (int i = -table.reach_x(); i <= table.reach_x(); ++i) {
        const auto at = static_cast<std::size_t>(table.index(i, j));
        const double error = std::abs((*values[c])[at] - other(c, at));
        worst = std::max(worst, error);
        if (j > 2 && std::abs(i) > 2) away = std::max(away, error);
      }
    result.largest = std::max(result.largest, worst / scale);
    result.away_from_axes = std::max(result.away_from_axes, away / scale);
  }
  return result;
}

}  // namespace

TEST_CASE("influence coefficients have the symmetries of a moving layer", "[core][influence]") {
  RollingScene scene = paper_sphere();
  SurfaceGrid grid;
  grid.spacing_x = grid.spacing_y = 1e-3;
  grid.columns = 7;
  grid.rows = 5;
  const InfluenceTable table = influence_table(scene, grid);
  using enum Direction;
  for (int row = 0; row <= 4; ++row)
    for (int column = -7; column <= 7; ++column) {
      for (const Direction d : {w, u, v}) CHECK(table(d, d, column, row) == table(d, d, column, -row));
      CHECK(table(w, u, column, row) == -table(u, w, column, row));
      CHECK(table(w, v, column, row) == -table(v, w, column, row));
      CHECK(table(v, u, column, row) == table(u, v, column, row));
      CHECK(table(u, w, column, row) == table(u, w, column, -row));
      if (row > 0) CHECK(table(u, v, column, row) == -table(u, v, column, -row));
      if (row > 0) CHECK(table(v, w, column, row) == -table(v, w, column, -row));
    }
  // The body leaves a trace behind itself, not ahead; a glassy or rubbery layer is even along x.
  CHECK(std::abs(table(w, w, -3)) > std::abs(table(w, w, 3)));
  scene.material = MaterialModel::elastic;
  const InfluenceTable elastic = influence_table(scene, grid);
  for (int column = 0; column <= 7; ++column) {
    CHECK(elastic(w, w, -column, 2) == elastic(w, w, column, 2));
    CHECK(elastic(u, w, -column, 2) + elastic(u, w, column, 2) == 0);
    CHECK(elastic(u, v, -column, 2) + elastic(u, v, column, 2) == 0);
  }
}

TEST_CASE("a single passage and the sum over wavenumbers agree on what the thickness changes, at any speed",
          "[core][influence]") {
  // High wavenumbers do not see the base, so the difference of two thicknesses has a short, complete series.
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere})
    for (const double speed : speeds) {
      for (const double nu : {0.5, 0.3, 0.0}) {
        const bool sphere = indenter == Indenter::sphere;
        const double cell = 0.5 * H;
        const int columns = 91, reach_x = 10, reach_y = sphere ? 10 : 0;
        const InfluenceTable thick = train(indenter, speed, {1.25 * H, nu}, cell, columns, reach_x, reach_y);
        const InfluenceTable thin = train(indenter, speed, {H, nu}, cell, columns, reach_x, reach_y);
        const InfluenceTable thick_series = series(speed, {1.25 * H, nu}, cell, columns, 1, reach_x, reach_y);
        const InfluenceTable thin_series = series(speed, {H, nu}, cell, columns, 1, reach_x, reach_y);
        const auto a = components(thin), b = components(thick_series), c = components(thin_series);
        const Disagreement error = disagreement(thick, [&](std::size_t component, std::size_t at) {
          return (*a[component])[at] + (*b[component])[at] - (*c[component])[at];
        });
        INFO(name_of(indenter) << " at " << speed << " m/s, nu = " << nu);
        // What the kernel's tables of the layer's correction promise.
        CHECK(error.largest < 1e-8);
      }
    }
}

TEST_CASE("a single passage under a cylinder equals the sum over wavenumbers, at any speed", "[core][influence]") {
  const double cell = H / 20;
  const int columns = 1201, reach = 100, aliases = 150;
  for (const double speed : speeds) {
    const InfluenceTable passage = train(Indenter::cylinder, speed, H, cell, columns, reach, 0);
    const InfluenceTable last = series(speed, H, cell, columns, aliases, reach, 0);
    const InfluenceTable before = series(speed, H, cell, columns, aliases - 1, reach, 0);
    const auto a = components(last), b = components(before);
    // Aliases alternate in sign and fall with their square, so the mean of two sums errs by the cube.
    const Disagreement error = disagreement(passage, [&](std::size_t component, std::size_t at) {
      return 0.5 * ((*a[component])[at] + (*b[component])[at]);
    });
    INFO("speed " << speed);
    CHECK(error.largest < 1e-8);
  }
}

TEST_CASE("a single passage under a sphere equals the sum over wavenumbers, at any speed", "[core][influence]") {
  const double cell = H / 2;
  const int columns = 91, reach = 9;
  for (const double speed : speeds) {
    const InfluenceTable passage = train(Indenter::sphere, speed, H, cell, columns, reach, reach);
    std::array<Disagreement, 2> errors;
    for (const int doubled : {0, 1}) {
      const int aliases = doubled ? 6 : 3;
      const InfluenceTable last = series(speed, H, cell, columns, aliases, reach, reach);
      const InfluenceTable before = series(speed, H, cell, columns, aliases - 1, reach, reach);
      const auto a = components(last), b = components(before);
      errors[static_cast<std::size_t>(doubled)] = disagreement(passage, [&](std::size_t component, std::size_t at) {
        return 0.5 * ((*a[component])[at] + (*b[component])[at]);
      });
    }
    INFO("speed " << speed);
    // The corners of the square of wavenumbers do not alternate: what they leave near the loaded cell falls only with
    // the cube of the aliases, of the order of 0.02/6^3 here, and is far smaller away from the axes.
    CHECK(errors[1].largest < 2e-4);
    CHECK(errors[1].largest < 0.3 * errors[0].largest);
    CHECK(errors[1].away_from_axes < 2e-5);
  }
}

TEST_CASE("the recursion along a row is the fading memory of the elastic kernel", "[core][influence]") {
  const QuadratureRule gauss = gauss_legendre(16);
  const double cell = 1e-3;
  for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere})
    for (const double thickness : {2e-3, std::numeric_limits<double>::infinity()}) {
      const bool sphere = indenter == Indenter::sphere;
      const ElasticKernel elastic(dimension_of(indenter), thickness, cell, cell);
      const PassageKernel kernel(dimension_of(indenter), thickness, cell, cell, 12, sphere ? 3 : 0);
      for (const double memory : {0.01 * cell, 0.4 * cell, 7 * cell, 500 * cell}) {
        const InfluenceTable table = kernel.table({0, {{1, 1}}}, memory, 12, sphere ? 3 : 0);
        for (const int row : sphere ? std::vector<int>{0, 2} : std::vector<int>{0})
          for (const int column : {-9, -1, 0, 1, 5}) {
            // int_0^inf e^{-s/T}/T K(x + s) ds, pieces graded towards the edges of the cell, the start and the end
            const double x = column * cell;
            std::vector<double> breaks{x};
            for (const double edge : {-0.5 * cell, 0.5 * cell})
              if (edge > x) breaks.push_back(edge);
            // The response of a layer ends at its reach.
            breaks.push_back(std::min(x + 45 * memory, std::isinf(thickness) ? 1e9 : elastic.scales().reach()));
            Coefficients sum = Coefficients::Zero();
            const auto piece = [&](double from, double to) {
              for (std::size_t q = 0; q < gauss.nodes.size(); ++q) {
                const double at = from + (to - from) * gauss.nodes[q];
                sum += (to - from) * gauss.weights[q] * std::exp((x - at) / memory) / memory * elastic(at, row * cell);
              }
            };
            for (std::size_t b = 0; b + 1 < breaks.size(); ++b) {
              const double from = breaks[b], to = breaks[b + 1], length = to - from;
              if (!(length > 0) || from > x + 45 * memory) continue;
              for (double width = 0.5 * length; width > 1e-12 * length; width *= 0.5)
                for (const int part : {0, 1}) {
                  piece(from + 0.5 * width * (1 + 0.5 * part), from + 0.5 * width * (1.5 + 0.5 * part));
                  piece(to - 0.5 * width * (1.5 + 0.5 * part), to - 0.5 * width * (1 + 0.5 * part));
                }
            }
            using enum Direction;
            INFO(name_of(indenter) << " H " << thickness << " T " << memory << " column " << column << " row " << row);
            // Interpolation of K between the nodes of the rules, relative to the response of the loaded cell
            const double tolerance = 1e-8 * elastic(0, 0)(coefficient::ww);
            CHECK(std::abs(table(w, w, column, row) - sum(coefficient::ww)) < tolerance);
            CHECK(std::abs(table(u, u, column, row) - sum(coefficient::uu)) < tolerance);
            CHECK(std::abs(table(u, w, column, row) - sum(coefficient::uw)) < tolerance);
            if (!sphere) continue;
            CHECK(std::abs(table(v, v, column, row) - sum(coefficient::vv)) < tolerance);
            CHECK(std::abs(table(u, v, column, row) - sum(coefficient::uv)) < tolerance);
            CHECK(std::abs(table(v, w, column, row) - sum(coefficient::vw)) < tolerance);
          }
      }
    }
}

TEST_CASE("the layer is rubbery under a slow body and glassy under a fast one", "[core][influence]") {
  for (RollingScene scene : {paper_cylinder(), paper_sphere()}) {
    SurfaceGrid grid;
    grid.spacing_x = grid.spacing_y = 0.5e-3;
    grid.columns = 15;
    grid.rows = scene.indenter == Indenter::sphere ? 9 : 1;
    const double f = scene.stiffening;
    const auto coefficients = [&](double speed, bool elastic) {
      scene.speed = speed;
      scene.material = elastic ? MaterialModel::elastic : MaterialModel::zener;
      return influence_table(scene, grid);
    };
    const InfluenceTable elastic = coefficients(1, true);
    const double slow_speed = 1e-9, fast_speed = 1e7;
    const InfluenceTable slow = coefficients(slow_speed, false), fast = coefficients(fast_speed, false);
    const double cell = grid.spacing_x, scale = elastic(Direction::w, Direction::w, 0);
    using enum Direction;
    for (int row = 0; row <= elastic.reach_y(); ++row)
      for (int column = -15; column <= 15; ++column)
        for (const auto& [d, e] : {std::pair{w, w}, {u, u}, {u, w}}) {
          // K(x) + V tau f/(1+f) K'(x): the slope is at most a few values per cell.
          CHECK(std::abs(slow(d, e, column, row) - elastic(d, e, column, row)) <
                10 * slow_speed * scene.creep_time / cell * scale);
          // What creeps under way is int K ds / (V tau), over a few thicknesses.
          CHECK(std::abs(fast(d, e, column, row) - elastic(d, e, column, row) / (1 + f)) <
                10 * scene.layer_thickness / (fast_speed * scene.creep_time) * scale);
        }
  }
}
