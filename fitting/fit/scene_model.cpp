#include "fitting/fit/scene_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

#include "core/derivatives/gradient.hpp"
#include "core/numerics/parallel.hpp"

namespace rollres {

namespace {

/// Whether a parameter differs by a third.
bool is_far(const FitPoint& point, const FitPoint& other) {
  constexpr double third = 1.0 / 3;
  if (other.empty()) return true;
  for (std::size_t j = 0; j < point.size(); ++j)
    if (std::abs(point[j] - other[j]) > third * std::max(std::abs(point[j]), std::abs(other[j]))) return true;
  return false;
}

/// For a constant of a law of shift how far its layer is from the reference temperature [K], where it has no effect; 0
/// for other inputs.
double shift_reach(const SceneRow& row, std::size_t column) {
  constexpr std::array<std::string_view, 5> constants{"wlf_c1", "wlf_c2", "activation_energy", "vft_b",
                                                      "vft_temperature"};
  const std::string key(row.variable(column).quantity.key);
  const std::size_t dot = key.rfind('.');
  const std::string owner = dot == std::string::npos ? "" : key.substr(0, dot + 1);
  if (find_name(constants, std::string_view(key).substr(owner.size())) < 0) return 0;
  const RollingScene& scene = row.objective.base;
  return std::abs(real_input(scene, owner + "temperature") - real_input(scene, owner + "reference_temperature"));
}

}  // namespace

Prediction SceneModel::predict(const FitPoint& point, const DataRows& some) const {
  DataRows rows = some;
  if (rows.empty()) {
    rows.resize(rows_.size());
    std::iota(rows.begin(), rows.end(), 0);
  }
  Prediction prediction{Eigen::VectorXd::Constant(std::ssize(rows), RollingSolution::absent)};
  std::vector<std::string> reasons(rows.size());
  for_each_piece(rows.size(), jobs_, [&](std::size_t i) {
    const SceneRow& row = rows_[rows[i]];
    const ObjectiveValue answer = value_at(row.objective, row.own(point));
    prediction.values[static_cast<Eigen::Index>(i)] = answer.value;
    if (!answer.found()) reasons[i] = row.place + ": " + answer.reason;
  });
  for (std::string& reason : reasons)
    if (prediction.reason.empty()) prediction.reason = std::move(reason);
  return prediction;
}

Slopes SceneModel::differentiate(const FitPoint& point, const Prediction& prediction) {
  calibrate_at(point);
  Slopes slopes{Eigen::MatrixXd::Zero(std::ssize(rows_), std::ssize(calibrations_)),
                Eigen::MatrixXd::Zero(std::ssize(rows_), std::ssize(calibrations_)), noise_of(prediction),
                Eigen::VectorXd::Zero(std::ssize(calibrations_))};
  std::vector<std::string> reasons(rows_.size());
  std::mutex mutex;
  for_each_piece(rows_.size(), jobs_, [&](std::size_t i) {
    const double centre = prediction.values[static_cast<Eigen::Index>(i)];
    for (const bool smooth_ones : {true, false}) {  // differences to one side, to both
      std::vector<std::size_t> columns;
      for (const std::size_t column : rows_[i].columns)
        if (is_smooth(column) == smooth_ones) columns.push_back(column);
      if (columns.empty()) continue;
      const Objective along = rows_[i].along(columns, point);
      Calibration calibration{base_point(along), {.value = centre, .status = Status::converged}, {}};
      for (const std::size_t column : columns) calibration.inputs.push_back(calibrations_[column].of(centre));
      const Gradient found = gradient(along, calibration.point, calibration, {.order = smooth_ones ? 1 : 2, .jobs = 1});
      for (std::size_t k = 0; k < columns.size(); ++k) {
        const InputGradient& input = found.inputs[k];
        if (input.scheme == Scheme::none) {
          reasons[i] = rows_[i].place + ": no derivative by " + std::string(along.variables[k].quantity.key) +
                       (input.failures.empty() ? "" : ": " + input.failures.front().reason);
          continue;
        }
        const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(columns[k]);
        const double slope = std::abs(rows_[i].variable(columns[k]).slope(calibration.point[k]));
        slopes.derivatives(row, column) = input.derivative * slope;
        slopes.errors(row, column) = input.error() * slope;
        const std::lock_guard lock(mutex);
        slopes.steps[column] = std::max(slopes.steps[column],
                                        input.step * std::abs(along.variables[k].slope(calibration.point[k])) / slope);
      }
    }
  });
  for (std::string& reason : reasons)
    if (slopes.reason.empty()) slopes.reason = std::move(reason);
  return slopes;
}

void SceneModel::calibrate_at(const FitPoint& point) {
  const std::lock_guard one_at_a_time(calibrating_);
  if (is_far(point, calibrated_at_)) {  // what was measured there says little of here
    calibrations_.assign(calibrations_.size(), {});
    calibrated_at_ = point;
  }
  std::vector<std::size_t> unknown;
  for (std::size_t column = 0; column < calibrations_.size(); ++column)
    if (!calibrations_[column].known() && !examples(column).empty()) unknown.push_back(column);
  if (unknown.empty()) return;
  std::vector<Piece> middle, others;
  for (const std::size_t column : unknown) {
    const std::vector<std::size_t> rows = examples(column);
    for (const std::size_t row : rows) (row == rows.front() ? middle : others).push_back({column, row});
  }
  calibrate_pieces(middle, point);
  const bool smooth_there =
      all_of(unknown, [&](std::size_t column) { return calibrations_[column].size.noise < smooth; });
  if (!smooth_there || *on_grid_) calibrate_pieces(others, point);
}

Eigen::VectorXd SceneModel::noise_of(const Prediction& prediction) const {
  return largest_noise() * prediction.values.cwiseAbs();
}

double SceneModel::largest_noise() const {
  double relative = 0;
  for (const RelativeCalibration& calibration : calibrations_)
    if (calibration.known()) relative = std::max(relative, calibration.size.noise);
  return relative;
}

void SceneModel::calibrate_pieces(const std::vector<Piece>& pieces, const FitPoint& point) {
  std::mutex mutex;
  for_each_piece(pieces.size(), jobs_, [&](std::size_t i) {
    const auto [column, row] = pieces[i];
    const Objective along = rows_[row].along({column}, point);
    const Calibration found = calibrate(along, FitPoint{point[column]}, 1);
    if (!found.centre.found()) return;
    const std::lock_guard lock(mutex);
    calibrations_[column].include(found.inputs.front(), found.centre.value);
  });
}

std::vector<std::size_t> SceneModel::examples(std::size_t column) const {
  std::vector<std::size_t> concerned;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (contains(rows_[i].columns, column)) concerned.push_back(i);
  stable_sort(concerned, [&](std::size_t a, std::size_t b) {
    return rows_[a].objective.base.speed < rows_[b].objective.base.speed;
  });
  if (concerned.empty()) return {};
  std::vector<std::size_t> found{concerned[concerned.size() / 2]};
  for (const std::size_t row : {concerned.front(), concerned.back()})
    if (!contains(found, row)) found.push_back(row);
  const auto farthest = max_element(concerned, [&](std::size_t a, std::size_t b) {
    return shift_reach(rows_[a], column) < shift_reach(rows_[b], column);
  });
  if (shift_reach(rows_[*farthest], column) > 0) {  // there its effect, and so the curvature, is largest
    std::erase(found, *farthest);
    found.insert(found.begin(), *farthest);
  }
  return found;
}

}  // namespace rollres
