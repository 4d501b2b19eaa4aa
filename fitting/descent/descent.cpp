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
      : problem_(problem), options_(options), start_(scaled_point(problem, start)) {
    best_.prediction.reason = "not evaluated";
    residuals = problem.data.size();
    loss = problem.loss;
    loss_scale = problem.loss_scale;
    most_iterations = options.most_iterations;
    tolerance = options.tolerance;
    radius = options.radius;
    for (std::size_t j = 0; j < problem.size(); ++j) {
      const double here = start_[static_cast<Eigen::Index>(j)];
      parameters.push_back({here, here, here});
      reaches_.push_back(reach_of(problem.parameters[j].variable, here));
    }
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

  bool has_loss(std::size_t datum) const final { return !problem_.data[datum].prior(); }

  Next after_iteration(int, double sum, bool moved, const double* scaled) final {
    if (stopped()) return Next::give_up;
    sums_.push_back(sum);
    return hopeless() || (moved && stride_ended(scaled)) ? Next::end : Next::step;
  }

  /// Draws bounds a stride away from where the descent is.
  void begin_stride(const std::vector<double>& scaled) {
    for (std::size_t j = 0; j < parameters.size(); ++j) {
      const Reach& reach = reaches_[j];
      parameters[j].start = scaled[j];
      parameters[j].lowest = std::max(reach.lowest, scaled[j] - options_.stride);
      parameters[j].highest = std::min(reach.highest, scaled[j] + options_.stride);
    }
  }

  /// Whether a parameter has come to the end of its stride, and could go further.
  bool stride_ended(const double* scaled) const {
    constexpr double touching = 1e-9;
    for (std::size_t j = 0; j < parameters.size(); ++j) {
      const Parameter& stride = parameters[j];
      if (stride.held) continue;
      if ((scaled[j] - stride.lowest < touching && stride.lowest > reaches_[j].lowest) ||
          (stride.highest - scaled[j] < touching && stride.highest < reaches_[j].highest))
        return true;
    }
    return false;
  }

  /// Whether a rival lies far below and the way there is long.
  bool hopeless() const {
    constexpr std::size_t patience = 4;
    constexpr double far = 2, slow = 0.6;
    if (std::isnan(options_.rival) || sums_.size() <= patience) return false;
    return sums_.back() > far * options_.rival && sums_.back() > slow * sums_[sums_.size() - 1 - patience / 2];
  }

  bool stopped() const { return options_.stop && options_.stop->load(); }

  /// Whether the descent can begin.
  bool starts() {
    move_to(start_.data(), true);
    return prediction_.found() && slopes_.has_value();
  }

  const Best& best() const { return best_; }
  const std::string& lack() const { return lack_; }

 private:
  /// How far a parameter may go, scaled.
  struct Reach {
    double lowest, highest;
  };

  /// The parameter's bounds, or a factor of 10^6 either way where they are farther: what the data do not feel stays
  /// finite.
  static Reach reach_of(const Variable& variable, double start) {
    constexpr double farthest = 13.8;
    return {std::max(variable.scaled(variable.lowest), start - farthest),
            std::min(variable.scaled(variable.highest), start + farthest)};
  }

  void lack(const std::string& reason) {
    if (lack_.empty()) lack_ = reason;
  }

  const FitProblem& problem_;
  const DescentOptions& options_;
  const Eigen::VectorXd start_;
  Eigen::VectorXd at_, residuals_;
  Prediction prediction_;
  std::optional<Slopes> slopes_, last_slopes_;
  Best best_;
  std::string lack_;
  std::vector<Reach> reaches_;
  std::vector<double> sums_;
};

/// From stride to stride, as long as one ends because a parameter has come to its end and the misfit falls.
LeastSquaresEnd descend_in_strides(Position& position, const DescentOptions& options) {
  LeastSquaresEnd ended;
  int iterations = 0;
  for (const LeastSquares::Parameter& parameter : position.parameters) ended.parameters.push_back(parameter.start);
  for (bool further = true; further;) {
    position.begin_stride(ended.parameters);
    ended = minimise(position);
    iterations += ended.iterations;
    position.radius = ended.radius;
    position.most_iterations = options.most_iterations - iterations;
    const bool at_end = position.stride_ended(ended.parameters.data());
    ended.converged |= at_end;
    further = at_end && position.most_iterations > 0 && !position.hopeless() && !position.stopped() &&
              ended.last_sum < (1 - options.tolerance) * ended.first_sum;
  }
  ended.iterations = iterations;
  if (position.hopeless()) ended.why = "another descent is far below";
  if (position.stopped()) ended.why = "interrupted";
  return ended;
}

}  // namespace

Descent descend(const FitProblem& problem, const FitPoint& start, const DescentOptions& options) {
  Position position(problem, start, options);
  const LeastSquaresEnd ended = position.starts() ? descend_in_strides(position, options)
                                                  : LeastSquaresEnd{.why = "there are no slopes at the start"};

  const Position::Best& best = position.best();
  Descent answer{start, start, RollingSolution::absent, best.prediction, false, ended.why};
  answer.iterations = ended.iterations;
  if (!best.prediction.found()) return answer;
  answer.abandoned = position.hopeless();
  answer.end = point_of(problem, best.scaled);
  for (std::size_t j = 0; j < problem.size(); ++j) {  // at a bound to the last digit
    constexpr double touching = 1e-9;
    const Variable& variable = problem.parameters[j].variable;
    const double here = best.scaled[static_cast<Eigen::Index>(j)];
    if (std::abs(here - variable.scaled(variable.lowest)) < touching) answer.end[j] = variable.lowest;
    if (std::abs(here - variable.scaled(variable.highest)) < touching) answer.end[j] = variable.highest;
  }
  for (const std::size_t j : options.held) answer.end[j] = start[j];
  answer.misfit = best.misfit;
  answer.stopped_by_itself = ended.converged;
  if (!position.lack().empty()) answer.why += "; " + position.lack();
  return answer;
}

}  // namespace rollres
