#pragma once

/// Outputs of scenes as functions of the inputs that a fit varies, with their slopes by differences that suit the
/// noise.

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/derivatives/calibration.hpp"
#include "core/derivatives/objective.hpp"
#include "fitting/descent/fit_problem.hpp"

namespace rollres {

/// One scene's output as a function of the inputs that concern it.
struct SceneRow {
  Objective objective;
  std::vector<std::size_t> columns;  // of these inputs among all
  std::string place;

  FitPoint own(const FitPoint& point) const {
    FitPoint values;
    for (const std::size_t column : columns) values.push_back(point[column]);
    return values;
  }

  const Variable& variable(std::size_t column) const {
    return objective
        .variables[static_cast<std::size_t>(std::find(columns.begin(), columns.end(), column) - columns.begin())];
  }

  /// The objective of some of the inputs, the others as they are at a point; a linear one in the size that it has
  /// there, for a start may be far off.
  Objective along(const std::vector<std::size_t>& some, const FitPoint& point) const {
    Objective part = objective;
    part.base = scene_at(objective, own(point));
    part.variables.clear();
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (contains(some, columns[k])) part.variables.push_back(objective.variables[k]);
    for (Variable& one : part.variables) {
      const double here = std::abs(real_input(part.base, one.quantity.key));
      if (one.scaling == Scaling::linear && one.quantity.range.lowest >= 0 && here > 1e-3 * one.size) one.size = here;
    }
    return part;
  }
};

/// What calibrations on some rows say of every row: all over the size of the output.
struct RelativeCalibration {
  FunctionSize size;

  void include(const InputCalibration& found, double output) {
    const auto raise = [&](double& bound, double value) {
      if (std::isfinite(value) && !(bound >= value / std::abs(output))) bound = value / std::abs(output);
    };
    // Other rows may be noisier; one-sided differences bear that much.
    constexpr double least_noise = 1e-9;
    raise(size.noise, std::max(found.size.noise, least_noise * std::abs(output)));
    for (std::size_t k = 0; k < size.derivatives.size(); ++k) raise(size.derivatives[k], found.size.derivatives[k]);
    size.reach = std::min(size.reach, found.size.reach);
  }
  bool known() const { return std::isfinite(size.noise); }
  InputCalibration of(double output) const {
    InputCalibration calibration{size};
    calibration.size.noise *= std::abs(output);
    for (double& derivative : calibration.size.derivatives) derivative *= std::abs(output);
    return calibration;
  }
};

/// Answers for all rows, on several threads; may be asked by several at once.
class SceneModel {
 public:
  /// @param on_grid  becomes true with the first answer from a grid
  SceneModel(std::vector<SceneRow> rows, std::size_t inputs, std::shared_ptr<std::atomic<bool>> on_grid, int jobs)
      : rows_(std::move(rows)), calibrations_(inputs), on_grid_(std::move(on_grid)), jobs_(jobs) {}

  Prediction predict(const FitPoint& point, const DataRows& some) const;

  Slopes differentiate(const FitPoint& point, const Prediction& prediction);

  /// Measures noise and curvature where that is not done yet, or was far from here: on a middle row, of constants of a
  /// shift on the one farthest from the reference temperature, and where that is not smooth, on others as well.
  void calibrate_at(const FitPoint& point);

  Eigen::VectorXd noise_of(const Prediction& prediction) const;

 private:
  /// Relative noise below which differences to one side, and a calibration on one row, are good enough.
  static constexpr double smooth = 1e-7;

  struct Piece {
    std::size_t column, row;
  };

  bool is_smooth(std::size_t column) const { return calibrations_[column].size.noise < smooth && !*on_grid_; }

  double largest_noise() const;

  void calibrate_pieces(const std::vector<Piece>& pieces, const FitPoint& point);

  /// A middle, the slowest and the fastest of the rows that an input concerns.
  std::vector<std::size_t> examples(std::size_t column) const;

  std::vector<SceneRow> rows_;
  std::vector<RelativeCalibration> calibrations_;
  std::shared_ptr<std::atomic<bool>> on_grid_;
  std::mutex calibrating_;
  FitPoint calibrated_at_;
  int jobs_;
};

}  // namespace rollres
