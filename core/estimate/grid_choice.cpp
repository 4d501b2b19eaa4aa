#include "core/estimate/grid_choice.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/composite_estimate.hpp"
#include "core/material/material.hpp"
#include "core/messages/message_text.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/surface/contact_surface.hpp"

namespace rollres {

namespace {

ContactEstimate elastic_contact(const RollingScene& scene, double modulus) {
  if (scene.load) return elastic_contact_from_load(scene.indenter, scene.radius, layer_of(scene), modulus, *scene.load);
  return elastic_contact_from_approach(scene.indenter, scene.radius, layer_of(scene), modulus, *scene.approach);
}

}  // namespace

ContactEstimate estimate_contact(const RollingScene& scene) {
  if (is_composite(scene)) return composite_estimate(scene);
  const CreepSpectrum creep = creep_spectrum(scene);
  ContactEstimate estimate = elastic_contact(scene, 1 / creep.at_rest());
  // The modulus depends on the half-width through the frequency: a few passes settle it.
  for (int pass = 0; pass < 4; ++pass)
    estimate = elastic_contact(scene, 1 / std::abs(creep(scene.speed / estimate.half_width)));
  return estimate;
}

double share_of_coating(const RollingScene& scene) {
  return scene.coating_layers.empty() ? 0 : share_of_coating(scene, estimate_contact(scene).half_width);
}

double default_spacing(const RollingScene& scene) {
  const double nodes_per_half_width = scene.indenter == Indenter::cylinder ? 60 : 20;
  return std::min(estimate_contact(scene).half_width, scene.radius) / nodes_per_half_width;
}

void require_nodes(double columns, double rows, double spacing) {
  // Coefficients, transforms and Krylov vectors, as measured.
  const double bytes_per_node = rows > 1 ? 3e3 : 5e3;
  require_memory(bytes_per_node * columns * rows,
                 message_text("the contact needs ", columns * rows, " nodes of ", spacing, " m"));
}

SurfaceGrid window(Indenter indenter, double spacing, double half_width) {
  const double wanted = std::max(2.0, std::ceil(half_width / spacing));
  require_nodes(2 * wanted + 1, indenter == Indenter::sphere ? wanted + 1 : 1, spacing);
  const int cells = checked_count(wanted, "cells of a window");
  SurfaceGrid grid;
  grid.spacing_x = spacing;
  grid.first_column = -cells;
  grid.columns = 2 * cells + 1;
  if (indenter == Indenter::sphere) {
    grid.spacing_y = spacing;
    grid.rows = cells + 1;
  } else {
    grid.spacing_y = 1;
    grid.rows = 1;
  }
  return grid;
}

}  // namespace rollres
