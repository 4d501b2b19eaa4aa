#pragma once

/// A problem of least squares: measured values, and a model that predicts them from parameters.
///
/// A point is the list of the parameters' values in SI units. Descents, errors and profiles live in scaled variables
/// (core/derivatives/objective.hpp), in which a change by 1 is a large one: ln x for a positive quantity.

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/derivatives/objective.hpp"
#include "fitting/descent/fit_ending.hpp"

namespace rollres {

struct FitParameter {
  std::string name;   ///< the key of its quantity, with its data set where it belongs to one only
  Variable variable;  ///< what it is, its bounds and its scale
  double start;       ///< [SI]
  /// Where other starts are looked for [SI]; NaN: a factor around the start.
  double usual_lowest = RollingSolution::absent, usual_highest = RollingSolution::absent;
  bool saturates = false;  ///< beyond some value it acts no longer: descents are tried from all over the usual ones
  bool has_least = false;  ///< below some value, which depends on the others, scenes have no answer
  double least = RollingSolution::absent;  ///< that value [SI], where a fit stands on it
};

struct MeasuredValue {
  double value;            ///< [SI]
  double deviation;        ///< standard deviation [SI]; where none is known, what residuals are measured in
  std::string place = {};  ///< "data.csv, line 7"
  int set = 0;             ///< data set that it belongs to; `of_prior`: none, it is what was known before
  std::string_view unit = {};
  double along = RollingSolution::absent;  ///< what a misfit is looked for along: the speed [SI]

  static constexpr int of_prior = -1;
  bool prior() const { return set == of_prior; }
};

using FitPoint = std::vector<double>;

/// What the model says of all measured values, or why it says nothing.
struct Prediction {
  Eigen::VectorXd values;  ///< [SI], one for each measurement
  std::string reason = {};
  FitPoint taken_at = {};  ///< if not at the point that was asked, which has none (nearest_answer.hpp)

  bool found() const { return reason.empty(); }
};

/// Derivatives of all predictions by the scaled parameters, or why there are none.
struct Slopes {
  Eigen::MatrixXd derivatives;  ///< [SI] a row for each measurement, a column for each parameter
  Eigen::MatrixXd errors;       ///< estimated, of the derivatives
  Eigen::VectorXd noise;        ///< of the predictions [SI]: standard deviation
  Eigen::VectorXd steps;        ///< of the differences, scaled, one for each parameter
  std::string reason = {};

  bool found() const { return reason.empty(); }
};

/// Derivatives that no difference gave: without error and without a step.
Slopes exact_slopes(Eigen::MatrixXd derivatives, Eigen::VectorXd noise);

/// What a residual r (in its deviation) adds to the sum of squares: r^2; or 2 c |r| - c^2 beyond c (Huber);
/// or c^2 ln(1 + r^2/c^2) (Cauchy).
enum class Loss { none, huber, cauchy };
template <>
struct ChoiceNames<Loss> {
  static constexpr std::array<std::string_view, 3> names{"none", "huber", "cauchy"};
};

/// The constant c with which the loss keeps 95 % of the efficiency of least squares on normal errors.
double usual_loss_scale(Loss loss);

/// How many scenes a fit evaluated, and which had no answer. May be written by several threads at once.
class EvaluationLog {
 public:
  struct Failure {
    std::string reason;
    std::string first_place;  ///< the measurement, "data.csv, line 7"
    std::size_t count = 0;
  };

  void answered() {
    const std::lock_guard lock(mutex_);
    ++evaluations_;
  }
  void failed(const std::string& place, const std::string& reason) {
    const std::lock_guard lock(mutex_);
    ++evaluations_;
    ++failures_;
    for (Failure& known : reasons_)
      if (known.reason == reason) {
        ++known.count;
        return;
      }
    if (reasons_.size() < most_reasons) reasons_.push_back({reason, place, 1});
  }

  std::size_t evaluations() const { return locked(evaluations_); }
  std::size_t failures() const { return locked(failures_); }
  std::vector<Failure> reasons() const { return locked(reasons_); }  ///< the first few that differ

 private:
  static constexpr std::size_t most_reasons = 8;

  template <class Value>
  Value locked(const Value& value) const {
    const std::lock_guard lock(mutex_);
    return value;
  }

  mutable std::mutex mutex_;
  std::size_t evaluations_ = 0, failures_ = 0;
  std::vector<Failure> reasons_;
};

/// Places in a list of data; none stand for all of them where a prediction is asked for.
using DataRows = std::vector<std::size_t>;

/// What predicts the measured values, and the slopes of the predictions. Asked by several threads at once.
struct FitModel {
  using Predict = std::function<Prediction(const FitPoint&, const DataRows&)>;

  Predict predict;
  std::function<Slopes(const FitPoint&, const Prediction&)> differentiate;
  bool by_rows = false;  ///< predicts some of the data, too, which costs less than all; else it is asked for all alone
};

struct FitProblem {
  std::vector<FitParameter> parameters;
  std::vector<MeasuredValue> data;
  bool deviations_known = false;  ///< else errors are scaled by the scatter of the residuals
  Loss loss = Loss::none;
  double loss_scale = 1;  ///< c [1]
  FitModel model;
  std::string noise_remedy = {};           ///< in words: what to do if the noise of the model is too large for the data
  std::vector<FitPoint> suggestions = {};  ///< points where a descent may well begin, beside the start
  FitModel::Predict estimate = {};         ///< roughly the predictions at no cost; may be empty
  std::shared_ptr<EvaluationLog> log = std::make_shared<EvaluationLog>();  ///< of what the model evaluated
  std::shared_ptr<FitEnding> ending = std::make_shared<FitEnding>();       ///< asked before every solution

  /// What the model says; nothing once the fit is over.
  Prediction predict(const FitPoint& point, const DataRows& rows = {}) const;
  Slopes differentiate(const FitPoint& point, const Prediction& prediction) const;
  std::size_t size() const { return parameters.size(); }
};

/// The problem with some of its data, and rough slopes. The model must predict by rows.
FitProblem part_of(const FitProblem& problem, const DataRows& rows);

std::vector<Variable> variables_of(const FitProblem& problem);
/// Slopes at a point, by other scaled variables.
Slopes in_variables(Slopes slopes, const FitPoint& point, const std::vector<Variable>& from,
                    const std::vector<Variable>& to);
/// The same problem in other scaled variables of the same parameters.
FitProblem in_variables(const FitProblem& problem, const std::vector<Variable>& variables);
/// In logarithms wherever a parameter cannot be negative and does not start at 0: a descent from afar changes it by
/// factors.
FitProblem in_logarithms(const FitProblem& problem);
/// The reciprocal of a parameter, sized at a value of it, up to a thousand times that.
Variable reciprocal_at(const FitParameter& parameter, double value);
/// With the sizes of linear variables as they are at a point.
FitProblem sized_at(const FitProblem& problem, const FitPoint& point);

FitPoint start_point(const FitProblem& problem);
Eigen::VectorXd scaled_point(const FitProblem& problem, const FitPoint& point);
/// Clamped to the bounds.
FitPoint point_of(const FitProblem& problem, const Eigen::VectorXd& scaled);

/// (prediction - measurement) / deviation.
Eigen::VectorXd residuals(const FitProblem& problem, const Prediction& prediction);

/// The loss of a residual, and its derivative by the residual's square: the weight of the residual. What was known
/// before is no outlier: its loss is the square.
struct LossValue {
  double value, weight;
};
LossValue loss_of(const FitProblem& problem, std::size_t datum, double residual);

/// The sum of the losses: chi squared if there is no robust loss.
double misfit(const FitProblem& problem, const Eigen::VectorXd& residuals);

/// Derivatives to a few per cent from one more prediction for each parameter, a scaled step away: enough to begin a
/// descent with. Steps stay inside the bounds; errors and noise are left at 0.
Slopes rough_differences(const FitProblem& problem, const FitPoint& point, const Prediction& prediction);

/// Derivatives by differences with one step for all parameters: for models that cost little, and steps that are
/// forced. Central with four points, or one-sided with five near a bound: no point outside the bounds is evaluated.
/// @param step   scaled
/// @param noise  of each prediction [SI], for the errors
Slopes differences(const FitProblem& problem, const FitPoint& point, const Prediction& prediction, double step,
                   const Eigen::VectorXd& noise);

}  // namespace rollres
