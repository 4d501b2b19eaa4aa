#include "studies/optimise/design_records.hpp"

#include <algorithm>

namespace rollres {

namespace {

DesignRecord record_of(const DesignProblem& problem, const Design& design) {
  DesignRecord record{.keys = design.keys, .goal = design.value};
  if (problem.pareto) record.second_goal = design.second;
  const auto own = static_cast<std::ptrdiff_t>(
      std::min(constraint_places(problem).size(), design.constraints.size()));  // without the bound of a front
  record.feasible = std::all_of(design.constraints.begin(), design.constraints.begin() + own,
                                [](const ConstraintSides& sides) { return sides.holds; });
  return record;
}

void add_designs(std::vector<DesignRecord>& records, const DesignProblem& problem, const OptimiseReport& report) {
  for (const Design& design : report.designs) records.push_back(record_of(problem, design));
}

}  // namespace

std::vector<DesignRecord> design_records(std::span<const DesignProblem> problems,
                                         std::span<const OptimiseReport> reports) {
  std::vector<DesignRecord> records;
  for (std::size_t i = 0; i < reports.size(); ++i) add_designs(records, problems[i], reports[i]);
  return records;
}

std::vector<DesignRecord> design_records(std::span<const DesignProblem> problems, const ParetoReport& front) {
  std::vector<DesignRecord> records;
  std::int64_t place = 0;
  for (const ParetoPoint& point : front.points) {
    const auto& best = point.report.best;
    if (!best || point.dominated) continue;
    if (!records.empty() && records.back().keys == best->keys) continue;  // two bounds, one design
    records.push_back(record_of(problems[point.choice], *best));
    records.back().front = ++place;
  }
  for (const ParetoPoint& point : front.points) add_designs(records, problems[point.choice], point.report);
  return records;
}

}  // namespace rollres
