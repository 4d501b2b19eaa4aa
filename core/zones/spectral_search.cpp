#include "core/zones/spectral_search.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/dense_algebra.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

using Eigen::VectorXd;

constexpr int most_steps = 40;
constexpr double lost = 1e3;  // residual over the least so far at which nothing good is to come
constexpr double nearly_done = 1e-10, nearly_done_fresh = 1e-9;  // where a step fails by rounding; with fresh slopes

/// Centre and logarithm of the half-length; roots of the parts of the contact that each zone takes but for the stick
/// next to the leading edge, which takes the rest: the residuals are smooth in them even as a zone shrinks.
VectorXd place_of(const SlipPattern& pattern, const SpectralEdges& edges, double unit) {
  VectorXd place(pattern.unknowns());
  const Interval& contact = edges.contact;
  const double length = contact.to - contact.from;
  place(0) = contact.centre() / unit;
  place(1) = std::log(contact.half_length() / unit);
  Eigen::Index at = 2;
  for (std::size_t i = 0; i <= pattern.sticks() && pattern.sticks() > 0; ++i) {
    const double from = i == 0 ? contact.from : edges.sticks[i - 1].to;
    const double to = i == pattern.sticks() ? contact.to : edges.sticks[i].from;
    if (pattern.slips[i] != 0) place(at++) = std::sqrt((to - from) / length);
    if (i + 1 < pattern.sticks()) place(at++) = std::sqrt((edges.sticks[i].to - edges.sticks[i].from) / length);
  }
  return place;
}

SpectralEdges edges_at(const SlipPattern& pattern, const VectorXd& place, double unit) {
  const double centre = unit * place(0), half = unit * std::exp(place(1));
  SpectralEdges edges{{centre - half, centre + half}, {}};
  Eigen::Index at = 2;
  const auto next_length = [&] {
    const double root = place(at++);
    return 2 * half * root * root;
  };
  double x = edges.contact.from;
  for (std::size_t i = 0; i < pattern.sticks(); ++i) {
    if (pattern.slips[i] != 0) x += next_length();
    edges.sticks.push_back({x, x});
    if (i + 1 < pattern.sticks()) x = edges.sticks.back().to = x + next_length();
  }
  if (pattern.sticks() > 0) edges.sticks.back().to = edges.contact.to - (pattern.slips.back() != 0 ? next_length() : 0);
  return edges;
}

/// Part of the contact that the stick next to the leading edge takes.
double stick_part(const VectorXd& place) { return 1 - place.tail(place.size() - 2).squaredNorm(); }

/// The part of a step that leaves each zone a part of its length, and the contact its size.
double allowed_part(const SlipPattern& pattern, const VectorXd& place, const VectorXd& step) {
  double part = 1;
  for (int i = 0; i < 2; ++i) part = std::min(part, 0.5 / std::max(std::abs(step(i)), 0.5));
  for (Eigen::Index i = 2; i < place.size(); ++i)
    if (step(i) < -0.7 * place(i)) part = std::min(part, -0.7 * place(i) / step(i));
  if (pattern.sticks() > 0)
    while (stick_part(place + part * step) < 0.3 * stick_part(place) && part > 1e-6) part *= 0.7;
  return part;
}

double largest(const SpectralState& state) {
  return state.residuals.allFinite() ? state.residuals.cwiseAbs().maxCoeff() : NAN;
}

/// Zones that have shrunk away.
bool vanished(const VectorXd& place) {
  if (place.size() == 2) return false;
  return place.tail(place.size() - 2).minCoeff() < 1e-8 || stick_part(place) < 1e-8;
}

}  // namespace

SpectralState EdgeSearch::evaluate(const VectorXd& place, const SpectralOrders& orders) {
  ++evaluations_;
  if (!place.allFinite() || std::abs(place(1)) > 20 || (pattern_.sticks() > 0 && !(stick_part(place) > 1e-9))) {
    SpectralState nowhere;
    nowhere.residuals.setConstant(place.size(), NAN);
    return nowhere;
  }
  return solve_inside(problem_, pattern_, edges_at(pattern_, place, slopes_.unit), orders, nearby_);
}

bool EdgeSearch::differentiate(const VectorXd& place, const SpectralState& state, const SpectralOrders& orders) {
  Eigen::MatrixXd slopes(place.size(), place.size());
  for (Eigen::Index k = 0; k < place.size(); ++k) {
    const double difference = k < 2 ? 1e-6 : -1e-6 * std::min({1.0, place(k), stick_part(place)});
    VectorXd beside = place;
    beside(k) += difference;
    slopes.col(k) = (evaluate(beside, orders).residuals - state.residuals) / difference;
  }
  slopes_.inverse = SquareSystem(slopes).inverse();
  return slopes_.inverse.allFinite();
}

std::optional<SpectralState> EdgeSearch::find(const SpectralEdges& start, const SpectralOrders& orders,
                                              double tolerance, int most_evaluations) {
  const int last_evaluation = evaluations_ + most_evaluations;
  if (slopes_.inverse.size() == 0) slopes_.unit = start.contact.half_length();
  VectorXd place = place_of(pattern_, start, slopes_.unit);
  SpectralState state = evaluate(place, orders);
  double residual = largest(state);
  double least = residual;
  bool fresh = false;
  for (int step = 0; step < most_steps && evaluations_ < last_evaluation && residual > tolerance; ++step) {
    require_time();
    least = std::min(least, residual);
    if (!std::isfinite(residual) || residual > lost * least || vanished(place)) return {};
    if (slopes_.inverse.size() == 0) {
      if (!differentiate(place, state, orders)) return {};
      fresh = true;
    }
    const VectorXd full = -slopes_.inverse * state.residuals;
    const VectorXd move = allowed_part(pattern_, place, full) * full;
    SpectralState next = evaluate(place + move, orders);
    const double next_residual = largest(next);
    if (!(next_residual < 0.5 * residual)) {
      if (residual < (fresh ? nearly_done_fresh : nearly_done)) {  // as near as rounding lets it come
        if (next_residual < residual) state = std::move(next);
        return state;
      }
      // Broyden's slopes have led astray.
      if (!fresh) {
        slopes_.inverse.resize(0, 0);
        if (next_residual < residual) {
          place += move;
          state = std::move(next);
          residual = next_residual;
        }
        continue;
      }
      slopes_.inverse.resize(0, 0);
      if (!std::isfinite(next_residual)) return {};
    } else {
      const VectorXd change = slopes_.inverse * (next.residuals - state.residuals);
      const double length = move.dot(change);
      if (length != 0) slopes_.inverse += (move - change) * (move.transpose() * slopes_.inverse) / length;
    }
    fresh = false;
    place += move;
    state = std::move(next);
    residual = next_residual;
  }
  if (!(residual <= std::max(tolerance, nearly_done_fresh))) return {};
  return state;
}

}  // namespace rollres
