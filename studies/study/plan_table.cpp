#include "studies/study/plan_table.hpp"

#include <algorithm>

#include "db/rows/schema.hpp"
#include "studies/scene_io/cells.hpp"

namespace rollres {

std::vector<Cell> stored_status(ResultStore& store, const StudyPlan& plan) {
  std::vector<Cell> status;
  plan.for_each([&](std::size_t, const RollingScene& scene) {
    const auto found = store.find_answer(evaluation_key(scene));
    status.push_back(found ? Cell(std::string(name_of(found->status))) : Cell());
  });
  return status;
}

StoredPoints count_stored(const std::vector<Cell>& status) {
  StoredPoints stored;
  for (const Cell& cell : status)
    if (const auto* const name = std::get_if<std::string>(&cell)) {
      ++stored.answered;
      if (*name != name_of(Status::converged)) ++stored.failed;
    }
  return stored;
}

Table plan_table(const Study& study, const StudyPlan& plan, const std::vector<Cell>& status, std::size_t limit) {
  Table table{{"position"}, {}};
  for (const Axis& axis : study.axes) table.columns.push_back(axis.key);
  if (!status.empty()) table.columns.push_back("status");
  const std::vector<std::string> variants = plan.variants();
  for (std::size_t point = 0; point < std::min(limit, plan.size()); ++point) {
    table.rows.push_back({static_cast<std::int64_t>(point + 1)});
    const RollingScene scene = plan.scene(point);
    for (const Axis& axis : study.axes)
      table.rows.back().push_back(axis.key == variant_key ? Cell(variants[point]) : input_of(scene, axis.key));
    if (!status.empty()) table.rows.back().push_back(status[point]);
  }
  return table;
}

}  // namespace rollres
