#include "studies/explore/explored_studies.hpp"

#include <charconv>
#include <stdexcept>

#include "db/queries/fit_query.hpp"
#include "db/queries/query.hpp"
#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/charts/study_chart.hpp"
#include "studies/explore/explored_scene.hpp"
#include "studies/report/report.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "studies/stored/derived_columns.hpp"
#include "studies/stored/shown_table.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

std::string text_or_empty(const Asked& asked, const std::string& key) {
  const auto found = asked.find(key);
  return found == asked.end() ? "" : found->second;
}

std::int64_t count_in(const Asked& asked, const std::string& key, std::int64_t usual, std::int64_t most) {
  const std::string text = text_or_empty(asked, key);
  if (text.empty()) return usual;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), usual);
  if (error != std::errc() || end != text.data() + text.size() || usual < 0 || usual > most)
    throw std::invalid_argument(key + " = " + text + ": must be a whole number from 0 to " + std::to_string(most));
  return usual;
}

std::vector<Filter> filters_in(const Asked& asked) {
  std::vector<Filter> filters;
  std::istringstream lines(text_or_empty(asked, "where"));
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) filters.push_back(read_filter(line));
  return filters;
}

/// The question whose rows are those of a study that meet the filters.
Query rows_of_study(const Database& database, const Asked& asked) {
  Query question{.filters = filters_in(asked)};
  question.filters.push_back({.column = "study", .value = text_or_empty(asked, "study")});
  question.columns = split_at_commas(text_or_empty(asked, "columns"));
  if (question.columns.empty()) {
    for (const auto& row : run_sql(database, "SELECT name, axes FROM study").rows)
      if (row[0] == Cell(text_or_empty(asked, "study"))) {
        std::istringstream axes(std::get<std::string>(row[1]));
        for (std::string axis; axes >> axis;) question.columns.push_back(axis);
      }
    for (const char* const key : {"rolling_resistance", "rolling_resistance_coefficient", "error_estimate", "status"})
      question.columns.emplace_back(key);
  }
  std::erase(question.columns, "id");
  question.columns.insert(question.columns.begin(), "id");
  question.sort = split_at_commas(text_or_empty(asked, "sort"));
  return question;
}

}  // namespace

Json studies_for_pages(const std::filesystem::path& database) {
  Json studies = Json::array(), fits = Json::array();
  if (std::error_code none; !std::filesystem::exists(database, none)) return {{"studies", studies}, {"fits", fits}};
  ResultStore store(database, Access::read);
  for (const StudySummary& study : store.studies())
    studies.push_back(json_object("name", study.name, "axes", study.axes, "charts", stored_charts(store, study.name),
                                  "points", study.points, "answered", study.answered, "failed", study.failed,
                                  "last_result", study.last_result, "note", study.note));
  for (const auto& row : run_fit_query(store.database(), {.columns = {"name", "kind", "status"}}).rows)
    fits.push_back({{"name", json_of(row[0])}, {"kind", json_of(row[1])}, {"status", json_of(row[2])}});
  return {{"studies", studies}, {"fits", fits}};
}

Json study_chart_for_pages(const std::filesystem::path& database, const Asked& asked) {
  ResultStore store(database, Access::read);
  const StoredChart chart = stored_chart(store, {.study = text_or_empty(asked, "study"),
                                                 .chart = text_or_empty(asked, "chart"),
                                                 .x = text_or_empty(asked, "x"),
                                                 .y = text_or_empty(asked, "y"),
                                                 .family = text_or_empty(asked, "family"),
                                                 .filters = filters_in(asked)});
  Json reply = chart_for_pages(chart.request);
  reply["points"] = chart.points;
  reply["unanswered"] = chart.unanswered;
  reply["missing"] = chart.missing;
  reply["keys"] = {{"x", chart.x}, {"families", chart.families}};
  return reply;
}

Json rows_for_pages(const std::filesystem::path& database, const Asked& asked) {
  constexpr std::int64_t most_rows = 1000, farthest = 100'000'000;
  const Database open = open_database(database, Access::read);
  Query question = rows_of_study(open, asked);
  const FormulaDefinitions formulas = add_derived(open, question);
  question.offset = count_in(asked, "offset", 0, farthest);
  question.limit = count_in(asked, "limit", 100, most_rows);
  const std::vector<std::string> keys = question.columns;
  const Table shown = shown_rows(open, question, formulas, ShownUnits::scaled);
  Json rows = Json::array();
  for (const auto& row : shown.rows) {
    rows.push_back(Json::array());
    for (const Cell& cell : row) rows.back().push_back(json_of(cell));
  }
  return {{"columns", shown.columns}, {"keys", keys}, {"rows", rows}, {"offset", question.offset}};
}

Json count_for_pages(const std::filesystem::path& database, const Asked& asked) {
  const Database open = open_database(database, Access::read);
  GroupQuery count{.filters = rows_of_study(open, asked).filters, .aggregates = {{.statistic = Statistic::count}}};
  add_derived(open, count);
  const Table all = run_group_query(open, count);
  return {{"all", all.rows.empty() ? Json(0) : json_of(all.rows.front().back())}};
}

Json point_for_pages(const std::filesystem::path& database, const Asked& asked) {
  constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  ResultStore store(database, Access::read);
  const std::int64_t id = count_in(asked, "id", -1, largest);
  const auto found = store.find(id);
  if (!found) throw std::invalid_argument("id = " + text_or_empty(asked, "id") + ": no evaluation has it");
  return {{"scene", parse_object(scene_json(found->scene), "id " + std::to_string(id))},
          {"solution", parse_object(solution_line(found->solution, std::to_string(id)), "solution")}};
}

std::string report_for_pages(const std::filesystem::path& database, const Asked& asked) {
  ResultStore store(database, Access::read);
  return study_report(store, {.study = text_or_empty(asked, "study"), .filters = filters_in(asked)}).html;
}

}  // namespace rollres
