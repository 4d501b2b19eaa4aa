#include "fitting/fit/resistance_fit.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "core/derivatives/gradient.hpp"
#include "core/numerics/parallel.hpp"
#include "core/scene/scene_input.hpp"
#include "core/surface/scene_rules.hpp"

namespace rollres {

namespace {

bool concerns(const FittedInput& input, const std::string& set) { return input.set.empty() || input.set == set; }

/// One scene's output as a function of the inputs that concern it.
struct Row {
  Objective objective;
  std::vector<std::size_t> columns;  // of these inputs among all
  std::string place;

  FitPoint own(const FitPoint& point) const {
    FitPoint values;
    for (const std::size_t column : columns) values.push_back(point[column]);
    return values;
  }
};

/// What calibrations on some rows say of every row: all over the size of the output.
struct RelativeCalibration {
  double noise = RollingSolution::absent;
  std::array<double, 4> derivatives{RollingSolution::absent, RollingSolution::absent, RollingSolution::absent,
                                    RollingSolution::absent};

  void include(const InputCalibration& known, double output) {
    const auto raise = [&](double& bound, double value) {
      if (std::isfinite(value) && !(bound >= value / std::abs(output))) bound = value / std::abs(output);
    };
    // Other rows may be noisier; one-sided differences bear that much.
    constexpr double least_noise = 1e-9;
    raise(noise, std::max(known.noise, least_noise * std::abs(output)));
    for (std::size_t k = 0; k < derivatives.size(); ++k) raise(derivatives[k], known.derivatives[k]);
  }
  bool known() const { return std::isfinite(noise); }
  InputCalibration of(double output) const {
    InputCalibration calibration;
    calibration.noise = noise * std::abs(output);
    for (std::size_t k = 0; k < derivatives.size(); ++k) calibration.derivatives[k] = derivatives[k] * std::abs(output);
    return calibration;
  }
};

class Model {
 public:
  /// @param on_grid  becomes true with the first answer from a grid
  Model(std::vector<Row> rows, std::size_t inputs, std::shared_ptr<std::atomic<bool>> on_grid, int jobs)
      : rows_(std::move(rows)), calibrations_(inputs), on_grid_(std::move(on_grid)), jobs_(jobs) {}

  Prediction predict(const FitPoint& point, const std::vector<std::size_t>& rows) const {
    Prediction prediction{Eigen::VectorXd(std::ssize(rows))};
    std::vector<std::string> reasons(rows.size());
    for_each_piece(rows.size(), jobs_, [&](std::size_t i) {
      const Row& row = rows_[rows[i]];
      const ObjectiveValue answer = value_at(row.objective, row.own(point));
      prediction.values[static_cast<Eigen::Index>(i)] = answer.value;
      if (!answer.found()) reasons[i] = row.place + ": " + answer.reason;
    });
    for (std::string& reason : reasons)
      if (prediction.reason.empty()) prediction.reason = std::move(reason);
    return prediction;
  }

  Prediction predict(const FitPoint& point) const {
    std::vector<std::size_t> all(rows_.size());
    std::iota(all.begin(), all.end(), 0);
    return predict(point, all);
  }

  Slopes differentiate(const FitPoint& point, const Prediction& prediction) {
    calibrate_at(point);
    Slopes slopes{Eigen::MatrixXd::Zero(std::ssize(rows_), std::ssize(calibrations_)),
                  Eigen::MatrixXd::Zero(std::ssize(rows_), std::ssize(calibrations_)), noise_of(prediction),
                  Eigen::VectorXd::Zero(std::ssize(calibrations_))};
    std::vector<std::string> reasons(rows_.size());
    const int order = largest_noise() < smooth && !*on_grid_ ? 1 : 2;
    std::mutex mutex;
    for_each_piece(rows_.size(), jobs_, [&](std::size_t i) {
      const auto row = static_cast<Eigen::Index>(i);
      const double centre = prediction.values[row];
      Calibration calibration{rows_[i].own(point), {centre, Status::converged}, {}};
      for (const std::size_t column : rows_[i].columns) calibration.inputs.push_back(calibrations_[column].of(centre));
      const Gradient found = gradient(rows_[i].objective, calibration.point, calibration, {.order = order, .jobs = 1});
      for (std::size_t k = 0; k < found.inputs.size(); ++k) {
        const InputGradient& input = found.inputs[k];
        const auto column = static_cast<Eigen::Index>(rows_[i].columns[k]);
        if (input.scheme == Scheme::none) {
          reasons[i] = rows_[i].place + ": no derivative by " +
                       std::string(rows_[i].objective.variables[k].quantity.key) +
                       (input.failures.empty() ? "" : ": " + input.failures.front().reason);
          continue;
        }
        const double slope = std::abs(rows_[i].objective.variables[k].slope(calibration.point[k]));
        slopes.derivatives(row, column) = input.derivative * slope;
        slopes.errors(row, column) = input.error() * slope;
        const std::lock_guard lock(mutex);
        slopes.steps[column] = std::max(slopes.steps[column], input.step);
      }
    });
    for (std::string& reason : reasons)
      if (slopes.reason.empty()) slopes.reason = std::move(reason);
    return slopes;
  }

  /// Measures noise and curvature where that is not done yet: on a middle row, and where that is not smooth, on the
  /// slowest and the fastest as well.
  void calibrate_at(const FitPoint& point) {
    const std::lock_guard one_at_a_time(calibrating_);
    std::vector<std::size_t> unknown;
    for (std::size_t column = 0; column < calibrations_.size(); ++column)
      if (!calibrations_[column].known()) unknown.push_back(column);
    if (unknown.empty()) return;
    std::vector<Piece> middle, others;
    for (const std::size_t column : unknown) {
      const std::vector<std::size_t> rows = examples(column);
      for (const std::size_t row : rows) (row == rows.front() ? middle : others).push_back({column, row});
    }
    calibrate_pieces(middle, point);
    const bool smooth_there = std::all_of(unknown.begin(), unknown.end(),
                                          [&](std::size_t column) { return calibrations_[column].noise < smooth; });
    if (!smooth_there || *on_grid_) calibrate_pieces(others, point);
  }

  Eigen::VectorXd noise_of(const Prediction& prediction) const {
    return largest_noise() * prediction.values.cwiseAbs();
  }

 private:
  /// Relative noise below which differences to one side, and a calibration on one row, are good enough.
  static constexpr double smooth = 1e-7;

  struct Piece {
    std::size_t column, row;
  };

  double largest_noise() const {
    double relative = 0;
    for (const RelativeCalibration& calibration : calibrations_)
      if (calibration.known()) relative = std::max(relative, calibration.noise);
    return relative;
  }

  void calibrate_pieces(const std::vector<Piece>& pieces, const FitPoint& point) {
    std::mutex mutex;
    for_each_piece(pieces.size(), jobs_, [&](std::size_t i) {
      const auto [column, row] = pieces[i];
      Objective along = rows_[row].objective;  // this input alone
      along.base = scene_at(along, rows_[row].own(point));
      const auto place = std::find(rows_[row].columns.begin(), rows_[row].columns.end(), column);
      along.variables = {along.variables[static_cast<std::size_t>(place - rows_[row].columns.begin())]};
      const Calibration found = calibrate(along, FitPoint{point[column]}, 1);
      if (!found.centre.found()) return;
      const std::lock_guard lock(mutex);
      calibrations_[column].include(found.inputs.front(), found.centre.value);
    });
  }

  /// A middle, the slowest and the fastest of the rows that an input concerns.
  std::vector<std::size_t> examples(std::size_t column) const {
    std::vector<std::size_t> concerned;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (std::find(rows_[i].columns.begin(), rows_[i].columns.end(), column) != rows_[i].columns.end())
        concerned.push_back(i);
    std::stable_sort(concerned.begin(), concerned.end(), [&](std::size_t a, std::size_t b) {
      return rows_[a].objective.base.speed < rows_[b].objective.base.speed;
    });
    if (concerned.empty()) return {};
    std::vector<std::size_t> found{concerned[concerned.size() / 2]};
    for (const std::size_t row : {concerned.front(), concerned.back()})
      if (std::find(found.begin(), found.end(), row) == found.end()) found.push_back(row);
    return found;
  }

  std::vector<Row> rows_;
  std::vector<RelativeCalibration> calibrations_;
  std::shared_ptr<std::atomic<bool>> on_grid_;
  std::mutex calibrating_;
  int jobs_;
};

/// Evaluates, and enters it in the log.
Evaluate logging(const Evaluate& evaluate, const std::shared_ptr<EvaluationLog>& log, const std::string& place,
                 const std::shared_ptr<std::atomic<bool>>& on_grid) {
  return [evaluate, log, place, on_grid](const RollingScene& scene) {
    RollingSolution solution = evaluate(scene);
    if (solution.status == Status::converged && rollres::on_grid(solution.method)) *on_grid = true;
    if (solution.status == Status::converged)
      log->answered();
    else
      log->failed(place, solution.reason.empty() ? std::string(name_of(solution.status)) : solution.reason);
    return solution;
  };
}

/// What helps where nodes that enter and leave the contact make a scene's answers jump.
std::string noise_remedy(const std::vector<MeasuredScene>& scenes) {
  const auto fixed = std::find_if(scenes.begin(), scenes.end(), [](const MeasuredScene& row) {
    return on_grid(resolved_method(row.scene)) && (row.scene.spacing || row.scene.indenter == Indenter::cylinder);
  });
  if (fixed == scenes.end()) return "";
  const RollingScene& scene = fixed->scene;
  RollingScene smooth = scene;
  smooth.spacing.reset();
  if (smooth.method == Method::newton) smooth.method = Method::automatic;
  const std::string jumps = "answers on a fixed grid jump where nodes enter and leave the contact";
  if (scene.indenter == Indenter::cylinder && on_grid(resolved_method(smooth)))
    return jumps + ": take a smaller spacing";
  std::string keys;
  if (scene.spacing) keys = "spacing";
  if (scene.indenter == Indenter::cylinder && scene.method != Method::automatic)
    keys += keys.empty() ? "method" : " and method";
  return jumps + ": leave out " + keys + " for smooth ones";
}

}  // namespace

std::vector<FitParameter> fit_parameters(const std::vector<MeasuredScene>& scenes,
                                         const std::vector<FittedInput>& inputs) {
  std::vector<FitParameter> parameters;
  for (const FittedInput& input : inputs) {
    const auto first = std::find_if(scenes.begin(), scenes.end(),
                                    [&](const MeasuredScene& scene) { return concerns(input, scene.set); });
    if (first == scenes.end())
      throw std::invalid_argument(input.input.key + ": concerns no measured value of a data set \"" + input.set + '"');
    RollingScene base = first->scene;
    if (input.start) assign_real(base, input.input.key, *input.start);
    const Variable variable = variables_of(base, {input.input}).front();
    const double start = base_point({base, {variable}, {}, {}}).front();
    parameters.push_back({input.input.key + (input.set.empty() ? "" : " (" + input.set + ")"), variable, start});
  }
  return parameters;
}

FitProblem resistance_problem(const std::vector<MeasuredScene>& scenes, const std::vector<FittedInput>& inputs,
                              const std::vector<FitParameter>& parameters, const Evaluate& evaluate,
                              const ResistanceFitOptions& options) {
  FitProblem problem;
  problem.parameters = parameters;
  const Quantity output = real_output(options.output);
  const auto grid_seen = std::make_shared<std::atomic<bool>>(false);
  std::vector<Row> rows;
  for (const MeasuredScene& measured : scenes) {
    Row row{{measured.scene, {}, output, logging(evaluate, problem.log, measured.measured.place, grid_seen)},
            {},
            measured.measured.place};
    for (std::size_t j = 0; j < inputs.size(); ++j)
      if (concerns(inputs[j], measured.set)) {
        row.objective.variables.push_back(problem.parameters[j].variable);
        row.columns.push_back(j);
      }
    rows.push_back(std::move(row));
    problem.data.push_back(measured.measured);
  }
  const auto model = std::make_shared<Model>(std::move(rows), inputs.size(), grid_seen, options.jobs);
  problem.predict = [model](const FitPoint& point) { return model->predict(point); };
  problem.predict_rows = [model](const FitPoint& point, const std::vector<std::size_t>& some) {
    return model->predict(point, some);
  };
  problem.noise_remedy = noise_remedy(scenes);
  if (!options.step) {
    problem.differentiate = [model](const FitPoint& point, const Prediction& prediction) {
      return model->differentiate(point, prediction);
    };
  } else {
    const FitProblem plain = problem;
    problem.differentiate = [model, plain, step = *options.step](const FitPoint& point, const Prediction& prediction) {
      model->calibrate_at(point);
      return differences(plain, point, prediction, step, model->noise_of(prediction));
    };
  }
  return problem;
}

}  // namespace rollres
