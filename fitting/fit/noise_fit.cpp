#include "fitting/fit/noise_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/algebra/dense_algebra.hpp"

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

/// X^T W X with a Cholesky factor, columns scaled to length 1; a direction that no datum tells counts as one that is
/// told to a millionth.
struct Information {
  Eigen::VectorXd lengths;
  Eigen::MatrixXd whitened;
  PositiveSystem products;

  Information(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& weights)
      : Information(Eigen::MatrixXd(weights.cwiseSqrt().asDiagonal() * slopes)) {}

  /// The part of each residual's variance that the fitted parameters leave: 1 - leverage.
  Eigen::VectorXd left() const {
    const Eigen::MatrixXd solved = products.solve(Eigen::MatrixXd(whitened.transpose()));
    return (1 - whitened.transpose().cwiseProduct(solved).colwise().sum().transpose().array()).cwiseMax(0);
  }
  double log_determinant() const { return 2 * (products.log_root_determinant() + lengths.array().log().sum()); }
  Eigen::MatrixXd inverse() const {
    return lengths.cwiseInverse().asDiagonal() * products.inverse() * lengths.cwiseInverse().asDiagonal();
  }

 private:
  explicit Information(const Eigen::MatrixXd& weighted)
      : lengths(weighted.colwise().norm().transpose().cwiseMax(std::numeric_limits<double>::min())),
        whitened(weighted * lengths.cwiseInverse().asDiagonal()),
        products(hardly_regular(whitened.transpose() * whitened)) {}

  static Eigen::MatrixXd hardly_regular(Eigen::MatrixXd matrix) {
    constexpr double hardly = 1e-12;
    matrix.diagonal().array() += hardly;
    return matrix;
  }
};

/// Standard errors of the squares: the inverse of Fisher's information, w_i^2 x_i x_i^T / 2 summed, of those above 0.
/// @param weights  w_i, times the root of what is left of a residual's variance
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

/// Of measurements; -1 for what was known before.
Eigen::VectorXd squares_of(const FitReport& report) {
  Eigen::VectorXd squares(std::ssize(report.values));
  for (Eigen::Index i = 0; i < squares.size(); ++i) {
    const FittedValue& value = report.values[static_cast<std::size_t>(i)];
    squares[i] = value.measured.prior() ? -1 : std::pow(value.predicted - value.measured.value, 2);
  }
  return squares;
}

/// Parameters that no bound holds.
std::vector<Eigen::Index> free_parameters(const FitReport& report) {
  std::vector<Eigen::Index> free;
  for (std::size_t j = 0; j < report.parameters.size(); ++j)
    if (report.errors.at_bound[j] == AtBound::no) free.push_back(static_cast<Eigen::Index>(j));
  return free;
}

/// Their slopes; of what was known before over its deviation.
Eigen::MatrixXd free_slopes(const FitReport& report) {
  Eigen::MatrixXd slopes = report.slopes.derivatives(Eigen::all, free_parameters(report));
  for (Eigen::Index i = 0; i < slopes.rows(); ++i) {
    const MeasuredValue& measured = report.values[static_cast<std::size_t>(i)].measured;
    if (measured.prior()) slopes.row(i) /= measured.deviation;
  }
  return slopes;
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
      return any_of(terms, [&](const NoiseTerm& term) { return term.relative == relative && term.acts[i]; });
    };
    if (!acts(true) && !acts(false)) throw std::invalid_argument(datum.place + ": no term of the noise acts on it");
    const double size = acts(true) ? std::abs(datum.value) : middle;
    datum.deviation = part * std::max(size, acts(false) ? middle : 1e-3 * middle);
  }
}

/// The fit, linear about where it is, with other sizes of the terms.
struct ReweightedFit {
  Eigen::MatrixXd covariance;
  Eigen::VectorXd step;   ///< of the free parameters, scaled
  double log_likelihood;  ///< restricted; the size of all terms together is integrated out
};

/// What the fit is with these variances of its values.
ReweightedFit reweighted(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& misses, const Eigen::VectorXd& variances,
                         int degrees) {
  const Eigen::VectorXd weights = variances.cwiseInverse();
  const Information information(slopes, weights);
  const Eigen::MatrixXd inverse = information.inverse();
  const Eigen::VectorXd step = inverse * (slopes.transpose() * weights.cwiseProduct(misses));
  const Eigen::VectorXd left = misses - slopes * step;
  const double squares = std::max(left.dot(weights.cwiseProduct(left)), std::numeric_limits<double>::min());
  return {inverse * (squares / degrees), step,
          -0.5 * (variances.array().log().sum() + information.log_determinant() + degrees * std::log(squares))};
}

/// What not knowing the size of one term beside another does.
struct UnknownSize {
  Eigen::MatrixXd growth;  ///< of the covariance of the free parameters
  double largest;          ///< factor from which on the size is unlikely
};

/// By what the covariance of the free parameters grows since the size of one term beside another is estimated.
/// @param variances_at  of all values where that size, squared, is so many times what it is if it alone explained them
template <class VariancesAt>
UnknownSize unknown_size(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& misses, int degrees,
                         const ReweightedFit& found, const VariancesAt& variances_at) {
  constexpr int sizes = 41;
  constexpr double reach = 12;  // of the logarithm of a square: factors up to 400 of the size
  const auto factor_at = [](int i) { return std::exp(reach * (2.0 * i / (sizes - 1) - 1)); };
  std::vector<ReweightedFit> all;
  double best = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < sizes; ++i) {
    all.push_back(reweighted(slopes, misses, variances_at(factor_at(i)), degrees));
    best = std::max(best, all.back().log_likelihood);
  }
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(slopes.cols(), slopes.cols());
  double sum = 0;
  int last = 0;
  constexpr double unlikely = 1.92;  // half of chi squared's 95 %
  for (int i = 0; i < sizes; ++i) {
    const ReweightedFit& one = all[static_cast<std::size_t>(i)];
    if (one.log_likelihood > best - unlikely) last = i;
    const double weight = std::exp(one.log_likelihood - best);
    const Eigen::VectorXd moved = one.step - found.step;
    mean += weight * (one.covariance + moved * moved.transpose());
    sum += weight;
  }
  return {mean / sum - found.covariance, factor_at(std::min(last + 1, sizes - 1))};
}

/// Adds to the covariance of a fit what the noise's own errors add.
void mind_errors_of_noise(FitReport& report, const FitProblem& problem, const std::vector<NoiseTerm>& terms) {
  const std::vector<Eigen::Index> free = free_parameters(report);
  const std::vector<LikelyNoise>& noise = report.noise_terms;
  if (terms.size() < 2 || free.empty() || report.degrees < 1) return;
  const Eigen::VectorXd predictions = predictions_of(report), squares = squares_of(report);
  const Eigen::MatrixXd slopes = free_slopes(report), shares = shares_of(predictions, terms);
  Eigen::VectorXd misses(squares.size()), known(squares.size()), sizes(std::ssize(terms)), alone(std::ssize(terms)),
      told(std::ssize(terms));
  for (Eigen::Index i = 0; i < misses.size(); ++i) {
    const FittedValue& value = report.values[static_cast<std::size_t>(i)];
    known[i] = value.measured.prior() ? 1 : 0;
    misses[i] = value.measured.prior() ? -value.residual : value.measured.value - value.predicted;
  }
  const auto variances_with = [&](const Eigen::VectorXd& of_terms) {
    const Eigen::VectorXd explained = shares * of_terms;
    return Eigen::VectorXd((known.array() > 0).select(1, explained.array().max(std::numeric_limits<double>::min())));
  };
  for (Eigen::Index k = 0; k < sizes.size(); ++k) sizes[k] = std::pow(noise[static_cast<std::size_t>(k)].value, 2);
  const Eigen::VectorXd weights = (1 - known.array()) / variances_with(sizes).array();
  for (Eigen::Index k = 0; k < sizes.size(); ++k) {
    const Eigen::ArrayXd own = (known.array() > 0).select(0, shares.col(k).array());
    told[k] = sizes[k] * own.matrix().dot(weights);
    alone[k] = (own > 0).select(squares.array() / own.max(std::numeric_limits<double>::min()), 0).sum() /
               (own > 0).cast<double>().sum();
  }
  Eigen::Index main = 0;
  told.maxCoeff(&main);
  const ReweightedFit found = reweighted(slopes, misses, variances_with(sizes), report.degrees);
  Eigen::MatrixXd growth = Eigen::MatrixXd::Zero(slopes.cols(), slopes.cols());
  for (Eigen::Index k = 0; k < sizes.size(); ++k) {
    if (k == main || !(alone[main] > 0)) continue;
    const double usual = sizes[main] * alone[k] / alone[main];
    const UnknownSize unknown = unknown_size(slopes, misses, report.degrees, found, [&](double factor) {
      Eigen::VectorXd other = sizes;
      other[k] = factor * usual;
      return variances_with(other);
    });
    growth += unknown.growth;
    LikelyNoise& term = report.noise_terms[static_cast<std::size_t>(k)];
    term.highest = std::sqrt(unknown.largest * usual);
  }
  report.errors.covariance(free, free) += growth;
  tell_errors(report, problem);
}

}  // namespace

std::vector<LikelyNoise> likely_noise(const Eigen::VectorXd& squares, const Eigen::VectorXd& predictions,
                                      const std::vector<NoiseTerm>& terms, const Eigen::MatrixXd& slopes) {
  constexpr int most_steps = 5000;
  constexpr double settled = 1e-7, nothing = 1e-4;  // of the variances
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
  const auto left_with = [&](const Eigen::VectorXd& weights) {
    if (slopes.cols() == 0) return Eigen::VectorXd(Eigen::VectorXd::Ones(weights.size()));
    return Information(slopes, (counts.array() > 0).select(weights, 1)).left();
  };
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::VectorXd weights = weights_at();
    const Eigen::VectorXd pull = shares.transpose() * residuals.cwiseProduct(weights.cwiseAbs2());
    const Eigen::VectorXd push = shares.transpose() * weights.cwiseProduct(left_with(weights));
    double change = 0;
    for (Eigen::Index k = 0; k < level.size(); ++k) {
      if (!(push[k] > 0)) continue;
      const double factor = std::sqrt(pull[k] / push[k]);
      level[k] *= factor;
      const bool vanishes = factor < 1 && level[k] * push[k] < 0.5 * nothing * counts.sum();
      if (!vanishes) change = std::max(change, std::abs(factor - 1));
    }
    if (change < settled) break;
  }
  const Eigen::VectorXd reached = weights_at();
  for (Eigen::Index k = 0; k < level.size(); ++k)
    if (level[k] * shares.col(k).dot(reached) < nothing * counts.sum()) level[k] = 0;
  const Eigen::VectorXd weights = weights_at();
  const Eigen::VectorXd errors = errors_of_squares(shares, weights.cwiseProduct(left_with(weights).cwiseSqrt()), level);
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
    noise = likely_noise(squares_of(report), predictions, terms, free_slopes(report));
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
  if (report.slopes.found()) mind_errors_of_noise(report, problem, terms);
  judge(report, problem);
  return report;
}

}  // namespace rollres
