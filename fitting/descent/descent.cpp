#include "fitting/descent/descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "fitting/descent/least_squares.hpp"

namespace rollres {

namespace {

/// Predictions and slopes for all residuals at once: where the descent is, and for what it is asked there.
class Position : public LeastSquares {
 public:
  Position(const FitProblem& problem, const FitPoint& start, const DescentOptions& options)
      : problem_(problem), start_(scaled_point(problem, start)) {
    best_.prediction.reason = "not evaluated";
    residuals = problem.data.size();
    loss = problem.loss;
    loss_scale = problem.loss_scale;
    most_iterations = options.most_iterations;
    tolerance = options.tolerance;
    radius = options.radius;
    stop_ = options.stop;
    for (std::size_t j = 0; j < problem.size(); ++j)
      parameters.push_back(within_reach(problem.parameters[j].variable, start_[static_cast<Eigen::Index>(j)]));
    for (const std::size_t j : options.held) parameters[j].held = true;
  }

  struct Best {
    Eigen::VectorXd scaled;
    double misfit = std::numeric_limits<double>::infinity();
    Prediction prediction;
  };

  void move_to(const double* scaled, bool with_slopes) final {
    const Eigen::Map<const Eigen::VectorXd> there(scaled, start_.size());
    if (at_.size() == 0 || at_ != there) {
      at_ = there;
      prediction_ = problem_.predict(point_of(problem_, at_));
      slopes_.reset();
      if (prediction_.found()) {
        residuals_ = rollres::residuals(problem_, prediction_);
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

  bool residual(std::size_t datum, double& value, double* by_parameters) const final {
    if (!prediction_.found()) return false;
    const auto row = static_cast<Eigen::Index>(datum);
    value = residuals_[row];
    if (!by_parameters) return true;
    const Slopes& slopes = slopes_ ? *slopes_ : *last_slopes_;  // where there are none, those of the point before
    Eigen::Map<Eigen::RowVectorXd>(by_parameters, start_.size()) =
        slopes.derivatives.row(row) / problem_.data[datum].deviation;
    return true;
  }

  Next after_iteration(int, double, bool, const double*) final {
    return stop_ && stop_->load() ? Next::give_up : Next::step;
  }

  /// Whether the descent can begin.
  bool starts() {
    move_to(start_.data(), true);
    return prediction_.found() && slopes_.has_value();
  }

  const Best& best() const { return best_; }
  const std::string& lack() const { return lack_; }

 private:
  /// The parameter's bounds, or a factor of 10^6 either way where they are farther: what the data do not feel stays
  /// finite.
  static Parameter within_reach(const Variable& variable, double start) {
    constexpr double reach = 13.8;
    return {start, std::max(variable.scaled(variable.lowest), start - reach),
            std::min(variable.scaled(variable.highest), start + reach)};
  }

  void lack(const std::string& reason) {
    if (lack_.empty()) lack_ = reason;
  }

  const FitProblem& problem_;
  const std::atomic<bool>* stop_;
  const Eigen::VectorXd start_;
  Eigen::VectorXd at_, residuals_;
  Prediction prediction_;
  std::optional<Slopes> slopes_, last_slopes_;
  Best best_;
  std::string lack_;
};

}  // namespace

Descent descend(const FitProblem& problem, const FitPoint& start, const DescentOptions& options) {
  Position position(problem, start, options);
  const LeastSquaresEnd ended =
      position.starts() ? minimise(position) : LeastSquaresEnd{.why = "there are no slopes at the start"};

  const Position::Best& best = position.best();
  Descent answer{start, start, RollingSolution::absent, best.prediction, false, ended.why};
  answer.iterations = ended.iterations;
  if (!best.prediction.found()) return answer;
  answer.end = point_of(problem, best.scaled);
  for (const std::size_t j : options.held) answer.end[j] = start[j];
  answer.misfit = best.misfit;
  answer.stopped_by_itself = ended.converged;
  if (!position.lack().empty()) answer.why += "; " + position.lack();
  return answer;
}

}  // namespace rollres
