#include "core/material/relative_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/algebra/dense_algebra.hpp"
#include "core/material/prony_series.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/numerics/sorted_places.hpp"

namespace rollres {

namespace {

/// Loss tangent below which a loss modulus counts as this part of its storage modulus.
constexpr double noticeable_tangent = 1e-3;
/// Smallest share of the lowest storage modulus that stays at rest where nothing says it.
constexpr double share_at_rest = 0.1;
/// Any creep at once is a spring; without one the modulus would be infinite at once.
constexpr double share_at_once = 1e-3;

}  // namespace

RelativeRows::RelativeRows(const MasterCurve& curve)
    : RelativeRows(curve, curve.is_relaxation() ? Kind::relaxation : Kind::moduli) {}

RelativeRows RelativeRows::of_creep(const std::vector<double>& times, const std::vector<double>& compliances) {
  MasterCurve curve{{}, compliances, {}};
  for (const double time : times) curve.frequencies.push_back(1 / (2 * std::numbers::pi * time));
  return {curve, Kind::creep};
}

RelativeRows::RelativeRows(const MasterCurve& curve, Kind kind) : kind_(kind), free_rest_(curve.static_modulus == 0) {
  const Eigen::Index rows = std::ssize(curve.frequencies);
  omega_ = 2 * std::numbers::pi * Eigen::Map<const Eigen::VectorXd>(curve.frequencies.data(), rows);
  wanted_.resize(rows + std::ssize(curve.loss));
  wanted_ << Eigen::Map<const Eigen::VectorXd>(curve.storage.data(), rows),
      Eigen::Map<const Eigen::VectorXd>(curve.loss.data(), std::ssize(curve.loss));
  size_ = wanted_;
  if (kind_ == Kind::moduli) size_.tail(rows) = wanted_.tail(rows).cwiseMax(noticeable_tangent * wanted_.head(rows));
  noise_ = Eigen::VectorXd::Ones(wanted_.size());
  const double share = kind_ == Kind::creep ? share_at_once : share_at_rest;
  rest_ = free_rest_ ? share * wanted_.head(rows).minCoeff() : curve.static_modulus;
  order_ = sorted_places(std::ssize(curve.frequencies), [&](Eigen::Index row) { return omega_(row); });
  loss_ = kind_ == Kind::moduli ? Eigen::VectorXd(size_.tail(rows)) : loss_over_time();
}

Eigen::VectorXd RelativeRows::loss_over_time() const {
  Eigen::VectorXd loss(rows());
  for (Eigen::Index i = 0; i < rows(); ++i) {
    const Eigen::Index here = order_[static_cast<std::size_t>(i)],
                       below = order_[static_cast<std::size_t>(std::max<Eigen::Index>(i - 1, 0))],
                       above = order_[static_cast<std::size_t>(std::min(i + 1, rows() - 1))];
    const double apart = std::max(std::log(omega_(above) / omega_(below)), 0.1);
    const double rise = kind_ == Kind::creep ? wanted_(below) - wanted_(above) : wanted_(above) - wanted_(below);
    loss(here) = std::max(std::numbers::pi / 2 * rise / apart, noticeable_tangent * wanted_(here));
  }
  return loss;
}

RelativeRows RelativeRows::with_noise(const Eigen::VectorXd& noise) const {
  RelativeRows rows = *this;
  rows.noise_ = noise;
  return rows;
}

double RelativeRows::decades() const { return std::log10(highest() / lowest()); }

Eigen::MatrixXd RelativeRows::responses(const std::vector<double>& times) const {
  Eigen::MatrixXd a(equations(), std::ssize(times) + (free_rest_ ? 1 : 0));
  for (Eigen::Index j = 0; j < std::ssize(times); ++j) {
    const Eigen::ArrayXd turn = omega_.array() * times[static_cast<std::size_t>(j)];
    if (kind_ == Kind::relaxation)
      a.col(j) = (-1 / turn).exp();
    else if (kind_ == Kind::creep)
      a.col(j) = -(-1 / turn).expm1();
    else
      a.col(j) << (1 - 1 / (1 + turn.square())), turn / (1 + turn.square());
  }
  if (free_rest_) a.col(a.cols() - 1) << Eigen::VectorXd::Ones(rows()), Eigen::VectorXd::Zero(equations() - rows());
  return a.array().colwise() / (size_.array() * noise_.array());
}

Eigen::MatrixXd RelativeRows::slopes(const std::vector<double>& times) const {
  Eigen::MatrixXd a(equations(), std::ssize(times));
  for (Eigen::Index j = 0; j < std::ssize(times); ++j) {
    const Eigen::ArrayXd turn = omega_.array() * times[static_cast<std::size_t>(j)];
    const Eigen::ArrayXd square = turn.square(), whole = (1 + square).square();
    if (kind_ == Kind::relaxation)
      a.col(j) = (-1 / turn).exp() / turn;
    else if (kind_ == Kind::creep)
      a.col(j) = -(-1 / turn).exp() / turn;
    else
      a.col(j) << 2 * square / whole, turn * (1 - square) / whole;
  }
  return a.array().colwise() / (size_.array() * noise_.array());
}

Eigen::VectorXd RelativeRows::wanted() const {
  Eigen::VectorXd wanted = wanted_;
  wanted.head(rows()).array() -= rest_;
  return wanted.cwiseQuotient(size_.cwiseProduct(noise_));
}

Eigen::VectorXd RelativeRows::residuals(const PronySeries& series) const {
  std::vector<double> times;
  Eigen::VectorXd moduli(std::ssize(series.terms) + (free_rest_ ? 1 : 0));
  for (const PronySeries::Term& term : series.terms) {
    moduli(std::ssize(times)) = term.modulus;
    times.push_back(term.time);
  }
  if (free_rest_) moduli(moduli.size() - 1) = series.static_modulus - rest_;
  return responses(times) * moduli - wanted();
}

double RelativeRows::loss_at(double omega) const {
  const auto loss = [&](Eigen::Index row) { return loss_(row); };
  const auto above = std::lower_bound(order_.begin(), order_.end(), omega,
                                      [&](Eigen::Index row, double at) { return omega_(row) < at; });
  if (above == order_.begin()) return loss(order_.front());
  if (above == order_.end()) return loss(order_.back());
  const Eigen::Index a = *(above - 1), b = *above;
  return loss(a) * std::pow(loss(b) / loss(a), std::log(omega / omega_(a)) / std::log(omega_(b) / omega_(a)));
}

Eigen::VectorXd nonnegative_moduli(const RelativeRows& rows, const std::vector<double>& times) {
  require_time();
  const Eigen::MatrixXd responses = rows.responses(times);
  Eigen::MatrixXd a(responses.rows(), responses.cols() + 1);
  a << responses, rows.wanted();
  if (a.rows() > a.cols()) a = OverdeterminedSystem(a).triangle();  // has the same least squares
  Eigen::VectorXd norms = a.leftCols(a.cols() - 1).colwise().norm();
  norms = (norms.array() > 0).select(norms, 1);  // a time far beyond the rows adds nothing to them
  return nonnegative_least_squares(a.leftCols(a.cols() - 1) * norms.cwiseInverse().asDiagonal(), a.col(a.cols() - 1))
      .cwiseQuotient(norms);
}

TermSlopes::TermSlopes(const RelativeRows& rows, const PronySeries& series) {
  require_time();
  const Eigen::Index count = std::ssize(series.terms);
  moduli.resize(count + (rows.free_rest() ? 1 : 0));
  for (const PronySeries::Term& term : series.terms) {
    moduli(std::ssize(times)) = term.modulus;
    times.push_back(term.time);
  }
  if (rows.free_rest()) moduli(count) = series.static_modulus;
  slopes.resize(rows.equations(), moduli.size() + count);
  slopes << rows.responses(times) * moduli.asDiagonal(), rows.slopes(times) * moduli.head(count).asDiagonal();
}

}  // namespace rollres
