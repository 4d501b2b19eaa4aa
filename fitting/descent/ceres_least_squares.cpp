// All of ours that needs Ceres, a library by itself (least_squares.hpp).

#include <ceres/ceres.h>
#if __has_include(<glog/logging.h>)
#include <glog/logging.h>
#endif

#include "fitting/descent/least_squares.hpp"

namespace rollres {

namespace {

/// All residuals' parameters are single blocks, in the order of the problem.
class Position : public ceres::EvaluationCallback {
 public:
  explicit Position(LeastSquares& problem) : problem_(problem) {
    for (const LeastSquares::Parameter& parameter : problem.parameters) parameters_.push_back(parameter.start);
  }
  void PrepareForEvaluation(bool with_slopes, bool /*moved*/) final {
    problem_.move_to(parameters_.data(), with_slopes);
  }
  std::vector<double*> blocks() {
    std::vector<double*> blocks;
    for (double& parameter : parameters_) blocks.push_back(&parameter);
    return blocks;
  }
  const std::vector<double>& parameters() const { return parameters_; }

 private:
  LeastSquares& problem_;
  std::vector<double> parameters_;
};

class OneResidual : public ceres::CostFunction {
 public:
  OneResidual(const LeastSquares& problem, std::size_t row) : problem_(problem), row_(row) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->assign(problem.parameters.size(), 1);
  }
  bool Evaluate(double const* const*, double* residual, double** jacobians) const final {
    if (!jacobians) return problem_.residual(row_, *residual, nullptr);
    std::vector<double> slopes(problem_.parameters.size());
    if (!problem_.residual(row_, *residual, slopes.data())) return false;
    for (std::size_t j = 0; j < slopes.size(); ++j)
      if (jacobians[j]) *jacobians[j] = slopes[j];
    return true;
  }

 private:
  const LeastSquares& problem_;
  std::size_t row_;
};

class AfterIteration : public ceres::IterationCallback {
 public:
  AfterIteration(LeastSquares& problem, const Position& position) : problem_(problem), position_(position) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) final {
    const bool moved = summary.iteration > 0 && summary.step_is_successful;
    switch (problem_.after_iteration(summary.iteration, 2 * summary.cost, moved, position_.parameters().data())) {
      case LeastSquares::Next::end:
        return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
      case LeastSquares::Next::give_up:
        return ceres::SOLVER_ABORT;
      default:
        return ceres::SOLVER_CONTINUE;
    }
  }

 private:
  LeastSquares& problem_;
  const Position& position_;
};

ceres::LossFunction* ceres_loss(const LeastSquares& problem, std::size_t row) {
  if (!problem.has_loss(row)) return nullptr;
  if (problem.loss == Loss::huber) return new ceres::HuberLoss(problem.loss_scale);
  if (problem.loss == Loss::cauchy) return new ceres::CauchyLoss(problem.loss_scale);
  return nullptr;
}

/// Ceres writes to standard error where it steps back from a failed prediction: nothing that a user can use.
void silence_ceres() {
#if __has_include(<glog/logging.h>)
  constexpr int fatal = 3;
  FLAGS_minloglevel = fatal;
#endif
}

ceres::Solver::Options solver_options(const LeastSquares& problem) {
  ceres::Solver::Options options;
  options.max_num_iterations = problem.most_iterations;
  options.function_tolerance = problem.tolerance;
  options.parameter_tolerance = 1e-10;
  options.gradient_tolerance = 0;
  options.initial_trust_region_radius = problem.radius;
  options.min_trust_region_radius = 1e-14;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_line_search_step_size_iterations = 0;  // none at bounds: a shorter radius costs less
  options.logging_type = ceres::SILENT;
  options.update_state_every_iteration = true;
  return options;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) void rollres_minimise_by_ceres(LeastSquares& problem,
                                                                                 LeastSquaresEnd& end) {
  silence_ceres();
  Position position(problem);
  ceres::Problem::Options ownership;
  ownership.evaluation_callback = &position;
  ceres::Problem task(ownership);
  const std::vector<double*> blocks = position.blocks();
  for (std::size_t row = 0; row < problem.residuals; ++row)
    task.AddResidualBlock(new OneResidual(problem, row), ceres_loss(problem, row), blocks);
  for (std::size_t j = 0; j < blocks.size(); ++j) {
    const LeastSquares::Parameter& parameter = problem.parameters[j];
    if (parameter.held) {
      task.SetParameterBlockConstant(blocks[j]);
    } else {
      task.SetParameterLowerBound(blocks[j], 0, parameter.lowest);
      task.SetParameterUpperBound(blocks[j], 0, parameter.highest);
    }
  }
  AfterIteration after(problem, position);
  ceres::Solver::Options options = solver_options(problem);
  options.callbacks.push_back(&after);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &task, &summary);
  end = {summary.termination_type == ceres::CONVERGENCE,
         summary.message,
         static_cast<int>(summary.iterations.size()),
         position.parameters(),
         2 * summary.initial_cost,
         2 * summary.final_cost,
         summary.iterations.empty() ? problem.radius : summary.iterations.back().trust_region_radius};
}

}  // namespace rollres
