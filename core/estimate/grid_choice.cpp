#include "core/estimate/grid_choice.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/composite_estimate.hpp"
#include "core/material/material.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/contact_surface.hpp"
#include "core/model/indenter_shape.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

ContactEstimate elastic_contact(const ContactModel& model, double modulus) {
  if (model.load) return elastic_contact_from_load(model.dimension, model.radius, model.layer(), modulus, *model.load);
  return elastic_contact_from_approach(model.dimension, model.radius, model.layer(), modulus, *model.approach);
}

/// That of the sphere with the mean curvature, drawn out: half-widths go with the radii to the power 1/2 over a thin
/// layer, to about 2/3 on a half-space.
ContactEstimate estimate_of_roller(ContactModel model) {
  constexpr double power = 0.6;
  const double ratio = *model.transverse_radius / model.radius;
  model.radius = std::sqrt(model.radius * *model.transverse_radius);
  model.transverse_radius.reset();
  ContactEstimate estimate = estimate_contact(model);
  estimate.elongation = std::pow(ratio, power);
  estimate.half_width /= std::sqrt(estimate.elongation);
  return estimate;
}

}  // namespace

ContactEstimate estimate_contact(const ContactModel& model) {
  if (model.estimate) return *model.estimate;
  if (model.transverse_radius) return estimate_of_roller(model);
  if (model.composite()) return composite_estimate(model);
  const CreepSpectrum& creep = model.top().creep;
  ContactEstimate estimate = elastic_contact(model, 1 / creep.at_rest());
  // The modulus depends on the half-width through the frequency: a few passes settle it.
  for (int pass = 0; pass < 4; ++pass)
    estimate = elastic_contact(model, 1 / std::abs(creep(model.speed / estimate.half_width)));
  return estimate;
}

double share_of_coating(const ContactModel& model) {
  if (model.coating_share) return *model.coating_share;
  return model.coating.empty() ? 0 : share_of_coating(model, estimate_contact(model).half_width);
}

double default_spacing(const ContactModel& model) {
  const double nodes_per_half_width = model.dimension == 2 ? 60 : 20;
  const ContactEstimate estimate = estimate_contact(model);
  return std::min(estimate.half_width * std::min(estimate.elongation, 1.0), model.radius) / nodes_per_half_width;
}

void require_nodes(double columns, double rows, double spacing) {
  // Coefficients, transforms and Krylov vectors, as measured.
  const double bytes_per_node = rows > 1 ? 3e3 : 5e3;
  require_memory(bytes_per_node * columns * rows,
                 message_text("the contact needs ", columns * rows, " nodes of ", spacing, " m"));
}

namespace {

/// @param half_width_y and spacing_y of a grid in 3D
SurfaceGrid window_of(int dimension, double spacing, double half_width, double spacing_y, double half_width_y) {
  const auto wanted = [](double reach, double cell) { return std::max(2.0, std::ceil(reach / cell)); };
  const double columns = 2 * wanted(half_width, spacing) + 1,
               rows = dimension == 3 ? wanted(half_width_y, spacing_y) + 1 : 1;
  require_nodes(columns, rows, spacing);
  SurfaceGrid grid;
  grid.spacing_x = spacing;
  grid.columns = checked_count(columns, "cells of a window");
  grid.first_column = -grid.columns / 2;
  grid.rows = checked_count(rows, "cells of a window");
  grid.spacing_y = dimension == 3 ? spacing_y : 1;
  grid.folded = dimension == 3;
  return grid;
}

}  // namespace

SurfaceGrid window(int dimension, double spacing, double half_width) {
  return window_of(dimension, spacing, half_width, spacing, half_width);
}

SurfaceGrid window(const ContactModel& model, double spacing, double half_width, Cells cells) {
  const double elongation = estimate_contact(model).elongation;
  SurfaceGrid grid = window_of(model.dimension, spacing, half_width,
                               spacing * (cells == Cells::as_contact ? elongation : 1), half_width * elongation);
  if (model.mirrored()) return grid;
  const auto [middle_x, middle_y] = IndenterShape(model).lowest();
  grid.origin_x = middle_x;
  grid.origin_y = middle_y;
  grid.first_row = 1 - grid.rows;
  grid.rows = grid.whole_rows();
  grid.folded = false;
  require_nodes(grid.columns, grid.rows, spacing);
  return grid;
}

}  // namespace rollres
