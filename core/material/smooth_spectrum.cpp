#include "core/material/smooth_spectrum.hpp"

#include <cmath>
#include <limits>

#include "core/algebra/dense_algebra.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

class EvenSpectrum {
 public:
  explicit EvenSpectrum(const RelativeRows& rows) : rows_(rows) {
    constexpr double per_decade = 3;  // ripples of the moduli below 1e-5
    constexpr double beyond = 1.5;    // decades, of the table at either end
    const double decades = rows.decades() + 2 * beyond;
    const int count = checked_count(std::ceil(decades * per_decade), "retardation times");
    const double step = decades / count;
    for (int j = 0; j <= count; ++j) times_.push_back(std::pow(10.0, -beyond + step * j) / rows.highest());
    responses_ = rows.responses(times_);
    wanted_ = rows.wanted();
    products_ = responses_.transpose() * responses_;
    set_bends(step);
    start(step);
  }

  /// To the least of misfit and weighted bends.
  void relax(double weight, int most_steps) {
    constexpr double largest_step = 2, negligible_gain = 1e-4, most_damping = 1e8;
    double value = objective(log_moduli_, weight), damping = 1e-4;
    for (int step = 0; step < most_steps; ++step) {
      const VectorXd moduli = log_moduli_.array().exp();
      const VectorXd slope = moduli.cwiseProduct(responses_.transpose() * (responses_ * moduli - wanted_)) +
                             weight * (bends_ * log_moduli_);
      const MatrixXd curvature = this->curvature(weight);
      double now = value;
      for (; damping < most_damping; damping *= 10) {
        MatrixXd damped = curvature;
        damped.diagonal() *= 1 + damping;
        const VectorXd change = PositiveSystem(damped).solve(slope).cwiseMax(-largest_step).cwiseMin(largest_step);
        now = objective(log_moduli_ - change, weight);
        if (now < value) {
          log_moduli_ -= change;
          break;
        }
      }
      damping *= 0.01;
      const bool done = !(now < value * (1 - negligible_gain));
      value = std::min(value, now);
      if (done) return;
    }
  }

  /// Logarithm of the rows' probability, with level, slope and modulus at rest unknown within so many powers of e.
  double evidence(double weight) const {
    constexpr double unknown_within = 5;
    const double bends = static_cast<double>(bend_count_);
    return -0.5 * freedom() * (std::log(2 * M_PI * variance(weight)) + 1) - log_root_determinant(curvature(weight)) +
           log_bends_ + 0.5 * bends * std::log(weight) - unknown() * std::log(unknown_within);
  }

  PronySeries series() const {
    PronySeries series{rows_.least_rest(), {}};
    for (std::size_t j = 0; j < times_.size(); ++j)
      series.terms.push_back({std::exp(log_moduli_(static_cast<Index>(j))), times_[j]});
    if (rows_.free_rest()) series.static_modulus += std::exp(log_moduli_(log_moduli_.size() - 1));
    return series;
  }

  OpenSpectrum open(double weight) const {
    OpenSpectrum open{times_, {}};
    if (rows_.free_rest()) open.times.push_back(INFINITY);
    const VectorXd moduli = log_moduli_.array().exp();
    open.spread = std::sqrt(variance(weight)) *
                  (moduli.asDiagonal() * inverse_of_upper(PositiveSystem(curvature(weight)).lower().transpose()));
    return open;
  }

 private:
  static double log_root_determinant(const MatrixXd& matrix) { return PositiveSystem(matrix).log_root_determinant(); }

  void set_bends(double step) {
    const Index terms = std::ssize(times_), n = responses_.cols();
    bend_count_ = terms - 2;
    MatrixXd bend = MatrixXd::Zero(bend_count_, n);
    for (Index i = 0; i < bend_count_; ++i) bend.row(i).segment(i, 3) << 1, -2, 1;
    bend /= std::pow(step, 1.5);
    bends_ = bend.transpose() * bend;
    log_bends_ = log_root_determinant(bend * bend.transpose());
  }

  /// The spectrum that an even one of the same loss would have.
  void start(double step) {
    constexpr double rest_at_first = 5;  // of the least one
    log_moduli_.resize(responses_.cols());
    for (Index j = 0; j < std::ssize(times_); ++j)
      log_moduli_(j) =
          std::log(2 / M_PI * std::log(10) * step * rows_.loss_at(1 / times_[static_cast<std::size_t>(j)]));
    if (rows_.free_rest()) log_moduli_(log_moduli_.size() - 1) = std::log(rest_at_first * rows_.least_rest());
  }

  /// Half the second derivatives of the objective, without those of the residuals.
  MatrixXd curvature(double weight) const {
    constexpr double pull = 1e-3;  // of what no row and no bend holds, so that it is finite
    const VectorXd moduli = log_moduli_.array().exp();
    MatrixXd sum = moduli.asDiagonal() * products_ * moduli.asDiagonal();
    sum += weight * bends_;
    sum.diagonal().array() += pull * weight;
    return sum;
  }

  double objective(const VectorXd& log_moduli, double weight) const {
    return (responses_ * log_moduli.array().exp().matrix() - wanted_).squaredNorm() +
           weight * log_moduli.dot(bends_ * log_moduli);
  }

  double unknown() const { return rows_.free_rest() ? 3 : 2; }  // without a deviation before the rows
  double freedom() const { return std::max(1.0, static_cast<double>(wanted_.size()) - unknown()); }

  /// Of the rows' errors.
  double variance(double weight) const {
    constexpr double exact = 2e-5;  // what the even times leave
    return (objective(log_moduli_, weight) + static_cast<double>(wanted_.size()) * exact * exact) / freedom();
  }

  const RelativeRows& rows_;
  std::vector<double> times_;
  MatrixXd responses_, products_, bends_;
  VectorXd wanted_, log_moduli_;
  double log_bends_ = 0;
  Index bend_count_ = 0;
};

}  // namespace

SpectrumFit smooth_spectrum(const RelativeRows& rows) {
  constexpr double stiffest = 1, softest = 1e-10, softer = 0.3;  // weights of the bends
  constexpr double nearly = 1;  // so much less evidence, and the spectrum may be rougher
  // One weight for all times takes the spectrum of single terms, which bends from each to the next, for noise. What is
  // open is therefore told with bends that hardly weigh, but for rows so far apart that only bends tell what lies
  // between them.
  constexpr double dense = 3, ends = 5;  // rows a decade
  const double locally = static_cast<double>(rows.rows()) > dense * rows.decades() + ends ? 1e-5 : 1;
  constexpr double hopeless = 8;
  constexpr int first_steps = 40, steps = 12;
  EvenSpectrum spectrum(rows);
  SpectrumFit best;
  best.evidence = -std::numeric_limits<double>::infinity();
  for (double weight = stiffest; weight > softest; weight *= softer) {
    spectrum.relax(weight, weight == stiffest ? first_steps : steps);
    const double evidence = spectrum.evidence(weight);
    if (!(evidence > best.evidence - hopeless)) break;
    best.evidence = std::max(best.evidence, evidence);
    if (evidence < best.evidence - nearly) continue;
    best.series = spectrum.series();
    best.open = spectrum.open(locally * weight);
  }
  return best;
}

}  // namespace rollres
