#include "fitting/errors/local_parabola.hpp"

#include <cmath>

namespace rollres {

LocalParabola::LocalParabola(const FitProblem& problem, const Eigen::VectorXd& misses, const Slopes& slopes,
                             Eigen::Index own)
    : own_(own), whitening_(misses.size()), misses_(misses), others_(misses.size(), slopes.derivatives.cols() - 1) {
  for (Eigen::Index i = 0; i < misses.size(); ++i) {
    const double root = std::sqrt(loss_of(problem, static_cast<std::size_t>(i), misses[i]).weight);
    misses_[i] *= root;
    whitening_[i] = root / problem.data[static_cast<std::size_t>(i)].deviation;
  }
  slope_ = whitening_.cwiseProduct(slopes.derivatives.col(own));
  for (Eigen::Index j = 0, k = 0; j < slopes.derivatives.cols(); ++j)
    if (j != own) others_.col(k++) = whitening_.cwiseProduct(slopes.derivatives.col(j));
  if (others_.cols() > 0) decomposition_.emplace(others_);
}

double LocalParabola::fall() const { return misses_.squaredNorm() - left(misses_).squaredNorm(); }

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

}  // namespace rollres
