#include "core/interior/interior_field.hpp"

#include <cmath>

#include "core/numerics/solution_limits.hpp"
#include "core/reference/reference_inside.hpp"
#include "tests/catch.hpp"

// Covers surface_tractions, depth_response, waves_inside and reference_inside, too.

using namespace rollres;

namespace {

using Detail = InteriorField::Detail;

/// sqrt(1 - x^2/a^2) times a pressure and a shear, as a spectral solution hands it over.
SurfaceFields hertz_tractions(double pressure, double shear, double half_width = 1) {
  constexpr int last = 20;
  TractionPanel panel{-half_width, half_width, {}, {}};
  for (int k = 0; k <= last; ++k) {
    const double share = std::cos(M_PI_2 * std::cos(M_PI * k / last));  // x/a = sin(pi s/2)
    panel.pressure.push_back(pressure * share);
    panel.shear.push_back(shear * share);
  }
  SurfaceFields fields;
  fields.panels = {panel};
  return fields;
}

/// One cell with uniform tractions, as a grid hands it over.
SurfaceFields one_cell(double pressure, double shear, double width) {
  SurfaceFields fields;
  fields.grid = {.spacing_x = width, .spacing_y = 1, .columns = 1, .rows = 1};
  fields.pressure = {pressure};
  fields.shear_x = {shear};
  fields.zone = {Zone::stick};
  return fields;
}

const CreepSpectrum elastic{.instantaneous = 1e-6, .terms = {}};
const CreepSpectrum zener{.instantaneous = 1e-6, .terms = {{2e-6, 0.7}}};

LayeredMedium one_layer(double thickness, double poisson_ratio, const CreepSpectrum& material) {
  return {{thickness, poisson_ratio, 0, material}};
}

}  // namespace

TEST_CASE("stresses below a Hertz line contact are McEwen's, from its surface down", "[core][interior]") {
  const InteriorField field(one_layer(INFINITY, 0.5, zener), 1.3, 1, hertz_tractions(2, 0), 3, Detail::surface);
  const std::vector<double> x{-1.4, -0.6, 0, 0.3, 0.999, 2.5};
  for (const double depth : {1e-4, 0.01, 0.1, 0.12, 0.14, 0.786, 3.0}) {
    const VolumeFields f = field.at(x, {{0, depth}});
    for (std::size_t i = 0; i < x.size(); ++i) {
      const InsideStress expected = hertz_line_inside(1, 2, x[i], depth);
      const auto at = static_cast<Eigen::Index>(i);
      INFO("x = " << x[i] << ", depth " << depth);
      CHECK(std::abs(f.stress_of(Component::x)(at, 0) - expected.x) < 2e-7 * 2);
      CHECK(std::abs(f.stress_of(Component::z)(at, 0) - expected.z) < 2e-7 * 2);
      CHECK(std::abs(f.stress_of(Component::xz)(at, 0) - expected.xz) < 2e-7 * 2);
    }
  }
}

TEST_CASE("below a cell with uniform tractions stresses are the mean of Flamant's over it", "[core][interior]") {
  const double width = 0.02;
  const InteriorField field(one_layer(INFINITY, 0.3, elastic), 1, 1, one_cell(5 / width, 3 / width, width), 2,
                            Detail::inside);
  for (const double depth : {0.5, 1.0}) {
    const VolumeFields f = field.at({-1, 0.5, 2}, {{0, depth}});
    for (const auto& [i, x] : {std::pair<Eigen::Index, double>{0, -1}, {1, 0.5}, {2, 2}}) {
      InsideStress mean{};  // by Simpson's rule
      for (const auto& [place, weight] : {std::pair{-0.5, 1.0 / 6}, {0.0, 4.0 / 6}, {0.5, 1.0 / 6}}) {
        const InsideStress one = flamant_inside(5, 3, x - place * width, depth);
        mean = {mean.x + weight * one.x, mean.z + weight * one.z, mean.xz + weight * one.xz};
      }
      CHECK(std::abs(f.stress_of(Component::x)(i, 0) - mean.x) < 1e-6 * 5);
      CHECK(std::abs(f.stress_of(Component::z)(i, 0) - mean.z) < 1e-6 * 5);
      CHECK(std::abs(f.stress_of(Component::xz)(i, 0) - mean.xz) < 1e-6 * 5);
    }
  }
}

TEST_CASE("a layer has its tractions at the surface and no displacement at its base", "[core][interior]") {
  for (const double poisson_ratio : {0.5, 0.3, 0.0}) {
    const double thickness = 1.7;
    const InteriorField field(one_layer(thickness, poisson_ratio, zener), 1.3, 1, hertz_tractions(2, 0.5), 3,
                              Detail::surface);
    const std::vector<double> x{-2, -0.7, 0.2, 0.9, 1.5};
    const VolumeFields f = field.at(x, {{0, 0}, {0, thickness}});
    const double size = f.w.col(0).abs().maxCoeff();
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      const double root = std::sqrt(std::max(1 - x[i] * x[i], 0.0));
      CHECK(std::abs(f.stress_of(Component::z)(at, 0) + 2 * root) < 1e-6);
      CHECK(std::abs(f.stress_of(Component::xz)(at, 0) - 0.5 * root) < 1e-6);
      CHECK(std::abs(f.u(at, 1)) < 1e-12 * size);
      CHECK(std::abs(f.w(at, 1)) < 1e-12 * size);
      CHECK(std::abs(f.strain_of(Component::x)(at, 1)) < 1e-12 * f.strain_of(Component::x).abs().maxCoeff());
    }
  }
}

TEST_CASE("inside two bonded layers forces balance, and strains are those of the displacements", "[core][interior]") {
  const LayeredMedium medium{{0.8, 0.45, 0, zener}, {1.1, 0.3, 0, {.instantaneous = 3e-7, .terms = {{4e-7, 0.2}}}}};
  const InteriorField field(medium, 1.3, 1, hertz_tractions(2, 0.5), 3, Detail::surface);
  const double h = 0.01;  // differences of fourth order
  std::vector<double> x;
  for (int i = -2; i <= 2; ++i) x.push_back(0.4 + i * h);
  const auto slope = [&](const auto& values) {
    return (values(0) - 8 * values(1) + 8 * values(3) - values(4)) / (12 * h);
  };
  for (const auto& [layer, depth] : {std::pair<std::size_t, double>{0, 0.3}, {0, 0.7}, {1, 0.1}, {1, 0.9}}) {
    std::vector<InteriorLine> lines;  // z rising
    for (int i = -2; i <= 2; ++i) lines.push_back({layer, depth - i * h});
    const VolumeFields f = field.at(x, lines);
    const auto along = [&](const Eigen::ArrayXXd& values) { return slope(values.col(2)); };
    const auto up = [&](const Eigen::ArrayXXd& values) { return slope(values.row(2)); };
    CHECK(std::abs(along(f.stress_of(Component::x)) + up(f.stress_of(Component::xz))) < 1e-6);
    CHECK(std::abs(along(f.stress_of(Component::xz)) + up(f.stress_of(Component::z))) < 1e-6);
    const double strain = f.strain_of(Component::xz).abs().maxCoeff();
    CHECK(std::abs(along(f.u) - f.strain_of(Component::x)(2, 2)) < 1e-6 * strain);
    CHECK(std::abs(up(f.w) - f.strain_of(Component::z)(2, 2)) < 1e-6 * strain);
    CHECK(std::abs(up(f.u) + along(f.w) - f.strain_of(Component::xz)(2, 2)) < 1e-6 * strain);
  }
  const VolumeFields f = field.at(x, {{0, 0.8}, {1, 0}});
  CHECK(std::abs(f.u(2, 0) - f.u(2, 1)) < 1e-12 * std::abs(f.w(2, 0)));
  CHECK(std::abs(f.stress_of(Component::z)(2, 0) - f.stress_of(Component::z)(2, 1)) < 1e-12 * 2);
  CHECK(std::abs(f.stress_of(Component::xz)(2, 0) - f.stress_of(Component::xz)(2, 1)) < 1e-12 * 2);
}

TEST_CASE("the transforms of tractions end with the time that a solution may take", "[core][interior]") {
  // A contact over many thicknesses has as many waves. Where the time was not asked for within them they were all made.
  const SurfaceTractions tractions(hertz_tractions(2, 0.5), 1e3);
  const SolutionLimits limits(1e9, 0);
  // The clock is asked a hundred times a second.
  CHECK_THROWS_AS(tractions.transforms({0.01}, 1e-3, 1000000), BeyondLimits);
  const auto one_by_one = [&] {
    for (int i = 0; i < 1000000; ++i) tractions.transforms(0.01);
  };
  CHECK_THROWS_AS(one_by_one(), BeyondLimits);
}

TEST_CASE("transforms of tractions at wavenumbers a step apart are those of each wavenumber", "[core][interior]") {
  constexpr double highest = 60, step = 0.7;
  const std::vector<double> firsts{0.01, 1.3};
  for (const SurfaceFields& fields : {hertz_tractions(2, 0.5), one_cell(2, 0.5, 0.3)}) {
    const SurfaceTractions tractions(fields, highest);
    const auto together = tractions.transforms(firsts, step, 80);
    REQUIRE(together.size() == firsts.size());
    for (std::size_t i = 0; i < firsts.size(); ++i) {
      REQUIRE(together[i].size() == 80);
      for (std::size_t j = 0; j < together[i].size(); ++j) {
        const auto alone = tractions.transforms(firsts[i] + step * static_cast<double>(j));
        // 1e-10 of the load is what the rules of few points leave.
        CHECK(std::abs(together[i][j].pressure - alone.pressure) < 1e-9 * M_PI);
        CHECK(std::abs(together[i][j].shear - alone.shear) < 1e-9 * M_PI);
      }
    }
  }
}

TEST_CASE("a layer cut in two of one material is the same layer", "[core][interior]") {
  const InteriorField whole(one_layer(1.5, 0.5, zener), 1.3, 1, hertz_tractions(2, 0.5), 3, Detail::surface);
  const InteriorField cut({{0.6, 0.5, 0, zener}, {0.9, 0.5, 0, zener}}, 1.3, 1, hertz_tractions(2, 0.5), 3,
                          Detail::surface);
  const VolumeFields one = whole.at({-0.5, 0.7}, {{0, 0.3}, {0, 1.1}}), two = cut.at({-0.5, 0.7}, {{0, 0.3}, {1, 0.5}});
  CHECK((one.stress_of(Component::x) - two.stress_of(Component::x)).abs().maxCoeff() < 1e-8);
  CHECK((one.strain_of(Component::xz) - two.strain_of(Component::xz)).abs().maxCoeff() <
        1e-8 * one.strain_of(Component::xz).abs().maxCoeff());
  CHECK(two.line_loss(0) == Approx(one.line_loss(0)).epsilon(1e-9));
  CHECK(two.line_loss(1) == Approx(one.line_loss(1)).epsilon(1e-9));
}

TEST_CASE("the density of the loss, along a line of flow, sums to the line's loss", "[core][interior]") {
  // Memories of 0.05 and 0.4 half-widths: they end inside the section.
  const CreepSpectrum material{.instantaneous = 1e-6, .terms = {{1e-6, 0.05}, {2e-6, 0.4}}};
  const InteriorField field(one_layer(1, 0.4, material), 1, 1, hertz_tractions(2, 0.5), 9, Detail::surface);
  std::vector<double> x;
  for (int i = 0; i <= 1800; ++i) x.push_back(-9 + 0.01 * i);
  const VolumeFields f = field.at(x, {{0, 0.25}, {0, 0.9}}, InteriorField::Wanted::density);
  for (const Eigen::Index line : {0, 1}) {
    CHECK(f.loss_density.col(line).minCoeff() >= 0);
    CHECK(0.01 * f.loss_density.col(line).sum() == Approx(f.line_loss(line)).epsilon(1e-4));  // step squared
  }
}
