#include "core/interior/axial_field.hpp"

#include <cmath>

#include "core/interior/interior_field.hpp"
#include "core/interior/interior_lines.hpp"
#include "core/numerics/quadrature.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

constexpr double shear = 0.8, cell = 0.5, speed = 1.3;

/// One cell with a uniform traction along the axle.
SurfaceFields sheared_cell() {
  SurfaceFields fields;
  fields.grid = {.spacing_x = cell, .spacing_y = 1, .columns = 1, .rows = 1};
  fields.pressure = {1};
  fields.shear_x = {0};
  fields.shear_y = {shear};
  fields.zone = {Zone::slip};
  return fields;
}

const CreepSpectrum upper{.instantaneous = 1e-6, .terms = {{2e-6, 0.7}}};
const CreepSpectrum lower{.instantaneous = 2e-6, .terms = {{1e-6, 3.0}, {5e-7, 0.1}}};

InteriorField inside_layers(const LayeredMedium& medium) {
  return InteriorField(medium, speed, 1, sheared_cell(), 3, InteriorField::Detail::surface);
}

/// V int k |q|^2 Im c_tt dk/pi, the power lost by what the surface does; around a ring the sum over whole harmonics.
double loss_at_surface(const LayeredMedium& medium) {
  constexpr double highest = 2000;
  double loss = 0;
  const auto add = [&](double k, double weight) {
    const double half = 0.5 * k * cell, traction = shear * cell * std::sin(half) / half;
    loss += weight * speed / M_PI * k * traction * traction *
            surface_compliance(medium, moduli_at(medium, -k * speed), k, 0).transverse.imag();
  };
  if (const double radius = medium.front().radius; std::isfinite(radius)) {
    for (int n = 1; n < highest * radius; ++n) add(n / radius, 1 / radius);
    return loss;
  }
  const QuadratureRule& rule = gauss_rule(24);
  for (double from = 0, to = 1e-3; from < highest; from = to, to += std::min(to, 4.0))
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
      add(from + (to - from) * rule.nodes[i], (to - from) * rule.weights[i]);
  return loss;
}

double loss_in_depth(const LayeredMedium& medium) {
  const std::vector<WeightedLine> weighted = lines_across(medium, speed, 0.5 * cell, 6);
  SurfaceFields alone = sheared_cell();
  alone.pressure = {0};
  const InteriorField field(medium, speed, 1, alone, 0, InteriorField::Detail::surface);
  std::vector<InteriorLine> lines;
  for (const WeightedLine& line : weighted) lines.push_back(line.line);
  const VolumeFields f = field.at({}, lines);
  double loss = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) loss += weighted[i].weight * f.line_loss(static_cast<Eigen::Index>(i));
  return loss;
}

}  // namespace

TEST_CASE("below a cell with a traction along the axle a half-space has the antiplane shear of the logarithm",
          "[core][interior][skew]") {
  const InteriorField field = inside_layers({{INFINITY, 0.3, 0, upper}});
  const std::vector<double> x{-0.9, -0.2, 0, 0.24, 0.26, 1.4};
  for (const double depth : {0.02, 0.2, 1.5}) {
    const VolumeFields f = field.at(x, {{0, depth}});
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double left = x[i] + 0.5 * cell, right = x[i] - 0.5 * cell;
      const auto at = static_cast<Eigen::Index>(i);
      INFO("x = " << x[i] << ", depth " << depth);
      CHECK(f.stress_of(Component::yz)(at, 0) ==
            Approx(shear / M_PI * (std::atan(left / depth) - std::atan(right / depth))).margin(2e-5));
      CHECK(f.stress_of(Component::xy)(at, 0) ==
            Approx(-shear / (2 * M_PI) * std::log((depth * depth + left * left) / (depth * depth + right * right)))
                .margin(2e-5));
    }
  }
}

TEST_CASE("what shear along the axle loses in the depth of layers and rings is what their surface takes up",
          "[core][interior][skew]") {
  // Of rings the surface goes by ring_compliance, the depth by flat layers in the logarithm of the radius.
  for (const double radius : {static_cast<double>(INFINITY), 1.0}) {
    const LayeredMedium medium{{0.2, 0.3, 0, upper, radius}, {0.25, 0.45, 0, lower, radius - 0.2}};
    CHECK(loss_in_depth(medium) == Approx(loss_at_surface(medium)).epsilon(1e-5));
  }
}

TEST_CASE("in layers and rings shear along the axle balances, strains are those of the displacement, and losses add up",
          "[core][interior][skew]") {
  const LayeredMedium layers{{0.8, 0.3, 0, upper}, {1.1, 0.45, 0, lower}};
  constexpr double h = 1e-3;
  const VolumeFields f = inside_layers(layers).at({0.4 - h, 0.4, 0.4 + h}, {{1, 0.5 + h}, {1, 0.5}, {1, 0.5 - h}});
  const auto along = [&](const Eigen::ArrayXXd& a) { return (a(2, 1) - a(0, 1)) / (2 * h); };
  const auto up = [&](const Eigen::ArrayXXd& a) { return (a(1, 2) - a(1, 0)) / (2 * h); };
  CHECK(std::abs(along(f.stress_of(Component::xy)) + up(f.stress_of(Component::yz))) <
        1e-5 * std::abs(along(f.stress_of(Component::xy))));
  CHECK(along(f.v) == Approx(f.strain_of(Component::xy)(1, 1)).epsilon(1e-5));
  CHECK(up(f.v) == Approx(f.strain_of(Component::yz)(1, 1)).epsilon(1e-5));
  const VolumeFields faces = inside_layers(layers).at({0.1, 0.4}, {{0, 0.8}, {1, 0}, {1, 1.1}});
  for (Eigen::Index i = 0; i < 2; ++i) {
    CHECK(faces.v(i, 0) == Approx(faces.v(i, 1)).epsilon(1e-9));
    CHECK(faces.stress_of(Component::yz)(i, 0) == Approx(faces.stress_of(Component::yz)(i, 1)).epsilon(1e-9));
    CHECK(std::abs(faces.v(i, 2)) < 1e-12 * std::abs(faces.v(i, 0)));
  }
  std::vector<double> x;
  for (int i = 0; i <= 1600; ++i) x.push_back(-26 + 0.02 * i);
  SurfaceFields alone = sheared_cell();
  alone.pressure = {0};
  const InteriorField field(layers, speed, 1, alone, 26, InteriorField::Detail::surface);
  const VolumeFields density = field.at(x, {{0, 0.3}, {1, 0.4}}, InteriorField::Wanted::density);
  for (Eigen::Index line = 0; line < 2; ++line) {
    CHECK(density.loss_density.col(line).minCoeff() >= 0);
    CHECK(0.02 * density.loss_density.col(line).sum() == Approx(density.line_loss(line)).epsilon(1e-3));
  }
}
