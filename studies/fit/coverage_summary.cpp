#include "studies/fit/coverage_summary.hpp"

#include <algorithm>
#include <sstream>

#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

std::string coverage_summary(const Coverage& coverage) {
  std::ostringstream text;
  text << "\ncoverage: " << coverage.fitted << " of " << coverage.draws << " draws fitted, seed " << coverage.seed
       << "\n";
  Table table{{"parameter", "truth", "95 % linear holds", "95 % profile holds", "mean offset", "scatter"}, {}};
  const auto part = [&](int count) { return percent(static_cast<double>(count) / std::max(1, coverage.fitted)); };
  for (const ParameterCoverage& count : coverage.parameters)
    table.rows.push_back({count.name, count.truth, part(count.linear),
                          coverage.profiles ? part(count.profile) : std::string("-"), count.mean_offset,
                          count.offset_scatter});
  write_aligned(text, table);
  for (const std::string& failure : coverage.failures) text << "not fitted: " << failure << '\n';
  return text.str();
}

Json json_of(const Coverage& coverage) {
  Json object = json_object("draws", coverage.draws, "fitted", coverage.fitted, "seed", coverage.seed, "parameters",
                            Json::array(), "failures", coverage.failures);
  for (const ParameterCoverage& parameter : coverage.parameters)
    object["parameters"].push_back(
        json_object("name", parameter.name, "truth", parameter.truth, "linear", parameter.linear, "profile",
                    coverage.profiles ? Json(parameter.profile) : Json(nullptr), "mean_offset", parameter.mean_offset,
                    "offset_scatter", parameter.offset_scatter));
  return object;
}

}  // namespace rollres
