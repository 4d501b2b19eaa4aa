#include "core/newton/grid_series.hpp"

#include <algorithm>
#include <cmath>

#include "core/edge/edge_curve.hpp"
#include "core/estimate/grid_choice.hpp"

namespace rollres {

namespace {

constexpr double coarsest_cells_on_half_width = 4, coarsest_of_two = 3;  // two grids tell an error

int coarsenings(double cells_on_half_width) {
  int count = 0;
  constexpr int most = 40;  // an overflowing estimate of the contact tells nothing
  while (count < most &&
         std::ldexp(cells_on_half_width, -count - 1) >= (count == 0 ? coarsest_of_two : coarsest_cells_on_half_width))
    ++count;
  return count;
}

double expected_half_width(const ContactModel& model) {
  return std::min(estimate_contact(model).half_width, 0.7 * model.radius);
}

/// Room around a contact found on a grid of spacing `from`, for one of spacing `to` [m].
double margin(double from, double to) { return from > to ? 1.5 * from + 2 * to : 4 * to; }

/// Of the contact's ends beyond the outermost nodes in it, in cells. From 0.5 on the next nodes would be in contact.
constexpr double edge_place = 0.3;

/// The elliptical contact with the level's moments of pressure.
struct PressureEllipse {
  double centre_x = 0, centre_y = 0, half_length = 0, half_width = 0;  // [m]
};

PressureEllipse pressure_ellipse(const ContactLevel& level) {
  const SurfaceGrid& grid = level.problem->grid;
  double sum = 0, first_x = 0, first_y = 0, second_x = 0, second_y = 0;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const double p = level.outcome.unknowns.pressure(grid.index(column, row)) * grid.images(row);
      const double x = grid.x(column), y = grid.y(row);
      sum += p;
      first_x += p * x;
      if (!grid.folded) first_y += p * y;
      second_x += p * x * x;
      second_y += p * y * y;
    }
  // Of p0 sqrt(1 - r^2) over an ellipse each second moment is a fifth of the squared half-axis.
  const double x = first_x / sum, y = first_y / sum;
  return {x, y, std::sqrt(5 * (second_x / sum - x * x)), std::sqrt(5 * (second_y / sum - y * y))};
}

}  // namespace

GridSeries fixed_grids(const ContactModel& model, double spacing) {
  const double half_width = expected_half_width(model), widest = widest_window(model);
  window(model, spacing, std::min(1.3 * half_width + 3 * spacing, widest),
         Cells::square);  // refused before all coarser ones
  GridSeries series;
  series.coarsest = coarsenings(std::min(1.0, estimate_contact(model).elongation) * half_width / spacing);
  series.first = [=](int coarsening) {
    const double own = std::ldexp(spacing, coarsening);
    return window(model, own, std::min(1.3 * half_width + 3 * own, widest), Cells::square);
  };
  series.around = [spacing](const ContactLevel& level, int coarsening) {
    SurfaceGrid grid = level.problem->grid;
    const double from = grid.spacing_x, own = std::ldexp(spacing, coarsening);
    grid.spacing_x = own;
    if (level.problem->plane) grid.spacing_y = own;
    return follow(level, grid, margin(from, own));
  };
  return series;
}

GridSeries tied_grids(const ContactModel& model, double cells_on_half_width) {
  const double half_width = expected_half_width(model), widest = widest_window(model);
  GridSeries series;
  series.coarsest = coarsenings(cells_on_half_width);
  series.first = [=](int coarsening) {
    const double own = half_width / std::ldexp(cells_on_half_width, -coarsening);
    return window(model, own, std::min(1.3 * half_width + 3 * own, widest), Cells::as_contact);
  };
  series.around = [cells_on_half_width](const ContactLevel& level, int coarsening) {
    SurfaceGrid grid = level.problem->grid;
    const double from = std::max(grid.spacing_x, grid.spacing_y), cells = std::ldexp(cells_on_half_width, -coarsening);
    const PressureEllipse ellipse = pressure_ellipse(level);
    // A contact of a single node or column has no width of its own.
    if (!(ellipse.half_length > 0 && ellipse.half_width > 0)) return follow(level, grid, margin(from, from / 2));
    grid.origin_x = ellipse.centre_x;
    grid.origin_y = ellipse.centre_y;
    grid.spacing_x = ellipse.half_length / cells;
    grid.spacing_y = ellipse.half_width / cells;
    return follow(level, grid, margin(from, std::max(grid.spacing_x, grid.spacing_y)));
  };
  return series;
}

GridSeries tied_lines(const ContactModel& model, double cells_on_half_width) {
  const double half_width = expected_half_width(model), widest = widest_window(model);
  GridSeries series;
  series.tied = true;
  series.coarsest = coarsenings(cells_on_half_width);
  series.first = [=](int coarsening) {
    const double own = half_width / std::ldexp(cells_on_half_width, -coarsening);
    return window(model, own, std::min(1.3 * half_width + 3 * own, widest), Cells::as_contact);
  };
  series.around = [cells_on_half_width](const ContactLevel& level, int coarsening) {
    SurfaceGrid grid = level.problem->grid;
    const double from = grid.spacing_x;
    const std::vector<RowEnds> ends = ends_of_rows(grid, level.outcome.unknowns.pressure);
    if (ends.empty()) {
      grid.spacing_x = 0.5 * from;
    } else {
      const double length = ends.front().leading - ends.front().trailing;
      const double steps = std::round(2 * std::ldexp(cells_on_half_width, -coarsening) - 2 * edge_place);
      grid.spacing_x = length / (std::max(steps, 1.0) + 2 * edge_place);
      grid.origin_x = ends.front().leading - edge_place * grid.spacing_x;
    }
    return follow(level, grid, margin(from, grid.spacing_x));
  };
  return series;
}

}  // namespace rollres
