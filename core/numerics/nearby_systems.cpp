#include "core/numerics/nearby_systems.hpp"

#include <algorithm>

#include "core/numerics/krylov.hpp"

namespace rollres {

namespace {

constexpr double rounding = 1e-15, nearly_rounding = 1e-13;  // residuals, of the right side
constexpr double good_rate = 0.05;                           // by which a plain step lessens the residual
constexpr double per_cycle = 1e-9;                           // that GMRES may lose to rounding before it starts anew

/// Steps that cost about as much as factors of its own.
int most_steps(Eigen::Index size) { return std::clamp(static_cast<int>(size / 12), 4, 24); }

}  // namespace

std::optional<Eigen::VectorXd> NearbySystems::solve(const Shape& shape, const Apply& apply,
                                                    const Eigen::VectorXd& right_side) {
  if (shape != shape_ || solution_.size() != right_side.size()) return {};
  const double scale = right_side.norm();
  Eigen::VectorXd x = solution_, left = right_side - apply(x);
  double norm = left.norm();
  const auto precondition = [&](const Eigen::VectorXd& residual) { return factors_.solve(residual); };
  double rate = 0;
  for (int steps = most_steps(right_side.size()); norm > rounding * scale && steps > 0;) {
    Eigen::VectorXd next = x;
    if (rate < good_rate) {
      next += precondition(left);
      --steps;
    } else {
      const KrylovResult<double> correction =
          gmres<double>(apply, precondition, left, std::max(0.5 * rounding * scale / norm, per_cycle), steps);
      next += correction.x;
      steps -= correction.iterations + 1;
    }
    Eigen::VectorXd next_left = right_side - apply(next);
    const double next_norm = next_left.norm();
    if (!(next_norm < norm) && !(norm < nearly_rounding * scale) && rate >= good_rate) return {};
    if (!(next_norm < norm) && norm < nearly_rounding * scale) break;
    rate = next_norm / norm;
    if (!(rate < 1)) {  // a plain step that led astray
      rate = 1;
      continue;
    }
    x = std::move(next);
    left = std::move(next_left);
    norm = next_norm;
    if (rate > 0.3 && norm < nearly_rounding * scale) break;
  }
  if (!(norm < nearly_rounding * scale)) return {};
  solution_ = x;
  return x;
}

Eigen::VectorXd NearbySystems::factorise(const Shape& shape, const Eigen::MatrixXd& matrix,
                                         const Eigen::VectorXd& right_side) {
  factors_.factorise(matrix);
  solution_ = factors_.solve(right_side);
  shape_ = solution_.allFinite() ? shape : Shape{};
  return solution_;
}

}  // namespace rollres
