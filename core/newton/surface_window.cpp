#include "core/newton/surface_window.hpp"

#include <algorithm>
#include <cmath>

#include "core/convolution/influence_operator.hpp"
#include "core/model/indenter_shape.hpp"
#include "core/newton/contact_problem.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

/// Columns and rows from the first to the last in contact.
struct ContactFrame {
  int first_column, last_column, first_row, last_row;

  explicit ContactFrame(const SurfaceFields& fields)
      : first_column(fields.grid.columns), last_column(0), first_row(fields.grid.rows), last_row(0) {
    const SurfaceGrid& grid = fields.grid;
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column) {
        if (fields.zone[static_cast<std::size_t>(grid.index(column, row))] == Zone::free) continue;
        first_column = std::min(first_column, column);
        last_column = std::max(last_column, column);
        first_row = std::min(first_row, row);
        last_row = std::max(last_row, row);
      }
  }
};

/// Grid over the margin around the contact, folded if the model is mirrored.
SurfaceGrid window_around(const ContactModel& model, const SurfaceFields& fields, double margin) {
  const SurfaceGrid& given = fields.grid;
  const ContactFrame contact(fields);
  const double half_length = 0.5 * given.spacing_x * (contact.last_column - contact.first_column + 1);
  const auto cells = [](double length, double spacing) {
    return checked_count(std::ceil(length / spacing), "cells of a window");
  };
  int ahead = cells(margin * half_length, given.spacing_x), aside = cells(margin * half_length, given.spacing_y);
  const int contact_columns = contact.last_column - contact.first_column + 1;
  const int top_row = std::max(given.first_row + contact.last_row, -(given.first_row + contact.first_row));
  if (model.period) {  // the coefficients reach half a period
    const auto most = [&](double spacing) {
      return (checked_count(*model.period / spacing, "cells of a period") - 1) / 2;
    };
    ahead = std::clamp((most(given.spacing_x) - contact_columns) / 2, 0, ahead);
    aside = std::clamp((most(given.spacing_y) - 1) / 2 - top_row, 0, aside);
  }
  SurfaceGrid half = given;
  half.first_column = given.first_column + contact.first_column - ahead;
  half.columns = contact_columns + 2 * ahead;
  half.first_row = 0;
  half.rows = model.dimension == 3 ? top_row + aside + 1 : 1;
  half.folded = model.dimension == 3;
  return model.mirrored() ? half : mirrored(half);
}

}  // namespace

SurfaceFields surface_around(const ContactModel& model, const RollingSolution& solution, double margin) {
  const SurfaceFields& given = solution.fields;
  if (!on_grid(solution.method)) return given;
  const SurfaceGrid own = window_around(model, given, margin);

  SurfaceFields wide;
  wide.grid = mirrored(own);
  const SurfaceGrid &from = given.grid, &to = wide.grid;
  const auto continued = [&](const auto& values, auto beyond) {
    std::vector all(values.empty() ? 0 : static_cast<std::size_t>(to.size()), beyond);
    if (values.empty()) return all;
    for (int row = 0; row < to.rows; ++row)
      for (int column = 0; column < to.columns; ++column) {
        const int old_row = row + to.first_row - from.first_row;
        const int old_column = column + to.first_column - from.first_column;
        if (old_row < 0 || old_row >= from.rows || old_column < 0 || old_column >= from.columns) continue;
        all[static_cast<std::size_t>(to.index(column, row))] =
            values[static_cast<std::size_t>(from.index(old_column, old_row))];
      }
    return all;
  };
  wide.pressure = continued(given.pressure, 0.0);
  wide.shear_x = continued(given.shear_x, 0.0);
  wide.shear_y = continued(given.shear_y, 0.0);
  wide.slip_x = continued(given.slip_x, 0.0);
  wide.slip_y = continued(given.slip_y, 0.0);
  wide.zone = continued(given.zone, Zone::free);

  const auto upper = [&](const std::vector<double>& values) {
    const Eigen::Map<const Vector> whole(values.data(), static_cast<Eigen::Index>(values.size()));
    return Vector(whole.tail(std::min<Eigen::Index>(whole.size(), own.size())));
  };
  const InfluenceOperator influence(model, influence_table(model, to), own, true);
  const Displacements moved = influence.apply(upper(wide.pressure), upper(wide.shear_x), upper(wide.shear_y));
  wide.w = on_whole_grid(own, at_nodes(own, moved.w), 1);
  wide.u = on_whole_grid(own, at_nodes(own, moved.u), 1);
  if (model.dimension == 3) wide.v = on_whole_grid(own, at_nodes(own, moved.v), -1);
  return wide;
}

SurfaceVelocity surface_velocity(const ContactModel& model, const SurfaceFields& fields) {
  const SurfaceGrid& grid = fields.grid;
  const SlipStencil stencil = model.method == Method::active_set ? model.slip_stencil : SlipStencil::forward;
  const auto rate = [&](const std::vector<double>& moved) {
    std::vector<double> velocity(moved.size());
    for (int node = 0; node < static_cast<int>(moved.size()); ++node) {
      const int column = node % grid.columns, last = grid.columns - 1;
      const bool left = column > 0 && (stencil != SlipStencil::forward || column == last);
      const bool right = column < last && (stencil != SlipStencil::backward || column == 0);
      if (!left && !right) continue;  // a single column tells no slope
      const auto ahead = static_cast<std::size_t>(node + right), behind = static_cast<std::size_t>(node - left);
      velocity[static_cast<std::size_t>(node)] =
          -model.speed * (moved[ahead] - moved[behind]) / (static_cast<double>(ahead - behind) * grid.spacing_x);
    }
    return velocity;
  };
  return {rate(fields.u), rate(fields.v)};
}

}  // namespace rollres
