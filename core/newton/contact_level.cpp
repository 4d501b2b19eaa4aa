#include "core/newton/contact_level.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/grid_choice.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

/// With waves as short as half a cell of a line, or a cell: without those of two cells a train's nodes do not tell
/// neighbours apart, and those below take R_r of a line 5e-5 away.
ContactModel with_waves_of_cells(ContactModel model, const SurfaceGrid& grid) {
  const double of_cell = model.dimension == 2 ? 2 : 1;
  if (model.period)
    model.series_terms = std::max(
        model.series_terms, checked_count(std::ceil(of_cell * *model.period / grid.spacing_x), "waves of a period"));
  return model;
}

}  // namespace

ContactLevel make_level(const ContactModel& asked, const SurfaceGrid& grid) {
  const ContactModel model = with_waves_of_cells(asked, grid);
  ContactLevel level;
  level.problem = std::make_unique<ContactProblem>(model, grid);
  level.table = std::make_unique<InfluenceTable>(influence_table(model, mirrored(grid)));
  level.influence = std::make_unique<InfluenceOperator>(model, *level.table, grid, level.problem->friction);
  return level;
}

ContactUnknowns first_guess(const ContactProblem& problem, const ContactEstimate& estimate) {
  ContactUnknowns guess;
  const SurfaceGrid& grid = problem.grid;
  guess.pressure = Vector::Zero(grid.size());
  const bool adhesive = problem.model.adhesion_threshold > 0;
  const auto [middle_x, middle_y] = problem.shape.lowest();
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const double x = grid.x(column) - middle_x, y = (grid.y(row) - middle_y) / estimate.elongation;
      const double r = std::hypot(x, y) / estimate.half_width;
      if (adhesive)
        guess.pressure(grid.index(column, row)) = 1;
      else if (r < 1)
        guess.pressure(grid.index(column, row)) = std::sqrt(1 - r * r);
    }
  const double load = problem.load(guess.pressure, {}, {});
  if (load > 0) guess.pressure *= estimate.load / load;
  guess.approach = problem.model.approach.value_or(std::isfinite(estimate.approach) ? estimate.approach : 0);
  return guess;
}

namespace {

/// Bilinear values on a finer grid, zero outside the coarser one.
Vector interpolate(const Vector& values, const SurfaceGrid& from, const SurfaceGrid& to, double parity) {
  Vector result(to.size());
  const auto at = [&](int column, int row) {
    double sign = 1;
    if (from.folded && row < 0) {
      row = -row;
      sign = parity;
    }
    if (column < 0 || column >= from.columns || row < 0 || row >= from.rows) return 0.0;
    return sign * values(from.index(column, row));
  };
  for (int row = 0; row < to.rows; ++row)
    for (int column = 0; column < to.columns; ++column) {
      const double x = (to.x(column) - from.origin_x) / from.spacing_x - from.first_column;
      const double y = (to.y(row) - from.origin_y) / from.spacing_y - from.first_row;
      const double left = std::floor(x), below = std::floor(y), fx = x - left, fy = y - below;
      const int c = static_cast<int>(left), r = static_cast<int>(below);
      double value = (1 - fx) * at(c, r) + fx * at(c + 1, r);
      if (fy > 0) value = (1 - fy) * value + fy * ((1 - fx) * at(c, r + 1) + fx * at(c + 1, r + 1));
      result(to.index(column, row)) = value;
    }
  return result;
}

/// Pressure inside and minus the gap outside join at the contact's edge [Pa].
Vector signed_pressure(const ContactLevel& level) {
  return level.outcome.unknowns.pressure - level.outcome.gap.cwiseMax(0) / level.influence->self_normal();
}

}  // namespace

ContactUnknowns transfer(const ContactLevel& from, const SurfaceGrid& to) {
  const SurfaceGrid& grid = from.problem->grid;
  ContactUnknowns start = from.outcome.unknowns;
  // Pressure inside and gap outside join at the contact's edge: their interpolated sign tells the finer contact.
  const Vector sign = interpolate(signed_pressure(from), grid, to, 1);
  start.pressure = (sign.array() > 0).select(interpolate(start.pressure, grid, to, 1), 0.0);
  if (start.shear_x.size() > 0) start.shear_x = interpolate(start.shear_x, grid, to, 1);
  if (start.shear_y.size() > 0) start.shear_y = interpolate(start.shear_y, grid, to, -1);
  return start;
}

SurfaceGrid follow(const ContactLevel& level, const SurfaceGrid& like, double margin) {
  const SurfaceGrid& grid = level.problem->grid;
  double leading = -INFINITY, trailing = INFINITY, half_width = 0;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      if (level.outcome.zone[static_cast<std::size_t>(grid.index(column, row))] != Zone::free) {
        leading = std::max(leading, grid.x(column));
        trailing = std::min(trailing, grid.x(column));
        half_width = std::max(half_width, std::abs(grid.y(row) - like.origin_y));
      }
  if (leading < trailing) return like;  // no contact: around nothing
  const ContactModel& model = level.problem->model;
  const double widest = widest_window(model);
  SurfaceGrid next = like;
  // Columns beyond the origin, and rows, that reach as far as a distance from under the axis.
  const auto cells = [&](double distance, double origin, double spacing, double farthest) {
    return checked_count(std::ceil((std::clamp(distance, -farthest, farthest) - origin) / spacing - 1e-9),
                         "cells of a window");
  };
  next.first_column = -cells(margin - trailing, -like.origin_x, like.spacing_x, widest);
  next.columns = cells(leading + margin, like.origin_x, like.spacing_x, widest) - next.first_column + 1;
  if (level.problem->plane) {
    const int aside = cells(half_width + margin, 0, like.spacing_y, widest_across(model));
    next.first_row = like.folded ? 0 : -aside;
    next.rows = aside - next.first_row + 1;
  }
  require_nodes(next.columns, next.rows, next.spacing_x);
  return next;
}

std::optional<double> end_in_contact(const ContactLevel& level) {
  const ContactProblem& problem = *level.problem;
  if (!problem.model.profiled()) return std::nullopt;
  const SurfaceGrid& grid = problem.grid;
  for (int node = 0; node < grid.size(); ++node) {
    if (level.outcome.zone[static_cast<std::size_t>(node)] == Zone::free) continue;
    const double x = grid.x(node % grid.columns), y = grid.y(node / grid.columns);
    if (!problem.shape.covers(x, y - grid.spacing_y) || !problem.shape.covers(x, y + grid.spacing_y)) return y;
  }
  return std::nullopt;
}

double residual_of_gaps(const ContactLevel& level, const ContactEstimate& estimate) {
  constexpr double of_gaps = 1e-9, least = 1e-12;
  const InfluenceTable& table = *level.table;
  const SurfaceGrid& grid = level.problem->grid;
  const bool line = level.problem->model.dimension == 2;
  const double a = estimate.half_width, height = a * a / (2 * level.problem->model.radius);
  const double pressure = estimate.load / (line ? 2 * a : M_PI * a * a);
  const double yields = table.ww[static_cast<std::size_t>(table.index(0, 0))] * grid.cell_area() * pressure;
  return std::max(least, of_gaps * height / yields);
}

}  // namespace rollres
