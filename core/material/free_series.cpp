#include "core/material/free_series.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/algebra/dense_algebra.hpp"

namespace rollres {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Logarithm of the rows' probability on series of so many terms, before the rows normal in the logarithms of moduli
/// and times.
double evidence_of(const RelativeRows& rows, const PronySeries& series) {
  constexpr double modulus_within = 5;  // powers of e: two deviations to either side
  constexpr double exact = 2e-5;        // residuals that count as none, as of a smooth spectrum
  const double time_within = (rows.decades() + 2) * std::log(10);
  const TermSlopes terms(rows, series);
  const VectorXd residual = rows.residuals(series);
  const Index moduli = terms.moduli.size(), times = std::ssize(terms.times), parameters = moduli + times;
  const auto n = static_cast<double>(residual.size());
  const double freedom = std::max(1.0, n - static_cast<double>(parameters));
  const double variance = (residual.squaredNorm() + n * exact * exact) / freedom;
  VectorXd precision(parameters);  // roots
  precision << VectorXd::Constant(moduli, 2 / modulus_within), VectorXd::Constant(times, 4 / time_within);
  MatrixXd a(residual.size() + parameters, parameters);
  a << terms.slopes / std::sqrt(variance), MatrixXd(precision.asDiagonal());
  const VectorXd pivots = OverdeterminedSystem(a).triangle().diagonal().cwiseAbs();
  // Terms may change places.
  return -0.5 * n * std::log(2 * M_PI * variance) - 0.5 * freedom - pivots.array().log().sum() +
         precision.array().log().sum() + std::lgamma(static_cast<double>(times) + 1);
}

/// A series of free times, moved to the least misfit.
class FreeSeries {
 public:
  FreeSeries(const RelativeRows& rows, double wanted_evidence) : rows_(rows) {
    start();
    settle();
    if (may_reach(wanted_evidence)) {
      join_all();
      move(few_steps);
      join();
      move(most_steps);
    }
    drop_negligible();
  }
  const PronySeries& series() const { return series_; }

 private:
  static constexpr int most_steps = 60, few_steps = 12, trial_steps = 8;
  static constexpr double beyond = 10;  // the table, at most
  static constexpr std::size_t most_terms = 30;
  double shortest() const { return 1 / (beyond * rows_.highest()); }
  double longest() const { return beyond / rows_.lowest(); }

  /// Moves as long as that gains much: without noise it does to the end, where no series of few terms fits it does not.
  void settle() {
    constexpr double much = 0.7;
    constexpr int most_rounds = 5;
    double before = INFINITY;
    for (int round = 0; round < most_rounds; ++round) {
      move(few_steps);
      const double now = rows_.residuals(series_).norm();
      if (now > much * before) return;
      before = now;
    }
  }

  /// Whether what joining and moving gain may lift the evidence so far.
  bool may_reach(double wanted_evidence) const {
    constexpr double gain_by_term = 2, gain_by_moving = 15;
    const double gain = gain_by_moving + gain_by_term * static_cast<double>(series_.terms.size());
    return evidence_of(rows_, series_) + gain > wanted_evidence;
  }

  /// Non-negative moduli on a dense grid; two neighbours on it are one term.
  void start() {
    constexpr double most_times = 100, most_per_decade = 10;
    const double decades = std::log10(longest() / shortest());
    const auto count = static_cast<int>(std::ceil(decades * std::min(most_per_decade, most_times / decades)));
    std::vector<double> times;
    for (int j = 0; j <= count; ++j)
      times.push_back(shortest() * std::pow(longest() / shortest(), static_cast<double>(j) / count));
    const VectorXd moduli = nonnegative_moduli(rows_, times);
    series_.static_modulus = rows_.least_rest() + (rows_.free_rest() ? moduli(count + 1) : 0);
    bool neighbour = false;  // of a term that is not yet one of two
    for (int j = 0; j <= count; ++j) {
      const PronySeries::Term term{moduli(j), times[static_cast<std::size_t>(j)]};
      if (neighbour && term.modulus > 0)
        series_.terms.back() = one_of(series_.terms.back(), term);
      else if (term.modulus > 0)
        series_.terms.push_back(term);
      neighbour = !neighbour && term.modulus > 0;
    }
    while (series_.terms.size() > most_terms) join_nearest();
  }

  void join_nearest() {
    std::size_t nearest = 0;
    const auto ratio = [&](std::size_t j) { return series_.terms[j + 1].time / series_.terms[j].time; };
    for (std::size_t j = 1; j + 1 < series_.terms.size(); ++j)
      if (ratio(j) < ratio(nearest)) nearest = j;
    join_at(nearest);
  }

  void join_at(std::size_t j) {
    series_.terms[j] = one_of(series_.terms[j], series_.terms[j + 1]);
    series_.terms.erase(series_.terms.begin() + static_cast<std::ptrdiff_t>(j) + 1);
  }

  static PronySeries::Term one_of(const PronySeries::Term& a, const PronySeries::Term& b) {
    const double sum = a.modulus + b.modulus;
    return {sum, std::exp((a.modulus * std::log(a.time) + b.modulus * std::log(b.time)) / sum)};
  }

  std::vector<double> times() const {
    std::vector<double> times;
    for (const PronySeries::Term& term : series_.terms) times.push_back(term.time);
    return times;
  }

  bool rest_moves() const { return rows_.free_rest() && series_.static_modulus > rows_.least_rest(); }

  /// The rows' derivatives with respect to the logarithms of moduli, times and what is at rest beyond the least.
  MatrixXd slopes() const {
    const TermSlopes all(rows_, series_);
    const Index terms = std::ssize(series_.terms);
    MatrixXd slopes(all.slopes.rows(), 2 * terms + (rest_moves() ? 1 : 0));
    slopes.leftCols(terms) = all.slopes.leftCols(terms);
    slopes.middleCols(terms, terms) = all.slopes.rightCols(terms);
    if (rest_moves()) slopes.col(2 * terms) = all.slopes.col(terms) * (1 - rows_.least_rest() / series_.static_modulus);
    return slopes;
  }

  void change_by(const VectorXd& change) {
    const Index terms = std::ssize(series_.terms);
    const double rest = series_.static_modulus - rows_.least_rest();
    if (rest_moves()) series_.static_modulus = rows_.least_rest() + rest * std::exp(change(2 * terms));
    for (Index j = 0; j < terms; ++j) {
      PronySeries::Term& term = series_.terms[static_cast<std::size_t>(j)];
      term.modulus *= std::exp(change(j));
      term.time = std::clamp(term.time * std::exp(change(terms + j)), shortest(), longest());
    }
  }

  /// The moduli of least misfit at the times as they are, where those are positive: along the valleys of the misfit
  /// times and moduli go together.
  void best_moduli() {
    const VectorXd moduli = OverdeterminedSystem(rows_.responses(times())).solve(rows_.wanted());
    if (!(moduli.minCoeff() > 0)) return;
    for (Index j = 0; j < std::ssize(series_.terms); ++j)
      series_.terms[static_cast<std::size_t>(j)].modulus = moduli(j);
    if (rows_.free_rest()) series_.static_modulus = rows_.least_rest() + moduli(moduli.size() - 1);
  }

  /// Steps of Levenberg and Marquardt in the logarithms of moduli and times.
  void move(int steps) {
    constexpr double exact = 1e-10, negligible_gain = 1e-5, most_damping = 1e6;
    VectorXd residual = rows_.residuals(series_);
    double damping = 1e-3;
    for (int step = 0; step < steps && residual.norm() > exact * std::sqrt(residual.size()); ++step) {
      const MatrixXd slopes = this->slopes();
      if (slopes.cols() == 0) return;
      const double before = residual.norm();
      while (damping < most_damping && !try_step(slopes, residual, damping)) damping *= 10;
      if (!(residual.norm() < before)) break;
      if (damping < 1e-8 && residual.norm() > (1 - negligible_gain) * before) break;
      damping = std::max(1e-14, 0.01 * damping);
    }
    std::sort(series_.terms.begin(), series_.terms.end(), [](const auto& x, const auto& y) { return x.time < y.time; });
  }

  /// One step, kept if the residual becomes less.
  bool try_step(const MatrixXd& slopes, VectorXd& residual, double damping) {
    const Index rows = slopes.rows(), parameters = slopes.cols();
    const VectorXd norms = slopes.colwise().norm().cwiseMax(1e-300);
    MatrixXd a = MatrixXd::Zero(rows + parameters, parameters);
    a.topRows(rows) = slopes * norms.cwiseInverse().asDiagonal();
    a.bottomRows(parameters).diagonal().setConstant(std::sqrt(damping));
    VectorXd b = VectorXd::Zero(a.rows());
    b.head(rows) = -residual;
    const PronySeries before = series_;
    change_by(OverdeterminedSystem(a).solve(b).cwiseQuotient(norms).cwiseMax(-1).cwiseMin(1));
    best_moduli();
    const VectorXd now = rows_.residuals(series_);
    const bool better = now.norm() < residual.norm();
    if (better)
      residual = now;
    else
      series_ = before;
    return better;
  }

  /// Schwarz's criterion, corrected for few rows as Akaike's is.
  double criterion() const {
    constexpr double exact = 3e-6;  // enough
    const VectorXd residual = rows_.residuals(series_);
    const auto n = static_cast<double>(residual.size());
    const double p = 2.0 * static_cast<double>(series_.terms.size()) + 2;
    const double mean = residual.squaredNorm() / n + exact * exact;
    return n * std::log(mean) + std::log(n) * p + 2 * p * (p + 1) / std::max(n - p - 1, n / 4);
  }

  /// All that are nearer than some distance as one, for the largest distance that the criterion allows.
  void join_all() {
    const double before = criterion();
    for (const double distance : {3.2, 2.2, 1.6}) {
      const PronySeries kept = series_;
      std::vector<PronySeries::Term> few;
      for (const PronySeries::Term& term : kept.terms)
        if (!few.empty() && term.time < distance * few.back().time)
          few.back() = one_of(few.back(), term);
        else
          few.push_back(term);
      series_.terms = std::move(few);
      move(few_steps);
      if (criterion() <= before) return;
      series_ = kept;
    }
  }

  /// Neighbours as one, the nearest first, while the criterion falls.
  void join() {
    constexpr double farthest = 300;  // so far, and one of them is all but dropped
    // So many trials that their cost, as that of factorisations, is bounded.
    constexpr double most_work = 1.5e5;  // rows times the square of terms
    const double work = static_cast<double>(rows_.rows()) * std::pow(static_cast<double>(series_.terms.size()), 2);
    int trials = static_cast<int>(std::clamp(most_work / work, 4.0, 40.0));
    while (join_two(farthest, trials)) {
    }
  }

  bool join_two(double farthest, int& trials) {
    std::vector<std::size_t> order(series_.terms.size() < 2 ? 0 : series_.terms.size() - 1);
    std::iota(order.begin(), order.end(), 0U);
    const auto ratio = [&](std::size_t j) { return series_.terms[j + 1].time / series_.terms[j].time; };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ratio(a) < ratio(b); });
    const double before = criterion();
    for (const std::size_t j : order) {
      if (ratio(j) > farthest || trials-- <= 0) return false;
      const PronySeries kept = series_;
      join_at(j);
      move(trial_steps);
      if (criterion() <= before) return true;
      series_ = kept;
    }
    return false;
  }

  /// Terms that no row feels, and equal times as one.
  void drop_negligible() {
    constexpr double negligible = 1e-7;  // of a row
    const MatrixXd responses = rows_.responses(times());
    for (Index j = 0; j < std::ssize(series_.terms); ++j) {
      PronySeries::Term& term = series_.terms[static_cast<std::size_t>(j)];
      if (term.modulus * responses.col(j).maxCoeff() < negligible) term.modulus = 0;
    }
    series_ = ordered(series_);
  }

  const RelativeRows& rows_;
  PronySeries series_;
};

}  // namespace

SpectrumFit free_series(const RelativeRows& rows, double wanted_evidence) {
  const PronySeries series = FreeSeries(rows, wanted_evidence).series();
  return {series, open_beside_terms(rows, series), evidence_of(rows, series)};
}

}  // namespace rollres
