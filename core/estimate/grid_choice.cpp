#include "core/estimate/grid_choice.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/dense_algebra.hpp"
#include "core/estimate/composite_estimate.hpp"
#include "core/material/material.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/contact_surface.hpp"
#include "core/model/indenter_shape.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/numerics/vector.hpp"

namespace rollres {

namespace {

ContactEstimate elastic_contact(const ContactModel& model, double modulus) {
  if (model.load) return elastic_contact_from_load(model.dimension, model.radius, model.layer(), modulus, *model.load);
  return elastic_contact_from_approach(model.dimension, model.radius, model.layer(), modulus, *model.approach);
}

/// That of the sphere with the mean curvature, drawn out: half-widths go with the radii to the power 1/2 over a thin
/// layer, to about 2/3 on a half-space.
ContactEstimate estimate_of_crown(ContactModel model, double transverse_radius) {
  constexpr double power = 0.6;
  const double ratio = transverse_radius / model.radius;
  model.radius = std::sqrt(model.radius * transverse_radius);
  model.outline.reset();
  ContactEstimate estimate = estimate_contact(model);
  estimate.elongation = std::pow(ratio, power);
  estimate.half_width /= std::sqrt(estimate.elongation);
  return estimate;
}

/// Half the length along the axle over which a body is lower than so high above its lowest point [m].
double half_length_below(const IndenterShape& shape, double reach, double height) {
  constexpr int places = 400;
  const auto [x, y] = shape.lowest();
  int below = 0;
  for (int i = 0; i <= places; ++i) below += shape.profile(x, y + reach * (2.0 * i / places - 1)) < height ? 1 : 0;
  return reach * std::max(below, 1) / places;
}

/// That of the crown which reaches as far to the sides where it is as high as the ends of the contact.
ContactEstimate estimate_of_profile(const ContactModel& model) {
  const IndenterShape shape(model);
  const double reach = model.outline->reach();
  double transverse = model.radius;
  ContactEstimate estimate{};
  constexpr int passes = 12;
  for (int pass = 0; pass < passes; ++pass) {
    estimate = estimate_of_crown(model, transverse);
    const double half_width = std::min(estimate.half_width, model.radius),
                 height = 0.5 * half_width * half_width / model.radius;
    const double aside = half_length_below(shape, reach, height) / half_width;
    transverse = std::sqrt(transverse * model.radius) * aside;  // half the way, in its logarithm
  }
  return estimate;
}

ContactEstimate estimate_of_roller(const ContactModel& model) {
  return model.profiled() ? estimate_of_profile(model) : estimate_of_crown(model, model.outline->transverse_radius());
}

}  // namespace

ContactEstimate estimate_contact(const ContactModel& model) {
  if (model.loaded) {
    const double half_length = model.loaded->half_length;
    return {half_length, *model.load * hertz_response(model, half_length).compliance, *model.load,
            model.loaded->half_width / half_length};
  }
  if (model.estimate) return *model.estimate;
  if (model.outline) return estimate_of_roller(model);
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

double cells_for_hollows(const ContactModel& model) {
  if (!model.outline) return 0;
  constexpr double share = 0.1, cells_on_flank = 4;
  const ContactEstimate estimate = estimate_contact(model);
  const double depth = 0.5 * estimate.half_width * estimate.half_width / model.radius;
  return cells_on_flank * estimate.half_width * estimate.elongation / model.outline->shortest_flank(share * depth);
}

bool has_smooth_edge(const ContactModel& model) {
  if (!model.profiled()) return true;
  constexpr int places = 40, terms = 9;
  constexpr double enough = 2e-3;  // of the depth: a thousandth of the contact's half-length
  const ContactEstimate estimate = estimate_contact(model);
  const double depth = 0.5 * estimate.half_width * estimate.half_width / model.radius,
               aside = estimate.half_width * estimate.elongation;
  const double middle = model.outline->lowest(std::sin(model.camber)).along;
  Eigen::MatrixXd powers(places + 1, terms);
  Vector heights(places + 1);
  for (int i = 0; i <= places; ++i) {
    const double t = 2.0 * i / places - 1;
    for (int k = 0; k < terms; ++k) powers(i, k) = std::pow(t, k);
    heights(i) = model.radius - std::sqrt(std::max(model.outline->squared_radius(middle + t * aside), 0.0));
  }
  const Vector apart = powers * OverdeterminedSystem(powers).solve(heights) - heights;
  return apart.norm() <= enough * depth * std::sqrt(places + 1.0);
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
