#include "studies/stored/scatter_results.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "db/rows/schema.hpp"
#include "studies/scene_io/cells.hpp"
#include "studies/study/study_axes.hpp"

namespace rollres {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

template <class Count>
std::size_t sum_of(const std::vector<ScatterPlace>& places, Count count) {
  return std::accumulate(places.begin(), places.end(), std::size_t{0},
                         [&](std::size_t sum, const ScatterPlace& place) { return sum + place.*count; });
}

ScatterPlace empty_place(const Study& study, std::size_t formulas, std::size_t conditions) {
  const ScatterBatches batches(study.uncertain.scramblings);
  return {.at = {},
          .values = std::vector<ScatterBatches>(formulas, batches),
          .holds = std::vector<ScatterBatches>(conditions, batches)};
}

}  // namespace

std::size_t ScatterResults::points() const { return sum_of(places, &ScatterPlace::points); }
std::size_t ScatterResults::failed() const { return sum_of(places, &ScatterPlace::failed); }
std::size_t ScatterResults::missing() const { return sum_of(places, &ScatterPlace::missing); }

ScatterResults scatter_results(const Study& study, const StudyPlan& plan, ResultStore& store,
                               const std::vector<Formula>& formulas, const std::vector<Condition>& conditions) {
  ScatterResults results;
  for (const Axis& axis : study.axes)
    if (axis.group != uncertain_group) results.axes.push_back(axis.key);
  const std::size_t together = study.uncertain.points, each = study.uncertain.points_of_each();
  const std::vector<std::string> variants = plan.variants();
  std::optional<std::size_t> last;
  plan.for_each([&](std::size_t point, const RollingScene& scene) {
    const std::size_t combination = plan.combination(point), batch = combination % together / each;
    if (last != combination / together) {
      last = combination / together;
      results.places.push_back(empty_place(study, formulas.size(), conditions.size()));
      for (const std::string& key : results.axes)
        results.places.back().at.push_back(key == variant_key ? Cell(variants[point]) : input_of(scene, key));
    }
    ScatterPlace& place = results.places.back();
    ++place.points;
    const std::optional<RollingSolution> answer = store.solution(evaluation_key(scene));
    const bool converged = answer && answer->status == Status::converged;
    if (!answer)
      ++place.missing;
    else if (!converged) {
      ++place.failed;
      ++results.reasons[answer->reason.empty() ? std::string(name_of(answer->status)) : answer->reason];
    }
    for (std::size_t i = 0; i < formulas.size(); ++i)
      place.values[i][batch].push_back(converged ? formulas[i](scene, *answer) : none);
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      const double excess = converged ? conditions[i].excess(scene, *answer) : none;
      place.holds[i][batch].push_back(std::isnan(excess) ? none : conditions[i].holds_with(excess));
    }
  });
  return results;
}

ScatterEstimate probability(const ScatterBatches& holds) {
  ScatterEstimate estimate = mean_of(holds);
  const auto count = static_cast<double>(sorted_values(holds).size());
  if (estimate.value == 0 || estimate.value == 1) estimate.error = 3 / count;
  return estimate;
}

}  // namespace rollres
