#include "core/newton/friction_limit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/model/contact_surface.hpp"
#include "core/newton/contact_powers.hpp"
#include "core/newton/nested_newton.hpp"

namespace rollres {

namespace {

constexpr double sliding = 1e4;  // omega - 1 at which the whole contact slides one way

/// Surplus of the drive's row [N] in the direction asked for, when the body turns faster (+1) or more slowly (-1) than
/// it rolls by `excess` in R Omega / V; NaN if that could not be solved. Each solution is the next one's start.
class Surplus {
 public:
  Surplus(const ContactModel& model, const SurfaceGrid& half_grid, int direction)
      : model_(model), grid_(half_grid), direction_(direction) {}

  double operator()(double friction, double excess = sliding) {
    model_.friction_coefficient = friction;
    ContactModel turning = model_;
    turning.drive = Drive::rotation;
    turning.driving_torque.reset();
    turning.rotation_ratio = 1 + direction_ * excess;
    if (last_) last_->outcome.unknowns.rotation_ratio = last_->problem->shape.law_ratio(*turning.rotation_ratio);
    ContactLevel level = solve_level(turning, grid_, last_ ? &*last_ : nullptr, Effort::start);
    if (!level.outcome.converged) return RollingSolution::absent;
    const ContactProblem wanted(model_, level.problem->grid);
    const ContactUnknowns& x = level.outcome.unknowns;
    const double value = direction_ * wanted.drive_surplus(x.pressure, x.shear_x, x.shear_y,
                                                           coating_moments(wanted, *level.influence, x));
    last_ = std::move(level);
    return value;
  }

 private:
  ContactModel model_;
  SurfaceGrid grid_;
  int direction_;
  std::optional<ContactLevel> last_;
};

/// Friction coefficient at which the nearly linear, rising function `value` vanishes; `start` if it is positive there,
/// NaN if there is none.
template <class Function>
double friction_root(Function value, double start) {
  double low = start, low_value = value(start);
  if (!(low_value < 0)) return low_value >= 0 ? start : RollingSolution::absent;
  // Steps to where it should vanish, and shorter ones where a body under more friction digs itself in.
  double factor = 1.2, high = start, high_value = low_value;
  for (int step = 0; step < 60 && !(high_value >= 0) && factor > 1 + 1e-6; ++step) {
    high = factor * low;
    high_value = value(high);
    if (std::isnan(high_value)) {
      factor = std::sqrt(factor);
    } else if (high_value < 0) {
      const double expected =
          high_value > low_value ? high + (high - low) * high_value / (low_value - high_value) : INFINITY;
      low = high;
      low_value = high_value;
      factor = std::clamp(1.01 * expected / high, 1.02, factor * factor);
    }
  }
  if (!(high_value >= 0)) return RollingSolution::absent;
  for (int step = 0; step < 40 && high_value > 0 && high - low > 1e-6 * high; ++step) {
    // Regula falsi that keeps off the ends, but steps just beyond the root it expects.
    const double expected = -low_value / (high_value - low_value);
    const double middle = low + (high - low) * std::clamp(expected + (step % 2 == 0 ? 1e-4 : -1e-4), 1e-3, 0.999);
    const double middle_value = value(middle);
    if (std::isnan(middle_value)) return RollingSolution::absent;
    (middle_value < 0 ? low : high) = middle;
    (middle_value < 0 ? low_value : high_value) = middle_value;
  }
  return high;
}

/// Excess of the rotation at which friction gives most, if that is more than when everything slides; else `sliding`.
/// @param force by which to measure the surplus [N]
double best_excess(Surplus& surplus, double friction, double force) {
  const auto value = [&](double excess) { return surplus(friction, excess); };
  double best = sliding, best_value = value(sliding);
  constexpr double ratio = 1.8;
  for (double excess = 100; excess > 1e-3; excess /= ratio) {
    const double found = value(excess);
    if (found > best_value) {
      best = excess;
      best_value = found;
    } else if (found < best_value - 0.1 * force) {
      break;
    }
  }
  if (best == sliding) return best;
  // Golden section in the logarithm.
  constexpr double part = 0.381966;
  double low = best / ratio, high = best * ratio;
  for (int step = 0; step < 8; ++step) {
    const bool upper = high / best > best / low;
    const double excess = upper ? best * std::pow(high / best, part) : best * std::pow(low / best, part);
    const double found = value(excess);
    if (found > best_value) {
      (upper ? low : high) = best;
      best = excess;
      best_value = found;
    } else {
      (upper ? high : low) = excess;
    }
  }
  return best;
}

}  // namespace

SlidingLimit sliding_limit(const ContactModel& model, const SurfaceGrid& half_grid) {
  bool known = true;
  for (const int direction : {1, -1}) {
    const double value = Surplus(model, half_grid, direction)(model.friction_coefficient);
    if (value < 0) return SlidingLimit::not_enough;
    known = known && !std::isnan(value);
  }
  return known ? SlidingLimit::enough : SlidingLimit::unknown;
}

double friction_needed(const ContactModel& model, const SurfaceGrid& half_grid) {
  const double given = model.friction_coefficient;
  for (const int direction : {1, -1}) {
    Surplus surplus(model, half_grid, direction);
    const double value = surplus(given);
    if (std::isnan(value)) return RollingSolution::absent;
    if (value >= 0) continue;
    double needed = friction_root([&](double friction) { return surplus(friction); }, given);
    // A largest traction may leave no coefficient that is enough.
    if (std::isnan(needed) && model.traction_limit) {
      const double excess = best_excess(surplus, given, model.load.value_or(std::abs(value)) * given);
      return surplus(given, excess) >= 0 ? given : INFINITY;
    }
    // Friction may give more at a moderate rotation, where part of the contact sticks or is drawn aside.
    for (int pass = 0; pass < 3 && needed > given; ++pass) {
      const double excess = best_excess(surplus, needed, model.load.value_or(std::abs(value)) * needed);
      if (excess == sliding) break;
      const double less = friction_root([&](double friction) { return surplus(friction, excess); }, given);
      if (!(less < needed * (1 - 1e-5))) break;
      needed = less;
    }
    return needed;
  }
  return given;
}

double sliding_torque(const ContactModel& model, const SurfaceGrid& half_grid) {
  const double asked = *model.driving_torque;
  const double surplus = Surplus(model, half_grid, asked > 0 ? 1 : -1)(model.friction_coefficient);
  return std::abs(asked) + model.radius * surplus;
}

double friction_borne(const ContactModel& model, const SurfaceGrid& half_grid) {
  const auto solved = [&](double friction) {
    ContactModel weaker = model;
    weaker.friction_coefficient = friction;
    const ContactLevel level = solve_level(weaker, half_grid, nullptr, Effort::all);
    return level.outcome.converged && !level.outcome.reached_border;
  };
  double high = model.friction_coefficient, low = high / 1.2;
  for (int step = 0; !solved(low); ++step) {
    if (step == 5) return RollingSolution::absent;
    high = low;
    low /= 1.5;
  }
  while (high > 1.005 * low) {
    const double middle = std::sqrt(low * high);
    (solved(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace rollres
