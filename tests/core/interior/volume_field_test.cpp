#include "core/interior/volume_field.hpp"

#include <cmath>

#include "core/interior/interior_lines.hpp"
#include "core/reference/reference_inside.hpp"
#include "tests/catch.hpp"

// Covers interior_waves and transverse_response, too.

using namespace rollres;

namespace {

using Detail = VolumeField::Detail;
using Wanted = VolumeField::Wanted;

constexpr double width = 0.7;  // of the tractions' bell [m]

double bell(double x, double y) { return std::exp(-(x * x + y * y) / (width * width)); }

/// Bells of pressure and of shear along x, and a shear along y that is odd in y, as a grid hands them over. They vanish
/// to rounding at its edge, and waves of two cells hold nothing of them.
SurfaceFields bell_tractions(double pressure, double shear_x, double shear_y = 0) {
  constexpr int across = 41;
  SurfaceFields fields;
  fields.grid = {.spacing_x = 0.2,
                 .spacing_y = 0.2,
                 .first_column = -across / 2,
                 .first_row = -across / 2,
                 .columns = across,
                 .rows = across};
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < across; ++i) {
      const double x = fields.grid.x(i), y = fields.grid.y(j);
      fields.pressure.push_back(pressure * bell(x, y));
      fields.shear_x.push_back(shear_x * bell(x, y));
      fields.shear_y.push_back(shear_y * y / width * bell(x, y));
      fields.zone.push_back(Zone::stick);
    }
  return fields;
}

const CreepSpectrum quick{.instantaneous = 1e-6, .terms = {{2e-6, 0.7}}};
const CreepSpectrum slow{.instantaneous = 2e-6, .terms = {{1e-6, 3.0}, {5e-7, 0.1}}};

LayeredMedium two_layers() { return {{0.8, 0.3, 0, quick}, {1.1, 0.45, 0, slow}}; }

double at(const std::array<Eigen::ArrayXXd, components>& tensor, Component c, Eigen::Index x, Eigen::Index place) {
  return tensor[static_cast<std::size_t>(c)](x, place);
}

constexpr std::array all{Component::x, Component::y, Component::z, Component::yz, Component::xz, Component::xy};

}  // namespace

TEST_CASE("stresses below bells of pressure and shear are sums of Boussinesq's and Cerruti's", "[core][interior]") {
  constexpr double pressure = 2, shear = 0.8, nu = 0.3, step = 0.08;
  const VolumeField field({{INFINITY, nu, 0, quick}}, 1.3, 1, bell_tractions(pressure, shear), Detail::surface);
  const std::vector<double> x{-1.1, 0.013, 0.9}, y{0.017, 0.8};
  const std::vector<double> depths{0.6, 1.3};
  const VolumeFields f = field.at(x, y, {{0, depths[0]}, {0, depths[1]}}, Wanted::all);
  for (std::size_t line = 0; line < depths.size(); ++line)
    for (std::size_t j = 0; j < y.size(); ++j)
      for (std::size_t i = 0; i < x.size(); ++i) {
        // By points at half steps, which a bell's sum needs no finer.
        std::array<double, components> sum{};
        constexpr int reach = 56;
        for (int m = -reach; m < reach; ++m)
          for (int n = -reach; n < reach; ++n) {
            const double s = step * (m + 0.5), t = step * (n + 0.5), force = bell(s, t) * step * step;
            const VolumeStress p =
                point_forces_inside(pressure * force, shear * force, nu, x[i] - s, y[j] - t, depths[line]);
            const std::array<double, components> parts{p.x, p.y, p.z, p.yz, p.xz, p.xy};
            for (std::size_t c = 0; c < components; ++c) sum[c] += parts[c];
          }
        INFO("x = " << x[i] << ", y = " << y[j] << ", depth " << depths[line]);
        for (const Component c : all)
          CHECK(std::abs(at(f.stress, c, static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(line * y.size() + j)) -
                         sum[static_cast<std::size_t>(c)]) < 1e-6 * pressure);
      }
}

TEST_CASE(
    "under layers that differ stresses balance, strains are those of the displacements, and all fits at the bond, "
    "the surface and the base",
    "[core][interior]") {
  const VolumeField field(two_layers(), 1.3, 1, bell_tractions(2, 0.8, 0.5), Detail::surface);
  constexpr double h = 1e-3;
  for (const InteriorLine& line : {InteriorLine{0, 0.35}, InteriorLine{1, 0.5}}) {
    const double x0 = -0.4, y0 = 0.3;
    const VolumeFields f = field.at({x0 - h, x0, x0 + h}, {y0 - h, y0, y0 + h},
                                    {{line.layer, line.depth + h}, line, {line.layer, line.depth - h}}, Wanted::all);
    // By central differences; depths in the order in which z rises.
    const auto value = [](const Eigen::ArrayXXd& a, int x, int y, int z) { return a(x, z * 3 + y); };
    const auto along = [&](const Eigen::ArrayXXd& a, int axis) {
      const int x = axis == 0, y = axis == 1, z = axis == 2;
      return (value(a, 1 + x, 1 + y, 1 + z) - value(a, 1 - x, 1 - y, 1 - z)) / (2 * h);
    };
    const auto stress = [&](Component c) { return f.stress_of(c); };
    const auto strain = [&](Component c) { return value(f.strain_of(c), 1, 1, 1); };
    const double slope = std::abs(along(stress(Component::z), 2)) + std::abs(along(stress(Component::xz), 2));
    CHECK(std::abs(along(stress(Component::x), 0) + along(stress(Component::xy), 1) + along(stress(Component::xz), 2)) <
          1e-5 * slope);
    CHECK(std::abs(along(stress(Component::xy), 0) + along(stress(Component::y), 1) + along(stress(Component::yz), 2)) <
          1e-5 * slope);
    CHECK(std::abs(along(stress(Component::xz), 0) + along(stress(Component::yz), 1) + along(stress(Component::z), 2)) <
          1e-5 * slope);
    const double size = std::abs(strain(Component::x)) + std::abs(strain(Component::z));
    CHECK(std::abs(along(f.u, 0) - strain(Component::x)) < 1e-5 * size);
    CHECK(std::abs(along(f.v, 1) - strain(Component::y)) < 1e-5 * size);
    CHECK(std::abs(along(f.w, 2) - strain(Component::z)) < 1e-5 * size);
    CHECK(std::abs(along(f.v, 2) + along(f.w, 1) - strain(Component::yz)) < 1e-5 * size);
    CHECK(std::abs(along(f.u, 2) + along(f.w, 0) - strain(Component::xz)) < 1e-5 * size);
    CHECK(std::abs(along(f.u, 1) + along(f.v, 0) - strain(Component::xy)) < 1e-5 * size);
  }
  const std::vector<double> x{-0.4, 0.2}, y{0.2, 0.6};
  const VolumeFields faces = field.at(x, y, {{0, 0}, {0, 0.8}, {1, 0}, {1, 1.1}}, Wanted::all);
  for (Eigen::Index i = 0; i < 2; ++i)
    for (Eigen::Index j = 0; j < 2; ++j) {
      const double here = bell(x[static_cast<std::size_t>(i)], y[static_cast<std::size_t>(j)]);
      CHECK(at(faces.stress, Component::z, i, j) == Approx(-2 * here).epsilon(1e-6));
      CHECK(at(faces.stress, Component::xz, i, j) == Approx(0.8 * here).epsilon(1e-6));
      CHECK(at(faces.stress, Component::yz, i, j) ==
            Approx(0.5 * y[static_cast<std::size_t>(j)] / width * here).epsilon(1e-6));
      for (const Component c : {Component::z, Component::yz, Component::xz})
        CHECK(at(faces.stress, c, i, 2 + j) == Approx(at(faces.stress, c, i, 4 + j)).margin(1e-9));
      CHECK(faces.u(i, 2 + j) == Approx(faces.u(i, 4 + j)).epsilon(1e-9));
      CHECK(faces.v(i, 2 + j) == Approx(faces.v(i, 4 + j)).epsilon(1e-9));
      CHECK(std::abs(faces.u(i, 6 + j)) < 1e-12 * std::abs(faces.u(i, j)));
      CHECK(std::abs(faces.w(i, 6 + j)) < 1e-12 * std::abs(faces.w(i, j)));
    }
}

TEST_CASE(
    "the density of the loss adds up along a line of flow, lines to a depth, and backward flow is the mirror image",
    "[core][interior]") {
  const SurfaceFields tractions = bell_tractions(2, 0);
  const VolumeField field(two_layers(), 1.3, 1, tractions, Detail::surface);
  std::vector<double> x, y;
  for (int i = 0; i <= 1600; ++i) x.push_back(-26 + 0.02 * i);
  for (int j = 0; j <= 90; ++j) y.push_back(0.15 * j);
  const std::vector<InteriorLine> lines{{0, 0.3}, {1, 0.4}};
  const VolumeFields f = field.at(x, {0, 0.5}, lines, Wanted::density);
  for (Eigen::Index place = 0; place < 4; ++place) {
    CHECK(f.loss_density.col(place).minCoeff() >= 0);
    CHECK(0.02 * f.loss_density.col(place).sum() == Approx(f.line_loss(place)).epsilon(1e-3));  // a tail is cut
  }
  const VolumeFields across = field.at({}, y, lines, Wanted::strains);
  for (Eigen::Index line = 0; line < 2; ++line) {
    const auto all_y = across.line_loss.segment(line * 91, 91);
    CHECK(0.3 * (all_y.sum() - 0.5 * all_y(0)) == Approx(across.plane_loss(line)).epsilon(1e-6));
  }
  const VolumeField back(two_layers(), 1.3, -1, tractions, Detail::surface);
  const VolumeFields there = back.at({-0.6, 0.4}, {0.3}, lines, Wanted::all);
  const VolumeFields here = field.at({-0.4, 0.6}, {0.3}, lines, Wanted::all);
  for (Eigen::Index line = 0; line < 2; ++line)
    for (Eigen::Index i = 0; i < 2; ++i) {
      CHECK(at(there.strain, Component::z, i, line) ==
            Approx(at(here.strain, Component::z, 1 - i, line)).epsilon(1e-9));
      CHECK(at(there.strain, Component::xz, i, line) ==
            Approx(-at(here.strain, Component::xz, 1 - i, line)).epsilon(1e-9));
    }
}

TEST_CASE("a contact beside the middle has the inside of one in the middle", "[core][interior]") {
  // Moved by two rows it is no longer its own mirror image: both parts of the tractions are needed, with their signs.
  constexpr int rows = 2;
  const SurfaceFields middle = bell_tractions(2, 0.8, 0.5);
  SurfaceFields moved = middle;
  moved.grid.first_row += rows;
  CHECK(is_mirror_image(middle));
  CHECK_FALSE(is_mirror_image(moved));
  const double beside = rows * middle.grid.spacing_y;
  const std::vector<double> x{-0.7, 0.1, 0.6}, y{-0.5, 0, 0.35};
  std::vector<double> y_moved = y;
  for (double& place : y_moved) place += beside;
  const std::vector<InteriorLine> lines{{0, 0.3}, {0, 0.8}, {1, 0.5}};
  const VolumeFields f = VolumeField(two_layers(), 1.3, 1, middle, Detail::surface).at(x, y, lines, Wanted::density);
  const VolumeFields g =
      VolumeField(two_layers(), 1.3, 1, moved, Detail::surface).at(x, y_moved, lines, Wanted::density);
  const auto same = [](const Eigen::ArrayXXd& one, const Eigen::ArrayXXd& other, double size) {
    return (one - other).abs().maxCoeff() < 1e-7 * size;
  };
  const double stress = f.stress_of(Component::z).abs().maxCoeff(), strain = f.strain_of(Component::z).abs().maxCoeff();
  for (const Component c : all) {
    CHECK(same(f.stress_of(c), g.stress_of(c), stress));
    CHECK(same(f.strain_of(c), g.strain_of(c), strain));
    CHECK(f.stress_of(c).abs().maxCoeff() > 1e-3 * stress);
  }
  for (const auto field : {&VolumeFields::u, &VolumeFields::v, &VolumeFields::w})
    CHECK(same(f.*field, g.*field, f.w.abs().maxCoeff()));
  CHECK(same(f.loss_density, g.loss_density, f.loss_density.maxCoeff()));
  CHECK(same(f.line_loss, g.line_loss, f.line_loss.maxCoeff()));
  CHECK(same(f.plane_loss, g.plane_loss, f.plane_loss.maxCoeff()));
}

TEST_CASE("fields without a contact have no inside", "[core][interior]") {
  SurfaceFields none = bell_tractions(1, 0);
  none.zone.assign(none.zone.size(), Zone::free);
  CHECK_THROWS_AS(VolumeField({{1, 0.3, 0, quick}}, 1, 1, none, Detail::surface), std::domain_error);
}
