#include "core/material/master_curve.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/material/material_scale.hpp"
#include "core/messages/message_text.hpp"
#include "core/numerics/nonnegative_least_squares.hpp"
#include "core/numerics/recently_made.hpp"

namespace rollres {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double times_per_decade = 2;   // ripples of G" below 0.1 %
constexpr double decades_beyond = 0.75;  // of the measured band, at either end
/// Misfit that a smoother spectrum may add, relative to the least one and absolute.
constexpr double added_misfit = 1.1, bearable_misfit = 0.05;
/// Misfit of free times that no row's error explains by chance, whatever the loss tangent between the rows.
constexpr double trusted_misfit = 1e-3;
/// Smallest share of the lowest storage modulus that stays at rest where nothing says it.
constexpr double least_rest = 0.1;
/// A row is an outlier beyond so many times the usual misfit, and this one.
constexpr double outlier_ratio = 5, outlier_misfit = 0.05;

std::string row_name(const MasterCurve& curve, std::size_t row) {
  return message_text("row ", row + 1, " (", curve.frequencies[row], " Hz)");
}

/// Rows by frequency.
std::vector<std::size_t> rows_in_order(const MasterCurve& curve) {
  std::vector<std::size_t> order(curve.frequencies.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return curve.frequencies[a] < curve.frequencies[b]; });
  return order;
}

std::vector<std::string> remarks_on_rows(const MasterCurve& curve, const std::vector<std::size_t>& order) {
  std::vector<std::string> remarks;
  for (std::size_t row = 1; row < curve.frequencies.size(); ++row)
    if (curve.frequencies[row] < curve.frequencies[row - 1])
      remarks.push_back("master curve: " + row_name(curve, row) + " is out of the order of frequencies");
  for (std::size_t i = 1; i < order.size(); ++i) {
    const std::size_t before = order[i - 1], row = order[i];
    if (curve.frequencies[row] == curve.frequencies[before])
      remarks.push_back("master curve: " + row_name(curve, row) + " has the frequency of row " +
                        std::to_string(before + 1) + "; both count");
    else if (curve.storage[row] < curve.storage[before])
      remarks.push_back("master curve: " + row_name(curve, row) +
                        message_text(": the storage modulus falls from ", curve.storage[before], " to ",
                                     curve.storage[row], " Pa, as no passive material's does"));
  }
  return remarks;
}

/// A linear least squares problem in the scaled moduli: rows of relative storage and loss, then bends of the spectrum.
class SpectrumProblem {
 public:
  SpectrumProblem(const MasterCurve& curve, const std::vector<std::size_t>& order) : curve_(curve) {
    const double lowest = omega(order.front()), highest = omega(order.back());
    const double decades = std::log10(highest / lowest) + 2 * decades_beyond;
    const int count = std::max(3, static_cast<int>(std::ceil(decades * times_per_decade)) + 1);
    for (int j = 0; j < count; ++j)
      times_.push_back(std::pow(10.0, -decades_beyond + decades * j / (count - 1)) / highest);
    // Moduli in parts of the loss modulus where they act, so that bends count alike over all decades.
    for (const double time : times_) scale_.push_back(loss_between(1 / time, order));
    rest_ = curve.static_modulus;
    if (rest_ == 0) rest_ = least_rest * *std::min_element(curve.storage.begin(), curve.storage.end());
    reduce();
  }

  /// Bends weigh `smoothness`.
  PronySeries solve(double smoothness) const {
    const Index terms = std::ssize(times_), bends = terms - 2;
    MatrixXd a = MatrixXd::Zero(triangle_.rows() + bends, triangle_.cols());
    VectorXd b = VectorXd::Zero(a.rows());
    a.topRows(triangle_.rows()) = triangle_;
    b.head(triangle_.rows()) = wanted_;
    for (Index i = 0; i < bends; ++i) a.block(triangle_.rows() + i, i, 1, 3) << smoothness, -2 * smoothness, smoothness;
    const VectorXd moduli = nonnegative_least_squares(a, b);
    PronySeries series{rest_, {}};
    if (curve_.static_modulus == 0) series.static_modulus += rest_ * moduli(terms);
    for (Index j = 0; j < terms; ++j)
      if (const auto k = static_cast<std::size_t>(j); moduli(j) > 0)
        series.terms.push_back({moduli(j) * scale_[k], times_[k]});
    return series;
  }

  double misfit(const PronySeries& series, std::size_t row) const {
    const std::complex<double> measured(curve_.storage[row], curve_.loss[row]);
    return std::abs(complex_modulus(series, omega(row)) - measured) / std::abs(measured);
  }

  double rms_misfit(const PronySeries& series) const {
    double sum = 0;
    for (std::size_t row = 0; row < curve_.frequencies.size(); ++row) sum += std::pow(misfit(series, row), 2);
    return std::sqrt(sum / static_cast<double>(curve_.frequencies.size()));
  }

  double least_rest_modulus() const { return rest_; }

 private:
  double omega(std::size_t row) const { return 2 * std::numbers::pi * curve_.frequencies[row]; }

  double size(std::size_t row) const { return std::hypot(curve_.storage[row], curve_.loss[row]); }

  /// The loss modulus of a row, or a small part of |G*| where there is next to none.
  double loss(std::size_t row) const { return std::max(curve_.loss[row], 1e-3 * size(row)); }

  /// The same between the rows, interpolated in logarithms.
  double loss_between(double at, const std::vector<std::size_t>& order) const {
    std::size_t above = 0;
    while (above < order.size() && omega(order[above]) < at) ++above;
    if (above == 0) return loss(order.front());
    if (above == order.size()) return loss(order.back());
    const std::size_t a = order[above - 1], b = order[above];
    return loss(a) * std::pow(loss(b) / loss(a), std::log(at / omega(a)) / std::log(omega(b) / omega(a)));
  }

  /// The rows of the table as a triangle with the same least squares: its size is that of the spectrum.
  void reduce() {
    const Index rows = std::ssize(curve_.frequencies), terms = std::ssize(times_);
    const bool unknown_rest = curve_.static_modulus == 0;
    MatrixXd a(2 * rows, terms + (unknown_rest ? 1 : 0) + 1);
    for (Index i = 0; i < rows; ++i) {
      const auto row = static_cast<std::size_t>(i);
      // The loss is the smaller of the two and matters as much: between |G*| and itself is what it is compared with.
      const double storage_size = size(row), loss_size = std::sqrt(size(row) * loss(row));
      for (Index j = 0; j < terms; ++j) {
        const auto k = static_cast<std::size_t>(j);
        const std::complex<double> part = complex_modulus(PronySeries{0, {{scale_[k], times_[k]}}}, omega(row));
        a(2 * i, j) = part.real() / storage_size;
        a(2 * i + 1, j) = part.imag() / loss_size;
      }
      if (unknown_rest) a.col(terms).segment(2 * i, 2) << rest_ / storage_size, 0;
      a.col(a.cols() - 1).segment(2 * i, 2) << (curve_.storage[row] - rest_) / storage_size,
          curve_.loss[row] / loss_size;
    }
    if (a.rows() > a.cols()) {
      const Eigen::HouseholderQR<MatrixXd> qr(a);
      a = qr.matrixQR().topRows(a.cols()).triangularView<Eigen::Upper>();
    }
    triangle_ = a.leftCols(a.cols() - 1) / std::sqrt(static_cast<double>(rows));
    wanted_ = a.col(a.cols() - 1) / std::sqrt(static_cast<double>(rows));
  }

  const MasterCurve& curve_;
  std::vector<double> times_, scale_;
  double rest_;  // [Pa], at least
  MatrixXd triangle_;
  VectorXd wanted_;
};

/// How often a sequence of positive values turns from rising to falling or back, by more than a tenth.
int turns(const std::vector<double>& values) {
  constexpr double noticeable = 1.1;
  int count = 0, direction = 0;                        // neither rises nor falls as yet
  double low = values.front(), high = values.front();  // since the last turn
  for (const double value : values) {
    low = std::min(low, value);
    high = std::max(high, value);
    const bool fell = direction >= 0 && value * noticeable < high, rose = direction <= 0 && value > noticeable * low;
    if (!fell && !rose) continue;
    if (direction != 0) ++count;
    direction = fell ? -1 : 1;
    low = high = value;
  }
  return count;
}

/// Turns of the loss tangent within the measured band beyond those of the table.
int waves(const PronySeries& series, const MasterCurve& curve, const std::vector<std::size_t>& order) {
  constexpr int points_per_decade = 10;
  const double lowest = curve.frequencies[order.front()], highest = curve.frequencies[order.back()];
  const int count = static_cast<int>(std::ceil(points_per_decade * std::log10(highest / lowest)));
  std::vector<double> fitted, measured;
  for (int i = 0; i <= count; ++i) {
    const double frequency = lowest * std::pow(highest / lowest, static_cast<double>(i) / count);
    const std::complex<double> modulus = complex_modulus(series, 2 * std::numbers::pi * frequency);
    fitted.push_back(modulus.imag() / modulus.real());
  }
  for (const std::size_t row : order) measured.push_back(curve.loss[row] / curve.storage[row]);
  return std::max(0, turns(fitted) - turns(measured));
}

struct SmoothSeries {
  PronySeries series;
  int waves;  // left, as fewer would cost too much misfit
};

SmoothSeries smooth_series(const SpectrumProblem& problem, const MasterCurve& curve,
                           const std::vector<std::size_t>& order) {
  constexpr double least = 1e-4, factor = 3;
  constexpr int weights = 10;
  PronySeries series = problem.solve(least);
  const double bound = added_misfit * problem.rms_misfit(series) + bearable_misfit;
  SmoothSeries smooth{series, waves(series, curve, order)};
  for (int i = 1; i < weights && smooth.waves > 0; ++i) {
    series = problem.solve(least * std::pow(factor, i));
    if (problem.rms_misfit(series) > bound) break;
    smooth = {series, waves(series, curve, order)};
  }
  return smooth;
}

/// Rows of the table as relative residuals of a series: storage, then loss.
class RelativeRows {
 public:
  RelativeRows(const MasterCurve& curve, double least_rest) : rest_(least_rest), free_rest_(curve.static_modulus == 0) {
    const Index rows = std::ssize(curve.frequencies);
    omega_ = 2 * std::numbers::pi * Eigen::Map<const VectorXd>(curve.frequencies.data(), rows);
    wanted_.resize(2 * rows);
    wanted_ << Eigen::Map<const VectorXd>(curve.storage.data(), rows),
        Eigen::Map<const VectorXd>(curve.loss.data(), rows);
    size_ = wanted_;
    for (Index row = 0; row < rows; ++row)
      size_(rows + row) = std::max(wanted_(rows + row), noticeable_tangent * wanted_(row));
  }

  Index rows() const { return omega_.size(); }
  bool free_rest() const { return free_rest_; }
  double lowest() const { return omega_.minCoeff(); }
  double highest() const { return omega_.maxCoeff(); }

  /// What a modulus of 1 Pa at each time adds, the last being at rest where that is free.
  MatrixXd responses(const std::vector<double>& times) const {
    MatrixXd a(2 * rows(), std::ssize(times) + (free_rest_ ? 1 : 0));
    for (Index j = 0; j < std::ssize(times); ++j) {
      const Eigen::ArrayXd turn = omega_.array() * times[static_cast<std::size_t>(j)];
      a.col(j) << (1 - 1 / (1 + turn.square())), turn / (1 + turn.square());
    }
    if (free_rest_) a.col(a.cols() - 1) << VectorXd::Ones(rows()), VectorXd::Zero(rows());
    return a.array().colwise() / size_.array();
  }
  /// Their derivatives by the logarithm of the time.
  MatrixXd slopes(const std::vector<double>& times) const {
    MatrixXd a(2 * rows(), std::ssize(times));
    for (Index j = 0; j < std::ssize(times); ++j) {
      const Eigen::ArrayXd turn = omega_.array() * times[static_cast<std::size_t>(j)];
      const Eigen::ArrayXd square = turn.square(), whole = (1 + square).square();
      a.col(j) << 2 * square / whole, turn * (1 - square) / whole;
    }
    return a.array().colwise() / size_.array();
  }
  /// What moduli beyond the least one at rest have to meet.
  VectorXd wanted() const {
    VectorXd wanted = wanted_;
    wanted.head(rows()).array() -= rest_;
    return wanted.cwiseQuotient(size_);
  }
  double least_rest() const { return rest_; }

  VectorXd residuals(const PronySeries& series) const {
    std::vector<double> times;
    VectorXd moduli(std::ssize(series.terms) + (free_rest_ ? 1 : 0));
    for (const PronySeries::Term& term : series.terms) {
      moduli(std::ssize(times)) = term.modulus;
      times.push_back(term.time);
    }
    if (free_rest_) moduli(moduli.size() - 1) = series.static_modulus - rest_;
    return responses(times) * moduli - wanted();
  }

 private:
  static constexpr double noticeable_tangent = 1e-3;  // loss that is less counts as so much
  VectorXd omega_, wanted_, size_;
  double rest_;  // [Pa], at least
  bool free_rest_;
};

/// A series of free times, moved to the least misfit.
class FreeSeries {
 public:
  explicit FreeSeries(const RelativeRows& rows) : rows_(rows) {
    start();
    join_all();
    move(most_steps);
    join();
    move(most_steps);
    series_.static_modulus = rows_.least_rest() + (rows_.free_rest() ? rest_ : 0);
  }
  const PronySeries& series() const { return series_; }

 private:
  static constexpr int most_steps = 60, few_steps = 12;
  static constexpr double beyond = 10;  // the table, at most

  /// Non-negative moduli on a dense grid; neighbours on it are one term.
  void start() {
    constexpr double most_times = 150, most_per_decade = 20;
    const double shortest = 1 / (beyond * rows_.highest()), longest = beyond / rows_.lowest();
    const double decades = std::log10(longest / shortest);
    const auto count = static_cast<int>(std::ceil(decades * std::min(most_per_decade, most_times / decades)));
    std::vector<double> times;
    for (int j = 0; j <= count; ++j)
      times.push_back(shortest * std::pow(longest / shortest, static_cast<double>(j) / count));
    MatrixXd a(2 * rows_.rows(), count + 1 + (rows_.free_rest() ? 1 : 0) + 1);
    a << rows_.responses(times), rows_.wanted();
    if (a.rows() > a.cols()) {
      const Eigen::HouseholderQR<MatrixXd> qr(a);
      a = qr.matrixQR().topRows(a.cols()).triangularView<Eigen::Upper>();
    }
    const VectorXd norms = a.leftCols(a.cols() - 1).colwise().norm();
    const VectorXd moduli =
        nonnegative_least_squares(a.leftCols(a.cols() - 1) * norms.cwiseInverse().asDiagonal(), a.col(a.cols() - 1))
            .cwiseQuotient(norms);
    if (rows_.free_rest()) rest_ = moduli(count + 1);
    bool neighbour = false;
    for (int j = 0; j <= count; ++j) {
      if (const double modulus = moduli(j); modulus > 0) {
        const PronySeries::Term term{modulus, times[static_cast<std::size_t>(j)]};
        if (neighbour)
          series_.terms.back() = one_of(series_.terms.back(), term);
        else
          series_.terms.push_back(term);
      }
      neighbour = moduli(j) > 0;
    }
  }

  static PronySeries::Term one_of(const PronySeries::Term& a, const PronySeries::Term& b) {
    const double sum = a.modulus + b.modulus;
    return {sum, std::exp((a.modulus * std::log(a.time) + b.modulus * std::log(b.time)) / sum)};
  }

  VectorXd residuals() const {
    PronySeries series = series_;
    series.static_modulus = rows_.least_rest() + rest_;
    return rows_.residuals(series);
  }

  /// The moduli of least misfit at the times as they are, where those are positive: along the valleys of the misfit
  /// times and moduli go together.
  void best_moduli() {
    std::vector<double> times;
    for (const PronySeries::Term& term : series_.terms) times.push_back(term.time);
    const VectorXd moduli = Eigen::HouseholderQR<MatrixXd>(rows_.responses(times)).solve(rows_.wanted());
    if (!(moduli.minCoeff() > 0)) return;
    for (std::size_t j = 0; j < times.size(); ++j) series_.terms[j].modulus = moduli(static_cast<Index>(j));
    if (rows_.free_rest()) rest_ = moduli(moduli.size() - 1);
  }

  /// Steps of Levenberg and Marquardt in the logarithms of moduli and times.
  void move(int steps) {
    constexpr double exact = 1e-10, negligible_gain = 1e-5;
    VectorXd residual = residuals();
    double damping = 1e-3;
    for (int step = 0; step < steps && residual.norm() > exact * std::sqrt(residual.size()); ++step) {
      const Index terms = std::ssize(series_.terms);
      const bool rest_moves = rows_.free_rest() && rest_ > 0;
      std::vector<double> times;
      VectorXd moduli(terms);
      for (const PronySeries::Term& term : series_.terms) {
        moduli(std::ssize(times)) = term.modulus;
        times.push_back(term.time);
      }
      const MatrixXd responses = rows_.responses(times);
      const Index parameters = 2 * terms + (rest_moves ? 1 : 0);
      if (parameters == 0) return;
      MatrixXd a(residual.size() + parameters, parameters);
      a.setZero();
      a.topLeftCorner(residual.size(), terms) = responses.leftCols(terms) * moduli.asDiagonal();
      a.block(0, terms, residual.size(), terms) = rows_.slopes(times) * moduli.asDiagonal();
      if (rest_moves) a.col(2 * terms).head(residual.size()) = responses.col(terms) * rest_;
      const VectorXd norms = a.colwise().norm().cwiseMax(1e-300);
      a = a * norms.cwiseInverse().asDiagonal();
      VectorXd b = VectorXd::Zero(a.rows());
      b.head(residual.size()) = -residual;
      bool better = false;
      for (; !better && damping < 1e6; damping *= 10) {
        a.bottomRows(parameters).diagonal().setConstant(std::sqrt(damping));
        const VectorXd change =
            Eigen::HouseholderQR<MatrixXd>(a).solve(b).cwiseQuotient(norms).cwiseMax(-1).cwiseMin(1);
        const FreeSeries before = *this;
        for (Index j = 0; j < terms; ++j) {
          PronySeries::Term& term = series_.terms[static_cast<std::size_t>(j)];
          term.modulus *= std::exp(change(j));
          term.time = std::clamp(term.time * std::exp(change(terms + j)), 1 / (beyond * rows_.highest()),
                                 beyond / rows_.lowest());
        }
        if (rest_moves) rest_ *= std::exp(change(2 * terms));
        best_moduli();
        const VectorXd now = residuals();
        better = now.norm() < residual.norm();
        if (!better) {
          series_ = before.series_;
          rest_ = before.rest_;
          continue;
        }
        const bool done = damping < 1e-8 && now.norm() > (1 - negligible_gain) * residual.norm();
        residual = now;
        if (done) step = steps;
        damping = std::max(1e-14, 0.01 * damping);
      }
      if (!better) break;
    }
    std::sort(series_.terms.begin(), series_.terms.end(), [](const auto& x, const auto& y) { return x.time < y.time; });
  }

  /// Akaike's criterion, corrected for few rows.
  double criterion() const {
    constexpr double exact = 3e-6;  // enough
    const VectorXd residual = residuals();
    const auto n = static_cast<double>(residual.size());
    const double p = 2.0 * static_cast<double>(series_.terms.size()) + 2;
    const double mean = residual.squaredNorm() / n + exact * exact;
    return n * std::log(mean) + 2 * p + 2 * p * (p + 1) / std::max(n - p - 1, n / 4);
  }

  /// All that are nearer than some distance as one, for the largest distance that the criterion allows.
  void join_all() {
    move(few_steps);
    const double before = criterion();
    for (const double distance : {3.2, 2.2, 1.6}) {
      const FreeSeries kept = *this;
      std::vector<PronySeries::Term> few;
      for (const PronySeries::Term& term : kept.series_.terms)
        if (!few.empty() && term.time < distance * few.back().time)
          few.back() = one_of(few.back(), term);
        else
          few.push_back(term);
      series_.terms = std::move(few);
      move(few_steps);
      if (criterion() <= before) return;
      series_ = kept.series_;
      rest_ = kept.rest_;
    }
  }

  /// Neighbours as one, the nearest first, while the criterion falls.
  void join() {
    constexpr double farthest = 10;
    // So many that their cost, as that of a factorisation, is bounded.
    int trials = static_cast<int>(std::clamp(2e4 / std::pow(static_cast<double>(series_.terms.size()), 2), 5.0, 40.0));
    for (bool joined = true; joined;) {
      joined = false;
      std::vector<std::size_t> order(series_.terms.size() < 2 ? 0 : series_.terms.size() - 1);
      std::iota(order.begin(), order.end(), 0U);
      const auto ratio = [&](std::size_t j) { return series_.terms[j + 1].time / series_.terms[j].time; };
      std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ratio(a) < ratio(b); });
      const double before = criterion();
      for (const std::size_t j : order) {
        if (ratio(j) > farthest || trials-- <= 0) break;
        const PronySeries kept = series_;
        const double rest = rest_;
        series_.terms[j] = one_of(series_.terms[j], series_.terms[j + 1]);
        series_.terms.erase(series_.terms.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        move(few_steps);
        joined = criterion() <= before;
        if (joined) break;
        series_ = kept;
        rest_ = rest;
      }
    }
  }

  const RelativeRows& rows_;
  PronySeries series_;
  double rest_ = 0;  // beyond the least [Pa]
};

/// What rows with independent errors leave open of a spectrum that may be off by the order of itself.
OpenSpectrum open_spectrum(const RelativeRows& rows, const PronySeries& series, bool smooth) {
  constexpr double per_decade = 5, decades_open = 4;  // beyond the table at either end
  constexpr double even_share = 0.3;                  // of the loss modulus, of an even spectrum at so many times
  constexpr double enough_rows = 3;                   // a decade; free times have waves between fewer
  constexpr double share_beyond = 1;                  // where a table that ends may miss a single term
  constexpr double least_deviation = 1e-5;
  const double shortest = std::pow(10, -decades_open) / rows.highest();
  const double decades = std::log10(rows.highest() / rows.lowest()) + 2 * decades_open;
  const int count = static_cast<int>(std::ceil(decades * per_decade));
  const double rows_per_decade = static_cast<double>(rows.rows() - 1) / std::log10(rows.highest() / rows.lowest());
  const double share = smooth ? even_share : even_share * std::clamp(enough_rows / rows_per_decade, 1.0, 3.0);
  OpenSpectrum open;
  for (int j = 0; j <= count; ++j) open.times.push_back(shortest * std::pow(10, decades * j / count));
  const Index n = count + 1 + (rows.free_rest() ? 1 : 0);
  VectorXd prior(n);
  for (Index j = 0; j <= count; ++j) {
    const double own = 1 / open.times[static_cast<std::size_t>(j)];
    const double omega = std::clamp(own, rows.lowest(), rows.highest());
    const std::complex<double> modulus = complex_modulus(series, omega);
    prior(j) = (own == omega ? share : share_beyond) * std::max(modulus.imag(), 1e-3 * modulus.real());
  }
  if (rows.free_rest()) prior(n - 1) = series.static_modulus;

  const VectorXd residual = rows.residuals(series);
  const auto row_count = static_cast<double>(rows.rows());
  const double freedom = std::max(row_count / 2, row_count - static_cast<double>(series.terms.size()) - 0.5);
  MatrixXd a(residual.size() + n, n);
  a << rows.responses(open.times) * prior.asDiagonal(), MatrixXd::Identity(n, n);
  for (Index part = 0; part < 2; ++part) {
    const double deviation =
        std::max(least_deviation, std::sqrt(residual.segment(part * rows.rows(), rows.rows()).squaredNorm() / freedom));
    a.middleRows(part * rows.rows(), rows.rows()) /= deviation;
  }
  const Eigen::HouseholderQR<MatrixXd> qr(a);
  const MatrixXd triangle = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  open.spread = prior.asDiagonal() * triangle.triangularView<Eigen::Upper>().solve(MatrixXd::Identity(n, n));
  if (rows.free_rest()) open.times.push_back(INFINITY);
  return open;
}

}  // namespace

std::string MasterCurveFit::in_words() const {
  return message_text("master curve as ", series.terms.size(), " Prony terms, misfit ", 100 * rms_misfit, " % rms and ",
                      100 * largest_misfit, " % at most (at ", worst_frequency, " Hz)");
}

MasterCurveFit fit_master_curve(const MasterCurve& curve) {
  const std::vector<std::size_t> order = rows_in_order(curve);
  MasterCurveFit fit;
  fit.remarks = remarks_on_rows(curve, order);
  const SpectrumProblem problem(curve, order);
  const RelativeRows rows(curve, problem.least_rest_modulus());
  SmoothSeries smooth{FreeSeries(rows).series(), 0};
  const bool few_for_rows = 3 * smooth.series.terms.size() < 2 * order.size();
  if (!few_for_rows || problem.rms_misfit(smooth.series) > trusted_misfit)
    smooth.waves = waves(smooth.series, curve, order);
  const bool waved = smooth.waves > 0;
  if (waved) smooth = smooth_series(problem, curve, order);
  fit.series = smooth.series;
  fit.open = open_spectrum(rows, fit.series, waved);
  fit.rms_misfit = problem.rms_misfit(fit.series);
  std::vector<double> misfits;
  for (std::size_t row = 0; row < order.size(); ++row) {
    misfits.push_back(problem.misfit(fit.series, row));
    if (misfits.back() < fit.largest_misfit) continue;
    fit.largest_misfit = misfits.back();
    fit.worst_frequency = curve.frequencies[row];
  }
  std::vector<double> sorted = misfits;
  std::nth_element(sorted.begin(), sorted.begin() + std::ssize(sorted) / 2, sorted.end());
  const double usual = sorted[sorted.size() / 2];
  for (std::size_t row = 0; row < order.size(); ++row)
    if (misfits[row] > std::max(outlier_ratio * usual, outlier_misfit))
      fit.remarks.push_back("master curve: " + row_name(curve, row) + " is an outlier: " +
                            message_text(100 * misfits[row], " % from the fit, others ", 100 * usual, " %"));
  if (smooth.waves > 0)
    fit.remarks.push_back(
        message_text("master curve: the loss tangent of the fit turns more often than the table's (by ", smooth.waves,
                     "): rows are missing, or storage and loss do not belong to one linear material"));
  if (curve.static_modulus == 0 && fit.series.static_modulus <= problem.least_rest_modulus())
    fit.remarks.push_back(
        message_text("master curve: does not show the modulus at rest, taken as ", fit.series.static_modulus,
                     " Pa, a tenth of the lowest storage modulus; static_shear_modulus gives it where it is known"));
  return fit;
}

std::shared_ptr<const MasterCurveFit> shared_master_curve_fit(const MasterCurve& curve) {
  static RecentlyMade<MasterCurve, MasterCurveFit, 8> cache;
  return cache(curve, [&] { return fit_master_curve(curve); });
}

std::shared_ptr<const MasterCurveFit> shared_master_curve_fit(const MaterialInputs& layer) {
  const auto all_as_shear = [&](std::vector<double> listed) {
    for (double& modulus : listed) modulus = as_shear(layer, modulus);
    return listed;
  };
  const bool at_rest = layer.static_shear_modulus || layer.static_young_modulus;
  return shared_master_curve_fit({layer.frequencies, all_as_shear(layer.storage_moduli),
                                  all_as_shear(layer.loss_moduli), at_rest ? given_static_modulus(layer) : 0});
}

}  // namespace rollres
