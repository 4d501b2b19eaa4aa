#include <cmath>
#include <numeric>
#include <stdexcept>

#include "core/surface/scene_rules.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/study/study.hpp"
#include "studies/study/study_axes.hpp"

namespace rollres {

namespace {

InputValue value_of(const Axis& axis, std::size_t index) {
  if (axis.texts.empty()) return axis.values[index];
  return axis.texts[index];
}

std::string place_of(const Study& study) { return study.source.empty() ? study.name : study.source; }

std::string place_of(const Study& study, const std::vector<std::size_t>& at) {
  std::string place = place_of(study);
  for (std::size_t i = 0; i < at.size(); ++i)
    place += (i == 0 ? ": axes at " : ", ") + study.axes[i].key + " = " + text_of(value_of(study.axes[i], at[i]));
  return place;
}

/// The first constraint that the scene breaks, or their number.
std::size_t first_broken(const Study& study, const RollingScene& scene, const std::vector<std::size_t>& at) {
  std::size_t broken = 0;
  for (; broken < study.constraints.size(); ++broken) {
    const Condition& condition = study.constraints[broken];
    if (std::isnan(condition.excess(scene, {})))
      throw std::invalid_argument(place_of(study, at) + ": " + condition.text() +
                                  ": cannot be decided, a number in it is absent from the scene");
    if (!condition.holds(scene)) break;
  }
  return broken;
}

void refuse_groups_of_different_sizes(const Study& study) {
  for (const auto& group : groups_of(study.axes))
    for (const std::size_t axis : group)
      if (study.axes[axis].size() != study.axes[group.front()].size())
        throw std::invalid_argument(place_of(study) + ": " + study.axes[axis].key + ": must have as many values as " +
                                    study.axes[group.front()].key + ", with which it varies together");
}

}  // namespace

std::size_t StudyPlan::all_dropped() const { return std::accumulate(dropped.begin(), dropped.end(), std::size_t{0}); }

StudyPlan plan(const Study& study) {
  refuse_groups_of_different_sizes(study);
  StudyPlan plan{{}, std::vector<std::size_t>(study.constraints.size(), 0)};
  const auto size_of = [&](const std::vector<std::size_t>& group) { return study.axes[group.front()].size(); };
  for_each_combination(study.axes, size_of, [&](const std::vector<std::size_t>& at) {
    RollingScene scene = study.base;
    for (std::size_t i = 0; i < at.size(); ++i) set_input(scene, study.axes[i].key, value_of(study.axes[i], at[i]));
    const std::size_t broken = first_broken(study, scene, at);
    if (broken < study.constraints.size()) {
      ++plan.dropped[broken];
      return;
    }
    if (const auto rules = check(scene); !rules.empty())
      throw std::invalid_argument(place_of(study, at) + ": " + rules.front());
    plan.scenes.push_back(scene);
  });
  if (plan.scenes.empty() && !plan.dropped.empty())
    throw std::invalid_argument(place_of(study) + ": constraints: no point is left of " +
                                std::to_string(plan.all_dropped()));
  return plan;
}

std::vector<RollingScene> points(const Study& study) { return plan(study).scenes; }

}  // namespace rollres
