#include "fitting/errors/quick_profile.hpp"

#include <cmath>
#include <optional>

namespace rollres {

LocalParabola::LocalParabola(const FitProblem& problem, const Eigen::VectorXd& misses, const Slopes& slopes,
                             Eigen::Index own)
    : own_(own), whitening_(misses.size()), misses_(misses), others_(misses.size(), slopes.derivatives.cols() - 1) {
  for (Eigen::Index i = 0; i < misses.size(); ++i) {
    const double root = std::sqrt(loss_of(problem, misses[i] * misses[i]).weight);
    misses_[i] *= root;
    whitening_[i] = root / problem.data[static_cast<std::size_t>(i)].deviation;
  }
  slope_ = whitening_.cwiseProduct(slopes.derivatives.col(own));
  for (Eigen::Index j = 0, k = 0; j < slopes.derivatives.cols(); ++j)
    if (j != own) others_.col(k++) = whitening_.cwiseProduct(slopes.derivatives.col(j));
  if (others_.cols() > 0) decomposition_.emplace(others_);
}

double LocalParabola::distance_to(double rise, double direction) const {
  const Eigen::VectorXd own = left(slope_);
  const double a = own.squaredNorm(), b = own.dot(left(misses_));
  return (-b + direction * std::sqrt(b * b + a * rise)) / a;
}

double LocalParabola::distance_to(double rise, double direction, const Bend& bend, double farthest) const {
  const double here = left(misses_).squaredNorm();
  double inside = 0, outside = farthest;
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = 0.5 * (inside + outside);
    const double there = left(bent(direction * middle, bend) + direction * middle * slope_).squaredNorm();
    (there - here < rise ? inside : outside) = middle;
  }
  return direction * inside;
}

Eigen::VectorXd LocalParabola::step(double distance, const std::optional<Bend>& bend) const {
  const Eigen::VectorXd there = (bend ? bent(distance, *bend) : misses_) + distance * slope_;
  Eigen::VectorXd all(others_.cols() + 1), moved;
  if (others_.cols() > 0) moved = decomposition_->least_squares(-there);
  for (Eigen::Index j = 0, k = 0; j < all.size(); ++j) all[j] = j == own_ ? distance : moved[k++];
  return all;
}

Eigen::VectorXd LocalParabola::left(const Eigen::VectorXd& misses) const {
  return others_.cols() > 0 ? Eigen::VectorXd(misses - others_ * decomposition_->least_squares(misses)) : misses;
}

Eigen::VectorXd LocalParabola::bent(double distance, const Bend& bend) const {
  return misses_ + std::pow(distance / bend.distance, 2) * bend.misses;
}

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

}  // namespace rollres
