#include "core/given_pressure/given_pressure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/convolution/influence_operator.hpp"
#include "core/influence/influence.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/stated_error.hpp"
#include "core/newton/contact_problem.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

constexpr int usual_cells = 63, most_cells = 511;  // along the load, of the finest grid
constexpr double most_nodes = 2e6;                 // of a grid
constexpr double flattest_cell = 4;                // its longer side over its shorter one
constexpr double negligible = 1e-6;                // of the load times its slope: what an elastic layer resists with
constexpr double margin = 0.5;                     // of the grid round the load, over its half-lengths

int odd(double count) { return 2 * static_cast<int>(std::lround(0.5 * (count - 1))) + 1; }

/// A grid whose cells fill the rectangle round the load, and which reaches as far as a margin and the given places.
SurfaceGrid grid_over(const ContactModel& model, int cells, bool to_places) {
  const LoadedArea& area = *model.loaded;
  SurfaceGrid grid;
  grid.folded = true;
  grid.spacing_x = 2 * area.half_length / cells;
  const double across = cells * area.half_width / area.half_length;  // of square cells
  const int rows = odd(checked_count(std::clamp<double>(cells, across / flattest_cell, across * flattest_cell),
                                     "cells across a given pressure"));
  grid.spacing_y = 2 * area.half_width / std::max(rows, 1);
  double behind = -(1 + margin) * area.half_length, ahead = -behind, aside = (1 + margin) * area.half_width;
  if (to_places)
    for (const std::array<double, 2>& place : model.deflection_places) {
      behind = std::min(behind, place[0]);
      ahead = std::max(ahead, place[0]);
      aside = std::max(aside, std::abs(place[1]));
    }
  constexpr int beyond = 3;  // nodes that an interpolation asks for
  const char* const what = "nodes of a grid that reaches all deflection_places";
  grid.first_column = -checked_count(-behind / grid.spacing_x, what) - beyond;
  grid.columns = checked_count(ahead / grid.spacing_x, what) + beyond - grid.first_column + 1;
  grid.rows = checked_count(aside / grid.spacing_y, what) + beyond + 1;
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
  PressedGrid(const ContactModel& model, int cells, bool to_places)
      : model_(model), grid_(grid_over(model, cells, to_places)), pressure_(grid_.size()) {
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

  /// R_r, the deflections under the middle and where it is largest, and those at the given places.
  std::vector<double> numbers() const {
    std::vector<double> all{resistance(), -value(moved_.w, -grid_.first_column, 0), deepest().deflection};
    if (reaches_places())
      for (const std::array<double, 2>& place : model_.deflection_places) all.push_back(deflection(place));
    return all;
  }

  struct Deepest {
    double x, deflection;
  };
  /// On the load's middle line, by the parabola through three nodes.
  Deepest deepest() const {
    int most = 1;
    for (int column = 1; column + 1 < grid_.columns; ++column)
      if (value(moved_.w, column, 0) < value(moved_.w, most, 0)) most = column;
    const double before = value(moved_.w, most - 1, 0), at = value(moved_.w, most, 0),
                 after = value(moved_.w, most + 1, 0);
    const double bend = before - 2 * at + after, slope = 0.5 * (after - before);
    const double step = bend > 0 ? std::clamp(-slope / bend, -1.0, 1.0) : 0;
    return {grid_.x(most) + step * grid_.spacing_x, -(at + step * (slope + 0.5 * step * bend))};
  }

  void keep_fields(RollingSolution& solution) const {
    SurfaceFields& fields = solution.fields;
    fields.grid = mirrored(grid_);
    const auto whole = [&](const Vector& values, double parity) {
      const Vector all = mirrored(grid_, values, parity);
      return std::vector<double>(all.begin(), all.end());
    };
    const auto at_nodes = [&](const Vector& moved) {
      Vector kept(grid_.size());
      for (int row = 0; row < grid_.rows; ++row)
        kept.segment(grid_.index(0, row), grid_.columns) = moved.segment(row * (grid_.columns + 1), grid_.columns);
      return kept;
    };
    const Vector none = Vector::Zero(grid_.size());
    fields.w = whole(at_nodes(moved_.w), 1);
    fields.u = whole(at_nodes(moved_.u), 1);
    fields.v = whole(at_nodes(moved_.v), -1);
    fields.pressure = whole(pressure_, 1);
    fields.shear_x = whole(model_.loaded->traction * pressure_, 1);
    fields.shear_y = fields.slip_x = fields.slip_y = whole(none, 1);
    for (const double pressure : fields.pressure) fields.zone.push_back(pressure > 0 ? Zone::stick : Zone::free);
    solution.contact_nodes = static_cast<int>(
        fields.zone.size() - static_cast<std::size_t>(std::count(fields.zone.begin(), fields.zone.end(), Zone::free)));
  }

 private:
  double value(const Vector& moved, int column, int row) const { return moved(row * (grid_.columns + 1) + column); }

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

  bool reaches_places() const {
    return std::all_of(model_.deflection_places.begin(), model_.deflection_places.end(), [&](const auto& place) {
      return place[0] > grid_.x(1) && place[0] < grid_.x(grid_.columns - 2) &&
             std::abs(place[1]) < grid_.y(grid_.rows - 2);
    });
  }

  double deflection(const std::array<double, 2>& place) const {
    const Interpolation along(place[0] / grid_.spacing_x), across(std::abs(place[1]) / grid_.spacing_y);
    double sum = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        sum += along.weights[static_cast<std::size_t>(i)] * across.weights[static_cast<std::size_t>(j)] *
               value(moved_.w, along.first + i - grid_.first_column, std::abs(across.first + j));
    return -sum;
  }

  const ContactModel& model_;
  SurfaceGrid grid_;
  Vector pressure_;
  Displacements moved_;
};

/// A number on grids that are refined: what it tends to, and its error.
class Extrapolated {
 public:
  /// @param finer  how many times the cells are smaller than before
  void add(double value, double finer) {
    if (count_++ == 0) {
      tends_to_ = last_ = value;
      error_ = INFINITY;
      return;
    }
    const double change = (value - last_) / (finer * finer - 1), before = tends_to_;
    tends_to_ = value + change;
    // Of one extrapolation, the part that is not of second order; of more, what they differ by.
    error_ =
        count_ == 2 ? unclear * std::abs(change) : std::max(std::abs(tends_to_ - before), least * std::abs(change));
    last_ = value;
  }

  double value() const { return tends_to_; }
  double error() const { return error_; }

 private:
  static constexpr double unclear = 0.5, least = 0.05;
  int count_ = 0;
  double last_ = 0, tends_to_ = 0, error_ = 0;
};

/// Cells along the load of the coarsest and the finest grid.
struct GridRange {
  int first, last;
};
GridRange cells_of(const ContactModel& model) {
  if (!model.spacing) return {usual_cells / 2, model.tolerance ? most_cells : usual_cells};
  const int cells = odd(checked_count(2 * model.loaded->half_length / *model.spacing, "cells along a given pressure"));
  return {odd(0.5 * cells), cells};
}

}  // namespace

RollingSolution solve_given_pressure(const ContactModel& model) {
  const LoadedArea& area = *model.loaded;
  const auto [first, last] = cells_of(model);
  std::vector<Extrapolated> numbers(3 + model.deflection_places.size());
  std::optional<PressedGrid> grid;
  bool to_places = true;
  int before = 0;
  for (int cells = first; cells <= last; cells = std::min(2 * cells + 1, std::max(last, cells + 1))) {
    const auto nodes = [&](bool reaching) { return static_cast<double>(grid_over(model, cells, reaching).size()); };
    if (before > usual_cells / 2 && nodes(true) > most_nodes / 8) to_places = false;
    if (nodes(to_places) > most_nodes) {
      if (before > 0) break;
      throw BeyondLimits(message_text("a grid that reaches all deflection_places has ", nodes(true),
                                      " nodes, more than ", most_nodes, ": leave out the farthest"));
    }
    grid.emplace(model, cells, to_places);
    const std::vector<double> found = grid->numbers();
    for (std::size_t i = 0; i < found.size(); ++i)
      numbers[i].add(found[i], before > 0 ? static_cast<double>(cells) / before : 1);
    const bool judged = before > 0;
    before = cells;
    const double scale =
        std::max(std::abs(numbers[0].value()), negligible * *model.load * numbers[2].value() / area.half_length);
    if (judged && model.tolerance && numbers[0].error() <= *model.tolerance * scale) break;
  }

  RollingSolution solution;
  solution.method = Method::convolution;
  solution.status = Status::converged;
  solution.load = *model.load;
  solution.rolling_resistance = numbers[0].value();
  solution.rolling_resistance_coefficient = solution.rolling_resistance / solution.load;
  set_error(numbers[0].error(), solution);
  solution.viscous_loss = solution.rolling_resistance * model.speed;
  solution.leading_edge = area.half_length;
  solution.trailing_edge = -area.half_length;
  solution.half_width = area.half_width;
  solution.contact_area = area.area();
  solution.mean_pressure = solution.load / solution.contact_area;
  solution.peak_pressure = area.peak_factor() * solution.mean_pressure;
  solution.edge_error = solution.contact_area_error = solution.peak_pressure_error = 0;
  solution.peak_shear_x = std::abs(area.traction) * solution.peak_pressure;
  solution.deflection = numbers[1].value();
  solution.peak_deflection = numbers[2].value();
  solution.peak_deflection_x = grid->deepest().x;
  solution.deflection_error = 0;
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    if (i > 2) solution.deflections.push_back(numbers[i].value());
    solution.deflection_error = std::max(solution.deflection_error, numbers[i].error());
  }
  solution.spacing = grid->grid().spacing_x;
  grid->keep_fields(solution);
  return solution;
}

}  // namespace rollres
