#pragma once

/// How long scenes will take on this machine: what is predicted from their inputs (predicted_cost.hpp) times how much
/// longer than predicted stored solutions of their kind took. Kinds are told by what the predictions differ most in:
/// the method, the body, friction, and whether a tolerance or a spacing decides on the grid.

#include <array>
#include <cstddef>

#include "core/scene/scene.hpp"

namespace rollres {

using CostKind = std::size_t;
CostKind cost_kind(const RollingScene& scene);

class LearnedCost {
 public:
  /// A solution that took so many seconds.
  void add(CostKind kind, double predicted, double seconds);

  /// Seconds that others took over those predicted: of the kind, once `enough` of it are known; else of all; 1 without
  /// any.
  double ratio(CostKind kind) const;
  /// Whether the kind has enough of its own.
  bool knows(CostKind kind) const { return sums_.at(kind).count >= enough; }

  static constexpr std::size_t enough = 8, kinds = 64;

 private:
  struct Sums {
    double predicted = 0, seconds = 0;
    std::size_t count = 0;
  };
  std::array<Sums, kinds> sums_{};
};

}  // namespace rollres
