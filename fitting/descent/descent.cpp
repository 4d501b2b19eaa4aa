#include "fitting/descent/descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "fitting/descent/least_squares.hpp"
#include "fitting/descent/nearest_answer.hpp"

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
  }

  struct Best {
    Eigen::VectorXd scaled;
    double misfit = std::numeric_limits<double>::infinity();
    Prediction prediction;
    bool moved = false;  ///< to the nearest point with an answer
  };

  void move_to(const double* scaled, bool with_slopes) final {
    const Eigen::Map<const Eigen::VectorXd> there(scaled, start_.size());
    if (at_.size() == 0 || (at_ != there && asked_ != there)) {
      at_ = asked_ = there;
      prediction_ = problem_.predict(point_of(problem_, at_));
      const bool nearest = prediction_.found() && !prediction_.taken_at.empty();
      if (nearest) at_ = scaled_point(problem_, prediction_.taken_at);
      met_edge_ |= nearest;
      slopes_.reset();
      if (prediction_.found()) {
        residuals_ = rollres::residuals(problem_, prediction_);
        const double here = misfit(problem_, residuals_);
        if (!std::isfinite(here)) prediction_.reason = "the misfit is not a number";
        if (here < best_.misfit) best_ = {at_, here, prediction_, nearest};
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
    return hopeless() || (moved && (stride_ended(scaled) || at_ != asked_)) ? Next::end : Next::step;
  }

  /// Draws bounds a stride away from where the descent is.
  void begin_stride(const std::vector<double>& scaled) {
    best_.moved = false;
    for (std::size_t j = 0; j < parameters.size(); ++j) {
      const Reach& reach = reaches_[j];
      parameters[j].start = scaled[j];
      parameters[j].held = is_held(j);
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
    for (const FitParameter& parameter : problem_.parameters) best_.moved |= std::isfinite(parameter.least);
    return prediction_.found() && slopes_.has_value();
  }

  /// Whether the best of this stride is where no answer is nearer; at its start, whether the start is.
  bool on_edge() const { return best_.moved; }
  bool met_edge() const { return met_edge_; }

  /// Holds the parameters over whose least values with an answer the misfit would fall. @return whether there are such
  bool hold_pressed() {
    pressed_.clear();
    move_to(best_.scaled.data(), true);
    if (!slopes_) return false;
    for (std::size_t j = 0; j < problem_.size(); ++j) {
      if (!problem_.parameters[j].has_least || is_held(j)) continue;
      double growth = 0;
      for (Eigen::Index i = 0; i < residuals_.size(); ++i) {
        const auto row = static_cast<std::size_t>(i);
        growth += loss_of(problem_, row, residuals_[i]).weight * residuals_[i] *
                  slopes_->derivatives(i, static_cast<Eigen::Index>(j)) / problem_.data[row].deviation;
      }
      if (growth > 0) pressed_.push_back(j);
    }
    return !pressed_.empty();
  }
  bool holds_pressed() const { return !pressed_.empty(); }

  const Best& best() const { return best_; }
  const std::string& lack() const { return lack_; }

 private:
  bool is_held(std::size_t parameter) const {
    const auto in = [&](const std::vector<std::size_t>& some) { return contains(some, parameter); };
    return in(options_.held) || in(pressed_);
  }

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
  Eigen::VectorXd at_, asked_, residuals_;  // at_: where the prediction was taken
  Prediction prediction_;
  std::optional<Slopes> slopes_, last_slopes_;
  Best best_;
  std::string lack_;
  std::vector<Reach> reaches_;
  std::vector<std::size_t> pressed_;  // held at the least value with an answer
  bool met_edge_ = false;
  std::vector<double> sums_;
};

/// From stride to stride, as long as one ends because a parameter has come to its end and the misfit falls. Where a
/// parameter is pressed against its least value with an answer the others go on without it, and it joins them again.
LeastSquaresEnd descend_in_strides(Position& position, const DescentOptions& options) {
  constexpr double edge = 1e-3;  // a relative fall along the edge of what has an answer that is worth another stride
  LeastSquaresEnd ended;
  int iterations = 0;
  const auto at_best = [&] {
    const Eigen::VectorXd& best = position.best().scaled;
    return std::vector<double>(best.data(), best.data() + best.size());
  };
  ended.parameters = at_best();
  if (position.on_edge()) position.hold_pressed();
  for (bool further = true; further;) {
    position.begin_stride(ended.parameters);
    const double before = position.best().misfit;
    ended = minimise(position);
    iterations += ended.iterations;
    position.radius = ended.radius;
    position.most_iterations = options.most_iterations - iterations;
    const bool at_end = position.stride_ended(ended.parameters.data());
    ended.converged |= at_end;
    const bool falls = ended.last_sum < (1 - options.tolerance) * ended.first_sum;
    if (position.on_edge() || position.holds_pressed()) {
      ended.parameters = at_best();
      const bool on_edge = position.on_edge(), pressed = position.hold_pressed();
      further = on_edge ? position.best().misfit < (1 - std::max(options.tolerance, edge)) * before : !pressed;
    } else {
      further = at_end && falls;
    }
    further = further && position.most_iterations > 0 && !position.hopeless() && !position.stopped();
  }
  ended.iterations = iterations;
  if (position.hopeless()) ended.why = "another descent is far below";
  if (position.stopped()) ended.why = "interrupted";
  return ended;
}

}  // namespace

Descent descend(const FitProblem& given, const FitPoint& start, const DescentOptions& options) {
  const FitProblem problem = with_nearest_answers(given, options.held);
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
  answer.met_edge = position.met_edge();
  answer.stopped_by_itself = ended.converged;
  if (!position.lack().empty()) answer.why += "; " + position.lack();
  return answer;
}

}  // namespace rollres
