#include "core/spectral_search.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace rollres {

namespace {

using Eigen::VectorXd;

constexpr int most_steps = 40;

/// Centre and logarithm of the half-length, roots of the slipping parts of the contact: the residuals are smooth in
/// them even as a zone shrinks.
VectorXd place_of(const SlipPattern& pattern, const SpectralEdges& edges, double unit) {
  VectorXd place(pattern.unknowns());
  const double length = 2 * edges.half_length();
  place(0) = edges.centre() / unit;
  place(1) = std::log(edges.half_length() / unit);
  if (pattern.trailing_slip()) place(2) = std::sqrt((edges.stick_from - edges.trailing) / length);
  if (pattern.leading_slip()) place(3) = std::sqrt((edges.leading - edges.stick_to) / length);
  return place;
}

SpectralEdges edges_at(const SlipPattern& pattern, const VectorXd& place, double unit) {
  const double centre = unit * place(0), half = unit * std::exp(place(1));
  SpectralEdges edges{centre - half, centre + half, centre - half, centre + half};
  if (pattern.trailing_slip()) edges.stick_from += 2 * half * place(2) * place(2);
  if (pattern.leading_slip()) edges.stick_to -= 2 * half * place(3) * place(3);
  return edges;
}

/// Part of the contact that sticks, between those that slip.
double stick_part(const VectorXd& place) {
  return 1 - place.tail(place.size() - 2).squaredNorm();
}

/// The part of a step that leaves each zone a part of its length, and the contact its size.
double allowed_part(const SlipPattern& pattern, const VectorXd& place, const VectorXd& step) {
  double part = 1;
  for (int i = 0; i < 2; ++i) part = std::min(part, 0.5 / std::max(std::abs(step(i)), 0.5));
  for (Eigen::Index i = 2; i < place.size(); ++i)
    if (step(i) < -0.7 * place(i)) part = std::min(part, -0.7 * place(i) / step(i));
  if (pattern.trailing_slip())
    while (stick_part(place + part * step) < 0.3 * stick_part(place) && part > 1e-6) part *= 0.7;
  return part;
}

double largest(const SpectralState& state) {
  return state.residuals.allFinite() ? state.residuals.cwiseAbs().maxCoeff() : NAN;
}

/// Zones that have shrunk away.
bool vanished(const SlipPattern& pattern, const VectorXd& place) {
  if (!pattern.trailing_slip()) return false;
  return place.tail(place.size() - 2).minCoeff() < 1e-8 || stick_part(place) < 1e-5;
}

}  // namespace

SpectralState EdgeSearch::evaluate(const VectorXd& place, const SpectralOrders& orders) {
  ++evaluations_;
  if (!place.allFinite() || std::abs(place(1)) > 20 || (pattern_.stick && !(stick_part(place) > 1e-7))) {
    SpectralState nowhere;
    nowhere.residuals.setConstant(place.size(), NAN);
    return nowhere;
  }
  return solve_inside(problem_, pattern_, edges_at(pattern_, place, unit_), orders);
}

bool EdgeSearch::differentiate(const VectorXd& place, const SpectralState& state, const SpectralOrders& orders) {
  Eigen::MatrixXd slopes(place.size(), place.size());
  for (Eigen::Index k = 0; k < place.size(); ++k) {
    const double difference = k < 2 ? 1e-6 : -1e-6 * std::min({1.0, place(k), stick_part(place)});
    VectorXd beside = place;
    beside(k) += difference;
    slopes.col(k) = (evaluate(beside, orders).residuals - state.residuals) / difference;
  }
  inverse_ = slopes.partialPivLu().inverse();
  return inverse_.allFinite();
}

std::optional<SpectralState> EdgeSearch::find(const SpectralEdges& start, const SpectralOrders& orders,
                                              double tolerance) {
  if (inverse_.size() == 0) unit_ = start.half_length();
  VectorXd place = place_of(pattern_, start, unit_);
  SpectralState state = evaluate(place, orders);
  double residual = largest(state);
  bool fresh = false;
  for (int step = 0; step < most_steps && residual > tolerance; ++step) {
    if (!std::isfinite(residual) || vanished(pattern_, place)) return {};
    if (inverse_.size() == 0) {
      if (!differentiate(place, state, orders)) return {};
      fresh = true;
    }
    const VectorXd full = -inverse_ * state.residuals;
    const VectorXd move = allowed_part(pattern_, place, full) * full;
    SpectralState next = evaluate(place + move, orders);
    const double next_residual = largest(next);
    if (!(next_residual < 0.5 * residual)) {
      // Broyden's slopes have led astray, or this is as near as rounding lets it come.
      if (!fresh) {
        inverse_.resize(0, 0);
        if (next_residual < residual) {
          place += move;
          state = std::move(next);
          residual = next_residual;
        }
        continue;
      }
      if (residual < 1e3 * tolerance && residual < 1e-9) break;
      inverse_.resize(0, 0);
      if (!std::isfinite(next_residual)) return {};
    } else {
      const VectorXd change = inverse_ * (next.residuals - state.residuals);
      const double length = move.dot(change);
      if (length != 0) inverse_ += (move - change) * (move.transpose() * inverse_) / length;
    }
    fresh = false;
    place += move;
    state = std::move(next);
    residual = next_residual;
  }
  if (!(residual <= std::max(tolerance, std::min(1e3 * tolerance, 1e-9)))) return {};
  return state;
}

}  // namespace rollres
