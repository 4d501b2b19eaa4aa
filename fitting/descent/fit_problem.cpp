#include "fitting/descent/fit_problem.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/numerics/finite_difference.hpp"

namespace rollres {

namespace {

/// Offsets of a formula inside the bounds of a parameter, from the scaled value `from`.
std::vector<double> offsets_inside(const Variable& variable, double from, double step) {
  const double below = from - variable.scaled(variable.lowest), above = variable.scaled(variable.highest) - from;
  if (below >= 2 * step && above >= 2 * step) return {-2 * step, -step, step, 2 * step};
  const double room = std::min(std::max(below, above) / 4, step);
  const double side = above >= below ? room : -room;
  return {0, side, 2 * side, 3 * side, 4 * side};
}

}  // namespace

Slopes exact_slopes(Eigen::MatrixXd derivatives, Eigen::VectorXd noise) {
  const Eigen::Index rows = derivatives.rows(), columns = derivatives.cols();
  return {std::move(derivatives), Eigen::MatrixXd::Zero(rows, columns), std::move(noise),
          Eigen::VectorXd::Constant(columns, RollingSolution::absent)};
}

double usual_loss_scale(Loss loss) { return loss == Loss::huber ? 1.345 : loss == Loss::cauchy ? 2.385 : 1; }

Prediction FitProblem::predict(const FitPoint& point, const DataRows& rows) const {
  Prediction none;
  if (ending->reached()) none.reason = ending->why();
  return none.found() ? model.predict(point, rows) : none;
}

Slopes FitProblem::differentiate(const FitPoint& point, const Prediction& prediction) const {
  Slopes none;
  if (ending->reached()) none.reason = ending->why();
  return none.found() ? model.differentiate(point, prediction) : none;
}

FitProblem part_of(const FitProblem& problem, const DataRows& rows) {
  FitProblem part = problem;
  part.data.clear();
  for (const std::size_t row : rows) part.data.push_back(problem.data[row]);
  part.model.predict = [predict = problem.model.predict, rows](const FitPoint& point, const DataRows& some) {
    DataRows own;
    for (const std::size_t row : some) own.push_back(rows[row]);
    return predict(point, some.empty() ? rows : own);
  };
  part.model.differentiate = [plain = part](const FitPoint& point, const Prediction& prediction) {
    return rough_differences(plain, point, prediction);
  };
  return part;
}

std::vector<Variable> variables_of(const FitProblem& problem) {
  std::vector<Variable> variables;
  for (const FitParameter& parameter : problem.parameters) variables.push_back(parameter.variable);
  return variables;
}

Slopes in_variables(Slopes slopes, const FitPoint& point, const std::vector<Variable>& from,
                    const std::vector<Variable>& to) {
  for (std::size_t j = 0; slopes.found() && j < point.size(); ++j) {
    const double factor = std::abs(to[j].slope(point[j]) / from[j].slope(point[j]));
    slopes.derivatives.col(static_cast<Eigen::Index>(j)) *= factor;
    slopes.errors.col(static_cast<Eigen::Index>(j)) *= factor;
    slopes.steps[static_cast<Eigen::Index>(j)] /= factor;
  }
  return slopes;
}

FitProblem in_variables(const FitProblem& problem, const std::vector<Variable>& variables) {
  FitProblem other = problem;
  const std::vector<Variable> own = variables_of(problem);
  for (std::size_t j = 0; j < problem.size(); ++j) other.parameters[j].variable = variables[j];
  other.model.differentiate = [own, variables, differentiate = problem.model.differentiate](
                                  const FitPoint& point, const Prediction& prediction) {
    return in_variables(differentiate(point, prediction), point, own, variables);
  };
  return other;
}

FitProblem in_logarithms(const FitProblem& problem) {
  constexpr double smallest = 1e-6;  // of the start: a lower bound where 0 is none
  std::vector<Variable> variables;
  for (const FitParameter& parameter : problem.parameters) {
    Variable variable = parameter.variable;
    if (variable.scaling == Scaling::linear && variable.quantity.range.lowest >= 0 && variable.lowest >= 0 &&
        parameter.start > 0) {
      variable.scaling = Scaling::logarithmic;
      variable.size = 1;
      variable.lowest = std::max(variable.lowest, smallest * parameter.start);
    }
    variables.push_back(variable);
  }
  return in_variables(problem, variables);
}

FitProblem sized_at(const FitProblem& problem, const FitPoint& point) {
  std::vector<Variable> variables;
  for (std::size_t j = 0; j < problem.size(); ++j) {
    Variable variable = problem.parameters[j].variable;
    const bool vanished = std::abs(point[j]) < 1e-3 * variable.size;  // then the size is the only one there is
    if (variable.scaling == Scaling::linear && variable.quantity.range.lowest >= 0 && !vanished)
      variable.size = std::abs(point[j]);
    variables.push_back(variable);
  }
  return in_variables(problem, variables);
}

Variable reciprocal_at(const FitParameter& parameter, double value) {
  constexpr double farthest = 1000;
  Variable variable = parameter.variable;
  variable.scaling = Scaling::reciprocal;
  variable.size = value;
  variable.highest = std::min(variable.highest, std::max(farthest * value, parameter.start));
  return variable;
}

FitPoint start_point(const FitProblem& problem) {
  FitPoint point;
  for (const FitParameter& parameter : problem.parameters) point.push_back(parameter.start);
  return point;
}

Eigen::VectorXd scaled_point(const FitProblem& problem, const FitPoint& point) {
  assert(point.size() == problem.size());
  Eigen::VectorXd scaled(std::ssize(point));
  for (std::size_t j = 0; j < point.size(); ++j)
    scaled[static_cast<Eigen::Index>(j)] = problem.parameters[j].variable.scaled(point[j]);
  return scaled;
}

FitPoint point_of(const FitProblem& problem, const Eigen::VectorXd& scaled) {
  FitPoint point;
  for (std::size_t j = 0; j < problem.size(); ++j)
    point.push_back(problem.parameters[j].variable.value(scaled[static_cast<Eigen::Index>(j)]));
  return point;
}

Eigen::VectorXd residuals(const FitProblem& problem, const Prediction& prediction) {
  Eigen::VectorXd answer(std::ssize(problem.data));
  for (Eigen::Index i = 0; i < answer.size(); ++i) {
    const MeasuredValue& measured = problem.data[static_cast<std::size_t>(i)];
    answer[i] = (prediction.values[i] - measured.value) / measured.deviation;
  }
  return answer;
}

LossValue loss_of(const FitProblem& problem, std::size_t datum, double residual) {
  const double c = problem.loss_scale, square = c * c, s = residual * residual;
  if (problem.data[datum].prior()) return {s, 1};
  if (problem.loss == Loss::huber && s > square) return {2 * c * std::sqrt(s) - square, c / std::sqrt(s)};
  if (problem.loss == Loss::cauchy) return {square * std::log1p(s / square), 1 / (1 + s / square)};
  return {s, 1};
}

double misfit(const FitProblem& problem, const Eigen::VectorXd& residuals) {
  double sum = 0;
  for (std::size_t i = 0; i < problem.data.size(); ++i)
    sum += loss_of(problem, i, residuals[static_cast<Eigen::Index>(i)]).value;
  return sum;
}

Slopes rough_differences(const FitProblem& problem, const FitPoint& point, const Prediction& prediction) {
  constexpr double step = 0.02;
  const Eigen::Index rows = prediction.values.size(), columns = std::ssize(point);
  Slopes slopes{Eigen::MatrixXd::Zero(rows, columns), Eigen::MatrixXd::Zero(rows, columns), Eigen::VectorXd::Zero(rows),
                Eigen::VectorXd::Constant(columns, step)};
  for (std::size_t j = 0; j < point.size(); ++j) {
    const Variable& variable = problem.parameters[j].variable;
    const double from = variable.scaled(point[j]);
    const bool room_above = variable.scaled(variable.highest) - from >= from - variable.scaled(variable.lowest) ||
                            variable.scaled(variable.highest) - from >= step;
    FitPoint moved = point;
    moved[j] = variable.value(from + (room_above ? step : -step));
    const Prediction there = problem.predict(moved);
    if (!there.found()) {
      slopes.reason = there.reason;
      return slopes;
    }
    slopes.derivatives.col(static_cast<Eigen::Index>(j)) =
        (there.values - prediction.values) / variable.scaled_step(point[j], moved[j]);
  }
  return slopes;
}

Slopes differences(const FitProblem& problem, const FitPoint& point, const Prediction& prediction, double step,
                   const Eigen::VectorXd& noise) {
  const Eigen::Index rows = prediction.values.size(), columns = std::ssize(point);
  Slopes slopes{Eigen::MatrixXd::Zero(rows, columns), Eigen::MatrixXd::Zero(rows, columns), noise,
                Eigen::VectorXd::Constant(columns, step)};
  for (Eigen::Index j = 0; j < columns; ++j) {
    const Variable& variable = problem.parameters[static_cast<std::size_t>(j)].variable;
    const double centre = point[static_cast<std::size_t>(j)];
    std::vector<double> taken;
    std::vector<Eigen::VectorXd> changes;
    for (const double offset : offsets_inside(variable, variable.scaled(centre), step)) {
      FitPoint moved = point;
      double& value = moved[static_cast<std::size_t>(j)];
      if (offset != 0) value = variable.value(variable.scaled(centre) + offset);
      taken.push_back(variable.scaled_step(centre, value));
      const Prediction there = offset == 0 ? prediction : problem.predict(moved);
      if (!there.found()) {
        slopes.reason = there.reason;
        return slopes;
      }
      changes.push_back(there.values - prediction.values);
    }
    const std::vector<double> weights = first_derivative_weights(taken);
    double squares = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      slopes.derivatives.col(j) += weights[k] * changes[k];
      squares += weights[k] * weights[k];
    }
    slopes.errors.col(j) = std::sqrt(squares) * noise;
  }
  return slopes;
}

}  // namespace rollres
