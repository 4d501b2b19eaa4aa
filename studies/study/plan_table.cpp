#include "studies/study/plan_table.hpp"

#include <algorithm>
#include <optional>
#include <type_traits>

#include "core/messages/number_list.hpp"
#include "core/scene/scene_input.hpp"
#include "db/rows/layer_list.hpp"

namespace rollres {

namespace {

Cell cell_of(double value) { return value; }
Cell cell_of(int value) { return std::int64_t{value}; }
Cell cell_of(const std::optional<double>& value) { return value ? Cell(*value) : Cell(); }
Cell cell_of(const std::vector<double>& list) { return list.empty() ? Cell() : Cell(text_of_list(list)); }
Cell cell_of(const BondedLayers& layers) { return layers.empty() ? Cell() : Cell(text_of_layers(layers)); }
template <class Choice>
requires std::is_enum_v<Choice> Cell cell_of(Choice choice) { return std::string(name_of(choice)); }

}  // namespace

Cell input_of(const RollingScene& scene, std::string_view key) {
  Cell cell;
  visit_input(scene, key, [&](const Quantity&, const auto& value) { cell = cell_of(value); });
  return cell;
}

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
  for (std::size_t point = 0; point < std::min(limit, plan.size()); ++point) {
    table.rows.push_back({static_cast<std::int64_t>(point + 1)});
    const RollingScene scene = plan.scene(point);
    for (const Axis& axis : study.axes) table.rows.back().push_back(input_of(scene, axis.key));
    if (!status.empty()) table.rows.back().push_back(status[point]);
  }
  return table;
}

}  // namespace rollres
