#include "fitting/errors/profile_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "fitting/descent/secant_slopes.hpp"
#include "fitting/errors/local_parabola.hpp"

namespace rollres {

namespace {

struct QuickEnd {
  double distance;     ///< of the end, scaled, > 0
  ProfilePoint point;  ///< the last one of the profile that was met
  Bend bend;
};

/// What is asked for: one end of the interval of one parameter.
struct ProfileSide {
  const FitProblem& problem;
  const Descent& fit;
  const Slopes& slopes;
  const FitErrors& errors;
  std::size_t parameter;
  double direction;  ///< -1 or 1
  double threshold;
};

/// The end of the interval from two or three predictions, where the misfit is nearly a parabola: at each point the
/// slopes, carried on by secants, say where on the parabola through it the misfit has risen to the threshold while the
/// other parameters make it least; the next point lies there. Nothing where the misfit is no parabola, or ends before
/// the threshold at a bound or without a prediction.
std::optional<QuickEnd> quick_end(const ProfileSide& side, double limit, const std::optional<Bend>& other_side) {
  constexpr int most_points = 4;
  constexpr double near = 0.05, settled = 0.03, too_far = 2;
  const FitProblem& problem = side.problem;
  const double scale = side.errors.scale, needed = side.threshold * scale;
  const auto own = static_cast<Eigen::Index>(side.parameter);
  const Eigen::VectorXd origin = scaled_point(problem, side.fit.end);
  const Eigen::VectorXd misses = residuals(problem, side.fit.prediction);
  const LocalParabola at_fit(problem, misses, side.slopes, own);
  double distance = at_fit.distance_to(needed, side.direction);
  if (other_side) distance = at_fit.distance_to(needed, side.direction, *other_side, 3 * std::abs(distance));
  Eigen::VectorXd scaled = origin + at_fit.step(distance, other_side);
  KnownSlopes known{side.fit.end, side.fit.prediction, side.slopes};
  QuickEnd answer{};
  for (int attempt = 0; attempt < most_points; ++attempt) {
    distance = side.direction * (scaled[own] - origin[own]);
    if (!(distance > 0 && distance < limit && (scaled - origin).cwiseAbs().maxCoeff() < too_far)) return std::nullopt;
    const FitPoint point = point_of(problem, scaled);
    const Prediction prediction = problem.predict(point);
    if (!prediction.found()) return std::nullopt;
    if (attempt == 0) {
      const Eigen::VectorXd foretold = side.slopes.derivatives * (scaled - origin);
      answer.bend = {side.direction * distance,
                     at_fit.whitening().cwiseProduct(prediction.values - side.fit.prediction.values - foretold)};
    }
    known = carried_to(point, prediction, known, problem, attempt == 0 ? 2 : 1).slopes;
    const Eigen::VectorXd here = residuals(problem, prediction);
    const LocalParabola parabola(problem, here, known.slopes, own);
    const double rise = (misfit(problem, here) - parabola.fall() - side.fit.misfit) / scale;
    const double further = parabola.distance_to(needed - scale * rise, side.direction);
    if (!std::isfinite(further) || rise < 0) return std::nullopt;
    if (parabola.fall() < settled * needed && std::abs(further) < near * distance) {
      answer.distance = distance + side.direction * further;
      answer.point = {point[side.parameter], rise};
      return answer.distance < limit ? std::optional(answer) : std::nullopt;
    }
    scaled = scaled_point(problem, point) + parabola.step(further);
  }
  return std::nullopt;
}

/// One side of a profile.
class Side : ProfileSide {
 public:
  Side(const ProfileSide& side, const std::atomic<bool>* stop, std::size_t most_solutions)
      : ProfileSide(side),
        stop_(stop),
        most_solutions_(most_solutions),
        quick_(with_secants(problem, {.known = KnownSlopes{fit.end, fit.prediction, slopes}})),
        origin_(scaled_point(problem, fit.end)) {}

  struct End {
    double value;
    IntervalEnd kind;
  };

  /// Finds the end; the points on the way are in `points`.
  End find(const std::optional<Bend>& other_side) {
    complete = problem.ending->solutions() < most_solutions_;
    if (!complete) return {fit.end[parameter], IntervalEnd::open};
    const FitParameter& own = problem.parameters[parameter];
    const bool to_least = direction < 0 && own.has_least;
    if (to_least && fit.end[parameter] <= own.least) return {fit.end[parameter], IntervalEnd::limit};
    Limit limit = limit_of_search();
    if (limit.distance <= 0) return limit.end;
    if (const auto quick = quick_end(*this, limit.distance, other_side)) {
      bend = quick->bend;
      points.push_back(quick->point);
      return {value_at(quick->distance), IntervalEnd::closed};
    }

    const double target = std::sqrt(threshold), deviation = errors.deviations[index()];
    double inside = 0, inside_root = 0, outside = 0, outside_root = 0;  // roots of the rise: nearly straight lines
    double next = std::isfinite(deviation) ? std::min(target * deviation, 1.0) : 0.5;
    constexpr int most = 14;
    for (int attempt = 0; attempt < most && !(stop_ && stop_->load()); ++attempt) {
      if (problem.ending->solutions() >= most_solutions_) {
        complete = false;
        break;
      }
      next = std::min(next, limit.distance);
      const double root = root_of_rise(next);
      if (std::isnan(root)) {
        if (!to_least || (stop_ && stop_->load())) return {value_at(inside), IntervalEnd::open};
        const double answered = answered_between(inside, next);
        limit = {answered, {value_at(answered), IntervalEnd::limit}};
        if (answered - inside < 0.02 * answered) return limit.end;
        next = answered;
        continue;
      }
      if (std::abs(root - target) < 0.05 * target) {
        const double slope = (root - inside_root) / (next - inside);  // inside < next: roots grow with the distance
        return {value_at(next + (target - root) / slope), IntervalEnd::closed};
      }
      if (root < target) {
        if (next >= limit.distance) return limit.end;
        inside = next, inside_root = root;
      } else {
        outside = next, outside_root = root;
      }
      if (outside > 0) {
        next = inside + (outside - inside) * (target - inside_root) / (outside_root - inside_root);
        const double margin = 0.05 * (outside - inside);
        if (attempt > 5) next = 0.5 * (inside + outside);
        next = std::clamp(next, inside + margin, outside - margin);
        if (outside - inside < 1e-4 * outside) return {value_at(next), IntervalEnd::closed};
      } else {
        next = inside * std::clamp(1.02 * target / std::max(inside_root, 1e-3 * target), 1.3, 3.0);
      }
    }
    return {value_at(inside), outside > 0 ? IntervalEnd::closed : IntervalEnd::open};
  }

  std::vector<ProfilePoint> points;
  FitPoint better;
  std::optional<Bend> bend;
  bool complete = true;

 private:
  /// How far the search goes, scaled, and the end of the interval where it gets there.
  struct Limit {
    double distance;
    End end;
  };
  Limit limit_of_search() const {
    const Variable& variable = problem.parameters[parameter].variable;
    const double bound = direction < 0 ? variable.lowest : variable.highest;
    const double physical = direction < 0 ? variable.quantity.range.lowest : variable.quantity.range.highest;
    const double to_bound = std::abs(variable.scaled(bound) - origin_[index()]);
    const double distance = std::min(to_bound, farthest());
    const bool to_zero = variable.scaling == Scaling::reciprocal && direction < 0 &&
                         bound == 0;  // infinitely far, and next to its limit
    const bool at_limit = to_zero || (to_bound <= farthest() && bound == physical);
    return {distance,
            {to_zero || distance <= 0 ? bound : value_at(distance), at_limit ? IntervalEnd::limit : IntervalEnd::open}};
  }
  Eigen::Index index() const { return static_cast<Eigen::Index>(parameter); }
  double value_at(double distance) const {
    return problem.parameters[parameter].variable.value(origin_[index()] + direction * distance);
  }

  /// A factor of 1000, in the scaled variable.
  double farthest() const {
    constexpr double factor = 1000;
    const bool reciprocal = problem.parameters[parameter].variable.scaling == Scaling::reciprocal;
    return !reciprocal ? std::log(factor) : direction < 0 ? factor - 1 : 1 - 1 / factor;
  }

  /// Where the others are thought to be: by the covariance, then along the line through the last two points.
  Eigen::VectorXd guess(double distance) const {
    const double moved = direction * distance;
    Eigen::VectorXd scaled = origin_;
    if (trail_.empty()) {
      const double variance = errors.covariance(index(), index());
      for (Eigen::Index k = 0; k < scaled.size(); ++k) {
        const double shift = moved * errors.covariance(k, index()) / variance;
        if (k != index() && std::isfinite(shift)) scaled[k] += std::clamp(shift, -2.0, 2.0);
      }
    } else {
      const Eigen::VectorXd& last = trail_.back();
      const Eigen::VectorXd before = trail_.size() > 1 ? trail_[trail_.size() - 2] : origin_;
      const double along = last[index()] - before[index()];
      const double ratio = std::abs(along) > 0 ? (origin_[index()] + moved - last[index()]) / along : 0;
      scaled = last + std::clamp(ratio, -2.0, 2.0) * (last - before);
    }
    scaled[index()] = origin_[index()] + moved;
    return scaled;
  }

  /// The farthest distance with an answer between two, to a twentieth of their difference.
  double answered_between(double with, double without) const {
    const double enough = 0.05 * (without - with);
    while (without - with > enough) {
      const double middle = 0.5 * (with + without);
      (problem.predict(point_of(problem, guess(middle))).found() ? with : without) = middle;
    }
    return with;
  }

  /// sqrt of the rise with the parameter at this distance; NaN without a prediction.
  double root_of_rise(double distance) {
    DescentOptions options;
    options.held = {parameter};
    options.most_iterations = 12;
    options.tolerance = 2e-3 * threshold * errors.scale / (fit.misfit + threshold * errors.scale);
    options.stop = stop_;
    FitPoint start = point_of(problem, guess(distance));
    start[parameter] = value_at(distance);
    if (const auto rise = rise_beside(start)) return kept(start, distance, *rise);  // which moved it
    Descent there = descend(quick_, start, options);
    if (!there.found()) {  // the guess was bold
      start = fit.end;
      start[parameter] = value_at(distance);
      there = descend(quick_, start, options);
    }
    if (!there.found()) return RollingSolution::absent;
    return kept(there.end, distance, (there.misfit - fit.misfit) / errors.scale);
  }

  double kept(const FitPoint& point, double distance, double rise) {
    trail_.push_back(scaled_point(problem, point));
    if (rise < -0.01 * threshold) better = point;
    points.push_back({value_at(distance), rise});
    return std::sqrt(std::max(rise, 0.0));
  }

  /// Gauss and Newton's steps from a point, as long as they are few and lead down, to the least misfit; the rise there.
  /// A last step that is all but nothing is not taken: most points cost one or two predictions.
  std::optional<double> rise_beside(FitPoint& point) {
    constexpr int most_steps = 3;
    double before = std::numeric_limits<double>::infinity();
    for (int steps = 0; steps <= most_steps; ++steps) {
      const Prediction prediction = quick_.predict(point);
      if (!prediction.found()) return std::nullopt;
      const Eigen::VectorXd misses = residuals(quick_, prediction);
      const double here = misfit(quick_, misses);
      if (!(here < before)) return std::nullopt;
      before = here;
      const LocalParabola parabola(quick_, misses, quick_.differentiate(point, prediction), index());
      if (const double fall = parabola.fall(); fall < 0.02 * threshold * errors.scale)
        return (here - fall - fit.misfit) / errors.scale;
      const double own = point[parameter];
      point = point_of(problem, scaled_point(problem, point) + parabola.step(0));
      point[parameter] = own;
    }
    return std::nullopt;
  }

  const std::atomic<bool>* stop_;
  std::size_t most_solutions_;
  FitProblem quick_;
  Eigen::VectorXd origin_;
  std::vector<Eigen::VectorXd> trail_;
};

}  // namespace

Profile profile(const FitProblem& problem, const Descent& fit, const Slopes& slopes, const FitErrors& errors,
                std::size_t parameter, double threshold, const std::atomic<bool>* stop, std::size_t most_solutions) {
  Profile answer;
  answer.points.push_back({fit.end[parameter], 0});
  std::optional<Bend> bend;
  for (const double direction : {-1.0, 1.0}) {
    Side side({problem, fit, slopes, errors, parameter, direction, threshold}, stop, most_solutions);
    const Side::End end = side.find(bend);
    bend = side.bend;
    (direction < 0 ? answer.interval.lowest : answer.interval.highest) = end.value;
    (direction < 0 ? answer.interval.low : answer.interval.high) = end.kind;
    answer.points.insert(answer.points.end(), side.points.begin(), side.points.end());
    if (answer.better.empty()) answer.better = side.better;
    answer.complete = side.complete;
    if (!answer.complete) break;
  }
  std::sort(answer.points.begin(), answer.points.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  return answer;
}

}  // namespace rollres
