#include "core/algebra/fixed_point.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "core/algebra/dense_algebra.hpp"

namespace rollres {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// An evaluation.
struct MappedPoint {
  VectorXd x, mapped;
  VectorXd missed() const { return mapped - x; }
};

class FixedPointSearch {
 public:
  explicit FixedPointSearch(const FixedPointProblem& problem) : problem_(problem) {}

  std::optional<VectorXd> run(const VectorXd& start) {
    ask(start);
    if (kept_.empty()) return std::nullopt;
    while (going() && falls()) ask(mixed());
    while (going()) newton_step();
    // The last evaluation is the one that is given back.
    if (!found_ && !(has_value_ && kept_.back().x == best_.x)) ask(best_.x);
    return found_ ? kept_.back().x : best_.x;
  }

 private:
  static constexpr std::size_t most_kept = 6;

  bool going() const { return !found_ && !stuck_ && evaluations_ < problem_.most_evaluations; }

  /// @return whether there is a value, and one that misses less than all before
  bool ask(const VectorXd& x) {
    const std::optional<VectorXd> mapped = problem_.map(x);
    ++evaluations_;
    has_value_ = mapped.has_value();
    if (!has_value_) return false;
    kept_.push_back({x, *mapped});
    if (kept_.size() > most_kept) kept_.erase(kept_.begin());
    found_ = problem_.near(x, *mapped);
    const double missed = kept_.back().missed().norm();
    const bool less = missed < best_missed_;
    if (less) {
      best_ = kept_.back();
      best_missed_ = missed;
      best_at_ = evaluations_;
    }
    return less;
  }

  /// Whether mixing has made progress of late.
  bool falls() const { return has_value_ && evaluations_ - best_at_ < 3; }

  VectorXd mixed() const {
    const Index steps = static_cast<Index>(kept_.size()) - 1;
    const MappedPoint& last = kept_.back();
    if (steps == 0) return last.mapped;
    MatrixXd of_missed(last.x.size(), steps), of_mapped(last.x.size(), steps);
    for (Index i = 0; i < steps; ++i) {
      const MappedPoint &from = kept_[static_cast<std::size_t>(i)], &to = kept_[static_cast<std::size_t>(i) + 1];
      of_missed.col(i) = to.missed() - from.missed();
      of_mapped.col(i) = to.mapped - from.mapped;
    }
    return last.mapped - of_mapped * least_squares(of_missed, last.missed());
  }

  void newton_step() {
    const MappedPoint from = best_;
    MatrixXd slopes(from.x.size(), from.x.size());
    for (Index i = 0; i < from.x.size(); ++i) {
      VectorXd x = from.x;
      x(i) += problem_.difference;
      ask(x);
      stuck_ = !has_value_;
      if (!going()) return;
      slopes.col(i) = (kept_.back().missed() - from.missed()) / problem_.difference;
    }
    const VectorXd step = -SquareSystem(slopes).solve(from.missed());
    constexpr double least = 1.0 / 64;
    for (double share = 1; share >= least && going() && step.allFinite(); share /= 2)
      if (ask(from.x + share * step)) return;
    stuck_ = true;
  }

  const FixedPointProblem& problem_;
  std::vector<MappedPoint> kept_;
  MappedPoint best_;
  double best_missed_ = std::numeric_limits<double>::infinity();
  int evaluations_ = 0, best_at_ = 0;
  bool has_value_ = false, found_ = false, stuck_ = false;
};

}  // namespace

std::optional<VectorXd> fixed_point(const FixedPointProblem& problem, const VectorXd& start) {
  return FixedPointSearch(problem).run(start);
}

}  // namespace rollres
