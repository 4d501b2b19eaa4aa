#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "core/model/scene_rules.hpp"
#include "core/numerics/parallel.hpp"
#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/study/study.hpp"
#include "studies/study/study_axes.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

InputValue value_of(const Axis& axis, std::size_t index) {
  if (axis.texts.empty()) return axis.values[index];
  return axis.texts[index];
}

std::string place_of(const Study& study) { return study.source.empty() ? study.name : study.source; }

/// The scenes of combinations, each made from the one before: only groups of axes that move on are set anew.
class CombinationScenes {
 public:
  CombinationScenes(const std::vector<RollingScene>& bases, const std::vector<Axis>& axes)
      : bases_(bases),
        axes_(axes),
        groups_(groups_of(axes)),
        at_(groups_.size(), 0),
        scenes_(groups_.size() + 1, bases.front()) {}

  /// How many combinations there are.
  std::size_t count() const {
    std::size_t product = 1;
    for (const auto& group : groups_) product *= axes_[group.front()].size();
    return product;
  }

  const RollingScene& operator()(std::size_t combination) {
    std::size_t first_changed = made_ ? groups_.size() : 0;
    for (std::size_t group = groups_.size(); group-- > 0;) {
      const std::size_t size = axes_[groups_[group].front()].size(), at = combination % size;
      combination /= size;
      if (at == at_[group]) continue;
      at_[group] = at;
      first_changed = std::min(first_changed, group);
    }
    made_ = true;
    for (std::size_t group = first_changed; group < groups_.size(); ++group) {
      if (axes_[groups_[group].front()].key == variant_key) {  // the first of all
        scenes_[group + 1] = bases_[at_[group]];
        continue;
      }
      scenes_[group + 1] = scenes_[group];
      for (const std::size_t axis : groups_[group])
        set_input(scenes_[group + 1], axes_[axis].key, value_of(axes_[axis], at_[group]));
    }
    return scenes_.back();
  }

  /// "speed = 1, load = 2": the values of the combination that was asked for last.
  std::string values() const {
    std::vector<std::string> texts;
    for (std::size_t group = 0; group < groups_.size(); ++group)
      for (const std::size_t axis : groups_[group]) {
        const InputValue value = value_of(axes_[axis], at_[group]);
        const bool angle = find_number(axes_[axis].key) && find_number(axes_[axis].key)->quantity.unit == "rad";
        texts.push_back(axes_[axis].key + " = " + (angle ? in_degrees(std::get<double>(value)) : text_of(value)));
      }
    return joined(texts);
  }

 private:
  const std::vector<RollingScene>& bases_;
  const std::vector<Axis>& axes_;
  std::vector<std::vector<std::size_t>> groups_;  // of axes that vary together
  std::vector<std::size_t> at_;                   // place of each group in its values
  std::vector<RollingScene> scenes_;              // [n]: with the values of the first n groups
  bool made_ = false;
};

/// The first constraint that the scene breaks, or their number.
std::size_t first_broken(const std::vector<Condition>& constraints, const RollingScene& scene) {
  std::size_t broken = 0;
  for (; broken < constraints.size(); ++broken) {
    const double excess = constraints[broken].excess(scene);
    if (std::isnan(excess))
      throw std::invalid_argument(constraints[broken].text() +
                                  ": cannot be decided, a number in it is absent from the scene");
    if (!constraints[broken].holds_with(excess)) break;
  }
  return broken;
}

std::vector<RollingScene> bases_of(const Study& study) {
  std::vector<RollingScene> bases;
  for (const Variant& variant : study.variants) bases.push_back(variant.base);
  if (bases.empty()) bases.push_back(study.base);
  return bases;
}

void refuse_groups_of_different_sizes(const Study& study) {
  for (const auto& group : groups_of(study.axes))
    for (const std::size_t axis : group)
      if (study.axes[axis].size() != study.axes[group.front()].size())
        throw std::invalid_argument(place_of(study) + ": " + study.axes[axis].key + ": must have as many values as " +
                                    study.axes[group.front()].key + ", with which it varies together");
}

}  // namespace

StudyPlan::StudyPlan(const Study& study)
    : bases_(bases_of(study)), axes_(study.axes), dropped_(study.constraints.size(), 0) {
  refuse_groups_of_different_sizes(study);
  CombinationScenes scenes(bases_, axes_);
  try {
    for (std::size_t combination = 0; combination < scenes.count(); ++combination) {
      const RollingScene& scene = scenes(combination);
      if (const std::size_t broken = first_broken(study.constraints, scene); broken < dropped_.size()) {
        ++dropped_[broken];
        continue;
      }
      if (const auto rules = check(scene); !rules.empty()) throw std::invalid_argument(rules.front());
      combinations_.push_back(static_cast<std::uint32_t>(combination));
    }
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(place_of(study) + ": axes at " + scenes.values() + ": " + error.what());
  }
  if (!combinations_.empty() || dropped_.empty()) return;
  std::string shares;
  for (std::size_t i = 0; i < dropped_.size(); ++i)
    shares += (i == 0 ? ": " : ", ") + study.constraints[i].text() + " drops " + std::to_string(dropped_[i]);
  throw std::invalid_argument(place_of(study) + ": constraints: no point is left of " + std::to_string(all_dropped()) +
                              shares);
}

RollingScene StudyPlan::scene(std::size_t point) const {
  return CombinationScenes(bases_, axes_)(combinations_.at(point));
}

void StudyPlan::for_each(const std::function<void(std::size_t, const RollingScene&)>& visit) const {
  CombinationScenes scenes(bases_, axes_);
  for (std::size_t point = 0; point < combinations_.size(); ++point) visit(point, scenes(combinations_[point]));
}

std::vector<std::string> StudyPlan::keys() const {
  constexpr std::size_t together = 4096;
  std::vector<std::string> keys(size());
  for_each_piece((size() + together - 1) / together, 0, [&](std::size_t piece) {
    CombinationScenes scenes(bases_, axes_);
    for (std::size_t point = piece * together; point < std::min(size(), (piece + 1) * together); ++point)
      keys[point] = evaluation_key(scenes(combinations_[point]));
  });
  return keys;
}

std::vector<std::string> StudyPlan::variants() const {
  std::vector<std::string> names;
  if (axes_.empty() || axes_.front().key != variant_key) return names;
  const std::size_t of_each = CombinationScenes(bases_, axes_).count() / bases_.size();
  for (const std::uint32_t combination : combinations_) names.push_back(axes_.front().texts[combination / of_each]);
  return names;
}

std::size_t StudyPlan::all_dropped() const { return std::accumulate(dropped_.begin(), dropped_.end(), std::size_t{0}); }

}  // namespace rollres
