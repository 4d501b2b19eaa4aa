#pragma once

/// All temperatures at which layers that lose power are steady, with few exact answers.
///
/// At a mean temperature T the layers lose a power that would bring them to base + rise(T): a steady state is where
/// that is T. An estimate of the rise at many temperatures, times what exact answers near by were over it (its
/// logarithm interpolated), tells where; each exact answer is asked where the corrected estimate is steady, until the
/// answer agrees itself. States are stable where base + rise - T falls with T, that is, where heat leaves faster than
/// it is made: the lowest one is, and is the one that layers warming from cold reach.

#include <functional>
#include <optional>
#include <vector>

namespace rollres {

/// Mean temperature of layers that lose nothing, and what their loss at some temperature adds [K].
struct HeatBalance {
  double base = 0, rise = 0;
};

struct SteadyTemperature {
  double temperature = 0;  ///< [K]
  bool stable = true;
  double missed = 0;  ///< by the exact answer, base + rise - T [K]
};

struct SteadyTemperatures {
  std::vector<SteadyTemperature> states;  ///< ascending, of exact answers
  std::optional<double> unanswered;       ///< a temperature at which there is no exact answer, which ended the search
  std::optional<double> beyond;           ///< without states: the last temperature, at which more is lost than leaves
};

/// What is known before: an estimate of the rise at ascending temperatures, > 0, in any unit; and one of its size and
/// of the base.
struct RiseEstimate {
  std::vector<double> temperatures, rise;
  double factor = 1;  ///< of the rise in K
  double base = 0;    ///< [K]
};

/// @param exact the balance at a temperature; nothing where there is no answer
SteadyTemperatures steady_temperatures(const RiseEstimate& estimate,
                                       const std::function<std::optional<HeatBalance>(double)>& exact);

}  // namespace rollres
