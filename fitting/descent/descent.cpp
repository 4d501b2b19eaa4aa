#include "fitting/descent/descent.hpp"

#include <ceres/ceres.h>
#if __has_include(<glog/logging.h>)
#include <glog/logging.h>
#endif

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace rollres {

namespace {

/// Predictions and slopes for all residuals at once: where Ceres is, and for what it asks there.
class Position : public ceres::EvaluationCallback {
 public:
  Position(const FitProblem& problem, const FitPoint& start)
      : problem_(problem), scaled_(scaled_point(problem, start)) {
    best_.prediction.reason = "not evaluated";
  }

  struct Best {
    Eigen::VectorXd scaled;
    double misfit = std::numeric_limits<double>::infinity();
    Prediction prediction;
  };

  void PrepareForEvaluation(bool with_slopes, bool /*moved*/) final {
    if (at_.size() == 0 || at_ != scaled_) {
      at_ = scaled_;
      prediction_ = problem_.predict(point_of(problem_, at_));
      slopes_.reset();
      if (prediction_.found()) {
        residuals_ = residuals(problem_, prediction_);
        const double here = misfit(problem_, residuals_);
        if (!std::isfinite(here)) prediction_.reason = "the misfit is not a number";
        if (here < best_.misfit) best_ = {at_, here, prediction_};
      }
      if (!best_.prediction.found()) best_.prediction = prediction_;
    }
    if (with_slopes && prediction_.found() && !slopes_) {
      Slopes slopes = problem_.differentiate(point_of(problem_, at_), prediction_);
      if (slopes.found() && !slopes.derivatives.allFinite()) slopes.reason = "a slope is not a number";
      if (slopes.found())
        slopes_ = last_slopes_ = std::move(slopes);
      else
        lack(slopes.reason);
    }
  }

  /// Whether the descent can begin.
  bool starts() {
    PrepareForEvaluation(true, true);
    return prediction_.found() && slopes_.has_value();
  }

  bool residual(Eigen::Index row, double* value, double** jacobians) const {
    if (!prediction_.found()) return false;
    *value = residuals_[row];
    if (!jacobians) return true;
    const Slopes& slopes = slopes_ ? *slopes_ : *last_slopes_;  // where there are none, those of the point before
    const double deviation = problem_.data[static_cast<std::size_t>(row)].deviation;
    for (Eigen::Index j = 0; j < scaled_.size(); ++j)
      if (jacobians[j]) *jacobians[j] = slopes.derivatives(row, j) / deviation;
    return true;
  }

  double* parameter(std::size_t j) { return &scaled_[static_cast<Eigen::Index>(j)]; }
  const Best& best() const { return best_; }
  const std::string& lack() const { return lack_; }

 private:
  void lack(const std::string& reason) {
    if (lack_.empty()) lack_ = reason;
  }

  const FitProblem& problem_;
  Eigen::VectorXd scaled_, at_, residuals_;
  Prediction prediction_;
  std::optional<Slopes> slopes_, last_slopes_;
  Best best_;
  std::string lack_;
};

class OneResidual : public ceres::CostFunction {
 public:
  OneResidual(const Position& position, Eigen::Index row, std::size_t parameters) : position_(position), row_(row) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->assign(parameters, 1);
  }
  bool Evaluate(double const* const*, double* residual, double** jacobians) const final {
    return position_.residual(row_, residual, jacobians);
  }

 private:
  const Position& position_;
  Eigen::Index row_;
};

class Stop : public ceres::IterationCallback {
 public:
  explicit Stop(const std::atomic<bool>* stop) : stop_(stop) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) final {
    return stop_ && stop_->load() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const std::atomic<bool>* stop_;
};

ceres::LossFunction* ceres_loss(const FitProblem& problem) {
  if (problem.loss == Loss::huber) return new ceres::HuberLoss(problem.loss_scale);
  if (problem.loss == Loss::cauchy) return new ceres::CauchyLoss(problem.loss_scale);
  return nullptr;
}

/// The parameter's bounds, or a factor of 10^6 either way where they are farther: what the data do not feel stays
/// finite.
void bound(ceres::Problem& problem, double* block, const Variable& variable) {
  constexpr double reach = 13.8;
  problem.SetParameterLowerBound(block, 0, std::max(variable.scaled(variable.lowest), *block - reach));
  problem.SetParameterUpperBound(block, 0, std::min(variable.scaled(variable.highest), *block + reach));
}

/// Ceres writes to standard error where it steps back from a failed prediction: nothing that a user can use.
void silence_ceres() {
#if __has_include(<glog/logging.h>)
  constexpr int fatal = 3;
  FLAGS_minloglevel = fatal;
#endif
}

ceres::Solver::Options solver_options(const DescentOptions& wanted) {
  ceres::Solver::Options options;
  options.max_num_iterations = wanted.most_iterations;
  options.function_tolerance = wanted.tolerance;
  options.parameter_tolerance = 1e-10;
  options.gradient_tolerance = 0;
  options.initial_trust_region_radius = wanted.radius;
  options.min_trust_region_radius = 1e-14;
  options.linear_solver_type = ceres::DENSE_QR;
  options.line_search_interpolation_type = ceres::BISECTION;  // within bounds: the others want slopes
  options.logging_type = ceres::SILENT;
  return options;
}

}  // namespace

Descent descend(const FitProblem& problem, const FitPoint& start, const DescentOptions& options) {
  silence_ceres();
  Position position(problem, start);
  ceres::Problem::Options ownership;
  ownership.evaluation_callback = &position;
  ceres::Problem task(ownership);
  std::vector<double*> blocks;
  for (std::size_t j = 0; j < problem.size(); ++j) blocks.push_back(position.parameter(j));
  for (Eigen::Index row = 0; row < std::ssize(problem.data); ++row)
    task.AddResidualBlock(new OneResidual(position, row, problem.size()), ceres_loss(problem), blocks);
  for (std::size_t j = 0; j < problem.size(); ++j) {
    if (std::find(options.held.begin(), options.held.end(), j) != options.held.end())
      task.SetParameterBlockConstant(blocks[j]);
    else
      bound(task, blocks[j], problem.parameters[j].variable);
  }
  Stop stop(options.stop);
  ceres::Solver::Options wanted = solver_options(options);
  wanted.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  summary.message = "there are no slopes at the start";
  if (position.starts()) ceres::Solve(wanted, &task, &summary);

  const Position::Best& best = position.best();
  Descent answer{start, start, RollingSolution::absent, best.prediction, false, summary.message};
  answer.iterations = static_cast<int>(summary.iterations.size());
  if (!best.prediction.found()) return answer;
  answer.end = point_of(problem, best.scaled);
  for (const std::size_t j : options.held) answer.end[j] = start[j];
  answer.misfit = best.misfit;
  answer.stopped_by_itself = summary.termination_type == ceres::CONVERGENCE;
  if (!position.lack().empty()) answer.why += "; " + position.lack();
  return answer;
}

}  // namespace rollres
