#include "fitting/fit/noise_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/numerics/dense_algebra.hpp"

namespace rollres {

namespace {

/// What a term's square is multiplied by in the variance of each datum.
Eigen::MatrixXd shares_of(const Eigen::VectorXd& predictions, const std::vector<NoiseTerm>& terms) {
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(predictions.size(), std::ssize(terms));
  for (std::size_t k = 0; k < terms.size(); ++k)
    for (Eigen::Index i = 0; i < predictions.size(); ++i)
      if (terms[k].acts[static_cast<std::size_t>(i)])
        shares(i, static_cast<Eigen::Index>(k)) = terms[k].relative ? predictions[i] * predictions[i] : 1;
  return shares;
}

/// Standard errors of the squares: the inverse of Fisher's information, w_i^2 x_i x_i^T / 2 summed, of those above 0.
Eigen::VectorXd errors_of_squares(const Eigen::MatrixXd& shares, const Eigen::VectorXd& weights,
                                  const Eigen::VectorXd& squares) {
  std::vector<Eigen::Index> present;
  for (Eigen::Index k = 0; k < squares.size(); ++k)
    if (squares[k] > 0) present.push_back(k);
  Eigen::VectorXd errors = Eigen::VectorXd::Constant(squares.size(), RollingSolution::absent);
  if (present.empty()) return errors;
  Eigen::MatrixXd scaled = weights.asDiagonal() * shares(Eigen::all, present);  // over the squares: numbers of order 1
  for (std::size_t k = 0; k < present.size(); ++k) scaled.col(static_cast<Eigen::Index>(k)) *= squares[present[k]];
  const SingularValues svd(scaled);
  for (std::size_t k = 0; k < present.size(); ++k) {
    double variance = 0;
    for (Eigen::Index j = 0; j < svd.values.size(); ++j)
      variance += 2 * std::pow(svd.v(static_cast<Eigen::Index>(k), j) / svd.values[j], 2);
    errors[present[k]] = squares[present[k]] * std::sqrt(variance);
  }
  return errors;
}

Eigen::VectorXd squares_of(const FitReport& report) {
  Eigen::VectorXd squares(std::ssize(report.values));
  double measured = 0;
  for (const FittedValue& value : report.values) measured += value.measured.prior() ? 0 : 1;
  const double left = std::max(1.0, measured - static_cast<double>(report.parameters.size()));
  for (Eigen::Index i = 0; i < squares.size(); ++i) {
    const FittedValue& value = report.values[static_cast<std::size_t>(i)];
    squares[i] = value.measured.prior() ? -1 : std::pow(value.predicted - value.measured.value, 2) * measured / left;
  }
  return squares;
}

Eigen::VectorXd predictions_of(const FitReport& report) {
  Eigen::VectorXd predictions(std::ssize(report.values));
  for (Eigen::Index i = 0; i < predictions.size(); ++i)
    predictions[i] = report.values[static_cast<std::size_t>(i)].predicted;
  return predictions;
}

/// Gives the data the deviations of the terms. @return the largest relative change
double weigh(FitProblem& problem, const Eigen::VectorXd& predictions, const std::vector<NoiseTerm>& terms,
             const std::vector<LikelyNoise>& noise) {
  const Eigen::MatrixXd shares = shares_of(predictions, terms);
  double change = 0;
  for (std::size_t i = 0; i < problem.data.size(); ++i) {
    MeasuredValue& datum = problem.data[i];
    if (datum.prior()) continue;
    double variance = 0;
    for (std::size_t k = 0; k < noise.size(); ++k)
      variance += noise[k].value * noise[k].value * shares(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
    const double deviation = std::max(std::sqrt(variance), std::numeric_limits<double>::min());
    change = std::max(change, std::abs(deviation / datum.deviation - 1));
    datum.deviation = deviation;
  }
  return change;
}

/// Before a fit: relative noise as measured, or a level that is a part of a middle value.
void weigh_as_measured(FitProblem& problem, const std::vector<NoiseTerm>& terms) {
  constexpr double part = 0.05;
  std::vector<double> sizes;
  for (const MeasuredValue& datum : problem.data)
    if (!datum.prior()) sizes.push_back(std::abs(datum.value));
  std::nth_element(sizes.begin(), sizes.begin() + std::ssize(sizes) / 2, sizes.end());
  const double middle = std::max(sizes[sizes.size() / 2], std::numeric_limits<double>::min());
  for (std::size_t i = 0; i < problem.data.size(); ++i) {
    MeasuredValue& datum = problem.data[i];
    if (datum.prior()) continue;
    const auto acts = [&](bool relative) {
      return std::any_of(terms.begin(), terms.end(),
                         [&](const NoiseTerm& term) { return term.relative == relative && term.acts[i]; });
    };
    if (!acts(true) && !acts(false)) throw std::invalid_argument(datum.place + ": no term of the noise acts on it");
    const double size = acts(true) ? std::abs(datum.value) : middle;
    datum.deviation = part * std::max(size, acts(false) ? middle : 1e-3 * middle);
  }
}

}  // namespace

std::vector<LikelyNoise> likely_noise(const Eigen::VectorXd& squares, const Eigen::VectorXd& predictions,
                                      const std::vector<NoiseTerm>& terms) {
  constexpr int most_steps = 5000;
  constexpr double settled = 1e-9, nothing = 1e-4;  // of the variances
  const Eigen::VectorXd counts = (squares.array() >= 0).cast<double>();
  const Eigen::MatrixXd shares = counts.asDiagonal() * shares_of(predictions, terms);
  const Eigen::VectorXd residuals = squares.cwiseMax(0);
  Eigen::VectorXd level(shares.cols());
  for (Eigen::Index k = 0; k < level.size(); ++k) {
    const Eigen::ArrayXd own = shares.col(k).array();
    const double all = (own > 0).cast<double>().sum();
    level[k] = (own > 0).select(residuals.array() / own.max(std::numeric_limits<double>::min()), 0).sum() /
               (all * static_cast<double>(level.size()));
  }
  const auto weights_at = [&] {
    const Eigen::VectorXd variances = shares * level;
    return Eigen::VectorXd(
        (variances.array() > 0).select(1 / variances.array().max(std::numeric_limits<double>::min()), 0));
  };
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::VectorXd weights = weights_at();
    const Eigen::VectorXd pull = shares.transpose() * residuals.cwiseProduct(weights.cwiseAbs2());
    const Eigen::VectorXd push = shares.transpose() * weights;
    double change = 0;
    for (Eigen::Index k = 0; k < level.size(); ++k) {
      if (!(push[k] > 0)) continue;
      const double factor = std::sqrt(pull[k] / push[k]);
      level[k] *= factor;
      change = std::max(change, level[k] * push[k] > settled ? std::abs(factor - 1) : 0.0);
    }
    if (change < settled) break;
  }
  const Eigen::VectorXd reached = weights_at();
  for (Eigen::Index k = 0; k < level.size(); ++k)
    if (level[k] * shares.col(k).dot(reached) < nothing * counts.sum()) level[k] = 0;
  const Eigen::VectorXd errors = errors_of_squares(shares, weights_at(), level);
  std::vector<LikelyNoise> noise;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const double value = std::sqrt(level[static_cast<Eigen::Index>(k)]);
    noise.push_back({terms[k].name, terms[k].relative, value,
                     value > 0 ? errors[static_cast<Eigen::Index>(k)] / (2 * value) : RollingSolution::absent});
  }
  return noise;
}

FitReport fit_with_noise(const FitProblem& given, const std::vector<NoiseTerm>& terms, const FitOptions& options) {
  constexpr int most_rounds = 12;
  constexpr double settled = 2e-3;  // of a deviation
  FitProblem problem = given;
  problem.deviations_known = false;
  weigh_as_measured(problem, terms);
  FitOptions next = options;
  next.profiles = false;
  FitReport report = fit(problem, next), first = report;
  std::vector<LikelyNoise> noise;
  for (int round = 1; round <= most_rounds && report.slopes.found() && !report.interrupted; ++round) {
    const Eigen::VectorXd predictions = predictions_of(report);
    noise = likely_noise(squares_of(report), predictions, terms);
    const bool last = weigh(problem, predictions, terms, noise) < settled || round == most_rounds;
    for (std::size_t j = 0; j < problem.size(); ++j) problem.parameters[j].start = report.parameters[j].value;
    next.starts = 1;
    next.profiles = last && options.profiles;
    if (next.limits.solutions < std::numeric_limits<std::size_t>::max())
      next.limits.solutions = options.limits.solutions - std::min(options.limits.solutions, report.evaluations);
    report = fit(problem, next);
    if (last) break;
  }
  for (std::size_t j = 0; j < given.size(); ++j) report.parameters[j].parameter.start = given.parameters[j].start;
  report.noise_terms = std::move(noise);
  report.starts = first.starts;
  report.agreeing = first.agreeing;
  report.moved |= first.moved;
  judge(report, problem);
  return report;
}

}  // namespace rollres
