#include "core/algebra/nearby_systems.hpp"

#include <algorithm>

#include "core/algebra/krylov.hpp"

namespace rollres {

namespace {

constexpr double rounding = 1e-15, nearly_rounding = 1e-13;  // residuals, of the right side
constexpr double of_factors = 2;                             // times the residual that factors of its own left
constexpr double good_rate = 0.05;                           // by which a plain step lessens the residual
constexpr double exhausted_rate = 0.3;                       // of GMRES: it will not get much nearer
constexpr double per_cycle = 1e-9;                           // that GMRES may lose to rounding before it starts anew

/// Steps that cost about as much as factors of its own.
int most_steps(Eigen::Index size) { return std::clamp(static_cast<int>(size / 12), 4, 24); }

}  // namespace

std::optional<Eigen::VectorXd> NearbySystems::solve(const Shape& shape, const Apply& apply,
                                                    const Eigen::VectorXd& right_side) {
  if (shape != shape_ || solution_.size() != right_side.size()) return {};
  const double scale = right_side.norm();
  const double enough = std::max(nearly_rounding * scale, of_factors * rounded_);
  Eigen::VectorXd x = solution_, left = right_side - apply(x);
  double norm = left.norm(), rate = 0;
  const auto precondition = [&](const Eigen::VectorXd& residual) { return factors_.solve(residual); };
  for (int steps = most_steps(right_side.size()); norm > rounding * scale && steps > 0;) {
    Eigen::VectorXd next = x;
    const bool plain = rate < good_rate;
    if (plain) {
      next += precondition(left);
      --steps;
    } else {
      const double wanted = std::max(0.5 * rounding * scale / norm, per_cycle);
      const KrylovResult<double> correction = gmres<double>(apply, precondition, left, wanted, steps);
      next += correction.x;
      steps -= correction.iterations + 1;
    }
    Eigen::VectorXd next_left = right_side - apply(next);
    const double next_norm = next_left.norm();
    rate = next_norm / norm;
    if (rate < 1) {
      x = std::move(next);
      left = std::move(next_left);
      norm = next_norm;
    }
    const bool exhausted = !(rate < (plain ? 1 : exhausted_rate));
    if (exhausted && (!plain || norm <= enough)) break;  // no nearer, or as near as rounding lets it
  }
  if (!(norm <= enough)) return {};
  solution_ = x;
  return x;
}

Eigen::VectorXd NearbySystems::factorise(const Shape& shape, const Eigen::MatrixXd& matrix,
                                         const Eigen::VectorXd& right_side) {
  factors_.factorise(matrix);
  solution_ = factors_.solve(right_side);
  ++factorised_;
  rounded_ = (right_side - matrix * solution_).norm();
  shape_ = solution_.allFinite() ? shape : Shape{};
  return solution_;
}

}  // namespace rollres
