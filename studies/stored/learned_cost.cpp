#include "studies/stored/learned_cost.hpp"

#include "core/model/scene_rules.hpp"

namespace rollres {

static_assert(ChoiceNames<Method>::names.size() * 8 <= LearnedCost::kinds);

CostKind cost_kind(const RollingScene& scene) {
  auto kind = static_cast<CostKind>(resolved_method(scene));
  for (const bool one :
       {dimension_of(scene.indenter) == 3, scene.friction_coefficient > 0, scene.tolerance && !scene.spacing})
    kind = 2 * kind + (one ? 1 : 0);
  return kind;
}

void LearnedCost::add(CostKind kind, double predicted, double seconds) {
  if (!(seconds > 0) || !(predicted > 0)) return;
  Sums& sums = sums_.at(kind);
  sums.predicted += predicted;
  sums.seconds += seconds;
  ++sums.count;
}

double LearnedCost::ratio(CostKind kind) const {
  if (knows(kind)) return sums_.at(kind).seconds / sums_.at(kind).predicted;
  Sums all;
  for (const Sums& one : sums_) {
    all.predicted += one.predicted;
    all.seconds += one.seconds;
  }
  return all.predicted > 0 ? all.seconds / all.predicted : 1;
}

}  // namespace rollres
