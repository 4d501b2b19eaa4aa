#include "core/given_pressure/given_pressure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/convolution/influence_operator.hpp"
#include "core/given_pressure/loss_by_waves.hpp"
#include "core/influence/influence.hpp"
#include "core/interior/interior_lines.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/stated_error.hpp"
#include "core/newton/contact_problem.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

constexpr int usual_cells = 63;       // along the load, of the finest grid
constexpr double usual_error = 1e-6;  // of R_r
constexpr double most_nodes = 2e6;    // of a grid
constexpr double flattest_cell = 4;   // its longer side over its shorter one
constexpr double margin = 0.5;        // of the grid round the load, over its half-lengths
constexpr int beyond = 6;             // nodes that interpolations ask for round a place

using Places = std::vector<std::array<double, 2>>;  // (x, y) [m]

int odd(double count) { return 2 * static_cast<int>(std::lround(0.5 * (count - 1))) + 1; }

/// How many times more cells a load's longer side has than its shorter one, so that no cell is too flat.
double slenderness(double longer, double shorter) { return std::max(1.0, longer / (flattest_cell * shorter)); }

/// A grid whose cells fill the rectangle round the load, and which reaches as far as a margin and the places asked for.
/// @param cells  on the load's shorter side
SurfaceGrid grid_over(const ContactModel& model, double cells) {
  const LoadedArea& area = *model.loaded;
  const auto fill = [&](double side, double other) {
    return 2 * side / odd(checked_count(cells * slenderness(side, other), "cells on the longer side of a pressure"));
  };
  SurfaceGrid grid;
  grid.folded = true;
  grid.spacing_x = fill(area.half_length, area.half_width);
  grid.spacing_y = fill(area.half_width, area.half_length);
  double behind = -(1 + margin) * area.half_length, ahead = -behind, aside = (1 + margin) * area.half_width;
  for (const std::array<double, 2>& place : model.deflection_places) {
    behind = std::min(behind, place[0]);
    ahead = std::max(ahead, place[0]);
    aside = std::max(aside, std::abs(place[1]));
  }
  const char* const what = "nodes of a grid that reaches all deflection_places";
  grid.first_column = -checked_count(-behind / grid.spacing_x, what) - beyond;
  grid.columns = checked_count(ahead / grid.spacing_x, what) + beyond - grid.first_column + 1;
  grid.rows = checked_count(aside / grid.spacing_y, what) + beyond + 1;
  if (const double nodes = static_cast<double>(grid.columns) * grid.rows; nodes > most_nodes)
    throw BeyondLimits(message_text("a grid over the load and all deflection_places has ", nodes, " nodes, more than ",
                                    most_nodes, ": leave out the farthest places, or take a less slender load"));
  return grid;
}

/// Cubic through the four nodes next to a place.
struct Interpolation {
  int first;
  std::array<double, 4> weights{};

  /// @param place  counted in spacings from node 0
  explicit Interpolation(double place) : first(static_cast<int>(std::floor(place)) - 1) {
    const double t = place - first;
    for (int i = 0; i < 4; ++i) {
      weights[static_cast<std::size_t>(i)] = 1;
      for (int j = 0; j < 4; ++j)
        if (j != i) weights[static_cast<std::size_t>(i)] *= (t - j) / (i - j);
    }
  }
};

/// The load on one grid, and the displacements that follow.
class PressedGrid {
 public:
  PressedGrid(const ContactModel& model, double cells)
      : model_(model), grid_(grid_over(model, cells)), pressure_(grid_.size()) {
    const double load = *model.load;
    for (int row = 0; row < grid_.rows; ++row)
      for (int column = 0; column < grid_.columns; ++column) {
        const double x = grid_.x(column), y = grid_.y(row), half_x = 0.5 * grid_.spacing_x,
                     half_y = 0.5 * grid_.spacing_y;
        pressure_(grid_.index(column, row)) =
            load * model.loaded->share(x - half_x, x + half_x, y - half_y, y + half_y) / grid_.cell_area();
      }
    pressure_ = pressure_.cwiseMax(0.0);  // rounding beside the load
    const InfluenceOperator influence(model, influence_table(model, mirrored(grid_)), grid_, true);
    moved_ = influence.apply(pressure_, model.loaded->traction * pressure_, Vector::Zero(grid_.size()));
  }

  const SurfaceGrid& grid() const { return grid_; }

  double deflection(const std::array<double, 2>& place) const { return interpolated(place, 1); }
  /// Of the interpolation, told by one through every second node: near the load's edge the surface is not smooth.
  double open_between_nodes(const std::array<double, 2>& place) const {
    constexpr double of_change = 2.5;  // where the surface goes as the distance from the edge to the power 3/2
    return of_change * std::abs(interpolated(place, 2) - interpolated(place, 1));
  }

  double resistance() const {
    double sum = 0;
    for (int row = 0; row < grid_.rows; ++row)
      for (int column = 1; column < grid_.columns; ++column) {
        const double pressure = pressure_(grid_.index(column, row));
        if (pressure == 0) continue;
        const auto change = [&](const Vector& moved) {
          return value(moved, column + 1, row) - value(moved, column - 1, row);
        };
        sum += grid_.images(row) * pressure * (change(moved_.w) - model_.loaded->traction * change(moved_.u));
      }
    return 0.5 * sum * grid_.spacing_y;
  }

  /// The largest deflection on the load's middle line, and where.
  Largest deepest() const {
    std::vector<double> x;
    for (int column = 0; column < grid_.columns; ++column) x.push_back(grid_.x(column));
    return largest_of(x, -moved_.w.head(grid_.columns).array());
  }

  void keep_fields(RollingSolution& solution) const {
    SurfaceFields& fields = solution.fields;
    fields.grid = mirrored(grid_);
    const auto keep = [&](const Vector& values, double parity) { return on_whole_grid(grid_, values, parity); };
    fields.w = keep(at_nodes(grid_, moved_.w), 1);
    fields.u = keep(at_nodes(grid_, moved_.u), 1);
    fields.v = keep(at_nodes(grid_, moved_.v), -1);
    fields.pressure = keep(pressure_, 1);
    fields.shear_x = keep(model_.loaded->traction * pressure_, 1);
    fields.shear_y = fields.slip_x = fields.slip_y = keep(Vector::Zero(grid_.size()), 1);
    for (const double pressure : fields.pressure) fields.zone.push_back(pressure > 0 ? Zone::stick : Zone::free);
    solution.contact_nodes = static_cast<int>(
        fields.zone.size() - static_cast<std::size_t>(std::count(fields.zone.begin(), fields.zone.end(), Zone::free)));
  }

 private:
  double value(const Vector& moved, int column, int row) const { return moved(row * (grid_.columns + 1) + column); }

  /// The deflection by the cubic through nodes so many spacings apart.
  double interpolated(const std::array<double, 2>& place, int apart) const {
    const Interpolation along(place[0] / (apart * grid_.spacing_x)),
        across(std::abs(place[1]) / (apart * grid_.spacing_y));
    double sum = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        sum += along.weights[static_cast<std::size_t>(i)] * across.weights[static_cast<std::size_t>(j)] *
               value(moved_.w, apart * (along.first + i) - grid_.first_column, apart * std::abs(across.first + j));
    return -sum;
  }

  const ContactModel& model_;
  SurfaceGrid grid_;
  Vector pressure_;
  Displacements moved_;
};

/// A number of second order in the cells, on two grids: what it tends to, and its error.
class Extrapolated {
 public:
  /// @param finer  how many times the cells of the finer grid are smaller
  void add(double value, double finer) {
    to_come_ = (value - last_) / (finer * finer - 1);
    last_ = value;
  }
  double value() const { return last_ + to_come_; }
  /// The part of what was to come that may not be of second order.
  double error() const { return 0.5 * std::abs(to_come_); }

 private:
  double last_ = 0, to_come_ = 0;
};

/// Cells on the load's shorter side, of the finer grid.
double cells_of(const ContactModel& model) {
  const LoadedArea& area = *model.loaded;
  if (!model.spacing) return usual_cells;
  return 2 * area.half_length / *model.spacing / slenderness(area.half_length, area.half_width);
}

/// What is given, and known without an error.
void tell_load(const ContactModel& model, RollingSolution& solution) {
  const LoadedArea& area = *model.loaded;
  solution.load = *model.load;
  solution.leading_edge = area.half_length;
  solution.trailing_edge = -area.half_length;
  solution.half_width = area.half_width;
  solution.contact_area = area.area();
  solution.mean_pressure = solution.load / solution.contact_area;
  solution.peak_pressure = area.peak_factor() * solution.mean_pressure;
  solution.edge_error = solution.contact_area_error = solution.peak_pressure_error = 0;
  solution.peak_shear_x = std::abs(area.traction) * solution.peak_pressure;
}

}  // namespace

RollingSolution solve_given_pressure(const ContactModel& model) {
  const double cells = cells_of(model);
  const Places& places = model.deflection_places;
  Extrapolated resistance, middle, peak;
  std::vector<Extrapolated> at_places(places.size());
  double open_between_nodes = 0;
  std::optional<PressedGrid> grid;
  for (const double coarser : {2, 1}) {
    const double before = grid ? grid->grid().spacing_x : INFINITY;
    grid.emplace(model, cells / coarser);
    const double finer = before / grid->grid().spacing_x;
    resistance.add(grid->resistance(), finer);
    middle.add(grid->deflection({0, 0}), finer);
    peak.add(grid->deepest().value, finer);
    open_between_nodes = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      at_places[i].add(grid->deflection(places[i]), finer);
      open_between_nodes = std::max(open_between_nodes, grid->open_between_nodes(places[i]));
    }
  }
  const LossByWaves loss = loss_by_waves(model, std::min(model.tolerance.value_or(usual_error), usual_error));

  RollingSolution solution;
  solution.method = Method::convolution;
  solution.status = Status::converged;
  tell_load(model, solution);
  solution.rolling_resistance = loss.resistance;
  solution.rolling_resistance_coefficient = solution.rolling_resistance / solution.load;
  set_error(loss.error, solution);
  solution.viscous_loss = solution.rolling_resistance * model.speed;
  solution.deflection = middle.value();
  solution.peak_deflection = peak.value();
  solution.peak_deflection_x = grid->deepest().place;
  solution.deflection_error = std::max(middle.error(), peak.error());
  // An elastic layer resists with nothing, of the load times the slope of its dent.
  const double nothing = 1e-6 * solution.load * std::abs(solution.peak_deflection) / model.loaded->half_length;
  solution.energy_residual = std::abs(resistance.value() - solution.rolling_resistance) /
                             std::max(std::abs(solution.rolling_resistance), nothing);
  for (const Extrapolated& at_place : at_places) {
    solution.deflections.push_back(at_place.value());
    // Between nodes all of what was to come is open, as it may be of another order there.
    solution.deflection_error = std::max(solution.deflection_error, 2 * at_place.error() + open_between_nodes);
  }
  solution.spacing = grid->grid().spacing_x;
  grid->keep_fields(solution);
  return solution;
}

}  // namespace rollres
