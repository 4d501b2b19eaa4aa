#include "studies/evidence/verification_inside.hpp"

#include <cmath>

#include "core/interior/layers_inside.hpp"
#include "core/interior/volume_field.hpp"
#include "core/reference/reference_inside.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres::verification {

/// Stresses under a Hertz line contact, and the loss inside the paper's layer.
void check_inside_cylinder(Checks& checks) {
  const RollingScene line = on_half_space(Indenter::cylinder);
  const RollingSolution s = checks.solve(line);
  const char *why = "the default tolerance, and waves up to 300 per half-width", *mcewen = "McEwen (1949)";
  struct Place {
    double x, depth;
  };
  for (const auto& [x, depth] : {Place{0.6, 0.05}, {0.6, 0.786}}) {
    const InsideStress expected =
        hertz_line_inside(0.5 * s.contact_area, s.peak_pressure, x * line_width, depth * line_width);
    PlaneStress found{NAN, NAN, NAN};
    if (!s.fields.zone.empty() || !s.fields.panels.empty()) {
      const auto parts = layers_inside<InteriorField>(line, s.fields, 2 * line_width, InteriorField::Detail::surface);
      const VolumeFields f = parts.front().field.at({x * line_width}, {{0, depth * line_width}});
      found = {f.stress_of(Component::x)(0, 0), f.stress_of(Component::z)(0, 0), f.stress_of(Component::xz)(0, 0)};
    }
    const std::string where = "cylinder on a half-space, x = 0.6 a, " + short_number(depth) + " a deep: ";
    checks.add({where + "σ_x", mcewen, "Pa", expected.x, found.x.real(), 1e-6, why});
    checks.add({where + "σ_z", mcewen, "Pa", expected.z, found.z.real(), 1e-6, why});
    checks.add({where + "τ_xz", mcewen, "Pa", expected.xz, found.xz.real(), 1e-6, why});
  }
  RollingScene asked = line;
  asked.interior = Interior::on;
  const RollingSolution inside = checks.solve(asked);
  checks.add({"cylinder on a half-space: largest shear strain", mcewen, "1",
              hertz_line_largest_shear() * inside.peak_pressure / shear_modulus, inside.peak_shear_strain, 1e-5,
              "a parabola through points a/1000 apart"});
  RollingScene layer = without_grid(paper_scene("paper_cylinder"));
  layer.interior = Interior::on;
  layer.kinematics = Kinematics::consistent;
  const RollingSolution paper = checks.solve(layer);
  checks.add({"paper's cylinder: power lost, summed inside the layer", "that of its surface", "W/m", paper.viscous_loss,
              paper.interior_loss, 1e-6, "waves up to 300 per half-length"});
}

/// Stresses under bells of pressure and shear on a half-space, and the loss inside a sphere's layer.
void check_inside_sphere(Checks& checks) {
  constexpr double bell = 1, cell = 0.25, peak = 1e6, shear = 0.3e6, nu = 0.3;
  constexpr int across = 49;
  SurfaceFields fields;
  fields.grid = {.spacing_x = cell,
                 .spacing_y = cell,
                 .first_column = -across / 2,
                 .first_row = -across / 2,
                 .columns = across,
                 .rows = across};
  const double x = 0.9, y = 0.5, depth = 0.8;
  VolumeStress expected{};
  // Point forces a quarter of a cell apart: their sum of a bell is its integral to rounding, this deep.
  constexpr int finer = 4, points = finer * across;
  for (int m = 0; m < points; ++m)
    for (int n = 0; n < points; ++n) {
      const double step = cell / finer, s = step * (m + 0.5 - 0.5 * points), t = step * (n + 0.5 - 0.5 * points);
      const double force = std::exp(-(s * s + t * t) / (bell * bell)) * step * step;
      const VolumeStress part = point_forces_inside(peak * force, shear * force, nu, x - s, y - t, depth);
      expected.x += part.x;
      expected.y += part.y;
      expected.xz += part.xz;
      expected.xy += part.xy;
    }
  for (int row = 0; row < across; ++row)
    for (int column = 0; column < across; ++column) {
      const double r = std::hypot(fields.grid.x(column), fields.grid.y(row)) / bell, share = std::exp(-r * r);
      fields.pressure.push_back(peak * share);
      fields.shear_x.push_back(shear * share);
      fields.shear_y.push_back(0);
      fields.zone.push_back(Zone::stick);
    }
  const VolumeField field({{INFINITY, nu, 0, CreepSpectrum{.instantaneous = 1 / shear_modulus, .terms = {}}}}, 1, 1,
                          fields, InteriorField::Detail::surface);
  const VolumeFields found = field.at({x}, {y}, {{0, depth}}, VolumeField::Wanted::all);
  const auto row = [&](const char* name, double wanted, Component c) {
    checks.add({std::string("bells of pressure and shear on a half-space, ") + name, "Boussinesq and Cerruti", "Pa",
                wanted, found.stress_of(c)(0, 0), 1e-6, "waves up to two cells, in panels"});
  };
  row("σ_x", expected.x, Component::x);
  row("σ_y", expected.y, Component::y);
  row("τ_xz", expected.xz, Component::xz);
  row("τ_xy", expected.xy, Component::xy);

  RollingScene sphere = on_half_space(Indenter::sphere);
  sphere.tolerance = 1e-3;
  sphere.interior = Interior::on;
  const RollingSolution s = checks.solve(sphere);
  const double hertz = 1.5 * *sphere.load / (M_PI * sphere_width * sphere_width);
  checks.add({"sphere on a half-space: largest shear strain", "Huber (1904)", "1",
              hertz_point_largest_shear(sphere.poisson_ratio).difference * hertz / (2 * shear_modulus),
              s.peak_shear_strain, 2e-3, "the wanted tolerance of 1e-3"});
  RollingScene paper = paper_scene("paper_sphere");
  paper.kinematics = Kinematics::consistent;
  paper.interior = Interior::on;
  const RollingSolution layer = checks.solve(paper);
  checks.add({"paper's sphere: power lost, summed inside the layer", "that of its surface", "W", layer.viscous_loss,
              layer.interior_loss, 5e-3, "its cells, second order"});
}

}  // namespace rollres::verification
