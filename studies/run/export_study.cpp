#include "studies/run/export_study.hpp"

#include <stdexcept>

#include "core/scene/scene_input.hpp"
#include "db/queries/query.hpp"
#include "db/rows/result_store.hpp"
#include "studies/stored/accepted_study.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/text/files.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

namespace {

constexpr const char* readme = R"(A study of rolling resistance, exported by rollres VERSION.

study.json       the study: base scene, axes, chart. `rollres sweep study.json --db FILE` computes it anew
results.csv      one line for each answered point, one column for each input and output, in SI units; empty: absent.
                 `rollres quantities` explains the columns
results.db       the same as an SQLite database: table evaluation, views such as result
provenance.json  which version of rollres, on which machine, computed how many of the points, and when

`rollres import FOLDER --db FILE` brings the results into another database; doing so again changes nothing.
)";

Json provenance_of(ResultStore& store, const StudySummary& study) {
  Json object =
      json_object("study", study.name, "created", study.created, "started", study.started, "points", study.points,
                  "answered", study.answered, "failed", study.failed, "programs", Json::array(), "exported_by",
                  json_object("version", this_program().version, "git_hash", this_program().git_hash));
  for (const ComputedShare& made : computed_shares(store, study.name)) {
    Json& program = object["programs"].emplace_back(json_of(made.program));
    program.update({{"points", made.points}, {"first_result", made.first}, {"last_result", made.last}});
  }
  return object;
}

/// All columns of the study's rows, and after them the inputs of further layers.
ColumnTable results_of(const ResultStore& store, const std::string& study) {
  Query query{.filters = {{"study", Comparison::equal, study}}, .limit = 0};
  query.columns = run_query(store.database(), query).columns;
  query.limit.reset();
  for (const QuantityColumn* const column : quantity_columns_of(store.database(), query.filters))
    if (layer_key(column->name)) query.columns.push_back(column->name);
  return run_column_query(store.database(), query);
}

}  // namespace

std::string export_study(const std::filesystem::path& database, const std::string& wanted,
                         const std::filesystem::path& folder) {
  ResultStore store(database, Access::read);
  const std::string name = stored_study_name(store, wanted);
  const std::filesystem::path own = folder / "results.db";
  if (std::filesystem::exists(own) && !ResultStore(own, Access::read).definition(name))
    throw std::invalid_argument("out = " + folder.string() + ": holds another study");
  make_directory(folder);

  extract_study(database, name, own);
  ResultStore exported(own, Access::read);
  write_file(folder / "results.csv", csv_of(results_of(exported, name)));
  write_file(folder / "provenance.json", text_of(provenance_of(exported, exported.study(name).value()), 2) + "\n");
  const std::string definition = exported.definition(name).value_or("");
  write_file(folder / "study.json", accepted_study(definition));
  std::string text = readme;
  text.replace(text.find("VERSION"), 7, this_program().version);
  write_file(folder / "README.txt", text);

  const Json parsed = definition.empty() ? Json::object() : parse_object(definition, database.string() + ": " + name);
  const auto scene = parsed.find("scene");
  if (scene != parsed.end() && scene->is_object()) return "";
  return definition.empty() ? "no study file was stored; study.json is empty"
                            : "the scene was not stored with the study; study.json needs the file " + shown(*scene);
}

MergeReport import_study(const std::filesystem::path& folder, const Database& into) {
  return merge(into, folder / "results.db");
}

}  // namespace rollres
