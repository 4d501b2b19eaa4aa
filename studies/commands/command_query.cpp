#include <algorithm>
#include <ostream>
#include <stdexcept>

#include "db/merge/gathered.hpp"
#include "studies/program/commands.hpp"
#include "studies/run/stop_signal.hpp"
#include "studies/stored/derived_columns.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

struct QueryArguments {
  std::vector<std::string> databases;
  std::string columns, sort, aggregates, by, format = "table";
  std::optional<std::string> sql;
  std::vector<std::string> filters;
  std::optional<std::int64_t> limit;
};

/// Columns of a table on the screen; the other formats show all.
constexpr const char* usual_columns[] = {"id",
                                         "indenter",
                                         "speed",
                                         "load",
                                         "friction_coefficient",
                                         "rolling_resistance",
                                         "rolling_resistance_coefficient",
                                         "status"};

std::vector<Filter> filters_of(const QueryArguments& arguments) {
  std::vector<Filter> filters;
  for (const std::string& text : arguments.filters) filters.push_back(read_filter(text));
  return filters;
}

/// A table on the screen shows the usual columns and those that the question names.
void choose_columns(Query& question) {
  question.columns.assign(std::begin(usual_columns), std::end(usual_columns));
  auto add = [&](const std::string& name) {
    if (std::find(question.columns.begin(), question.columns.end(), name) == question.columns.end())
      question.columns.insert(question.columns.end() - 1, name);
  };
  for (const Filter& filter : question.filters)
    if (filter.comparison != Comparison::equal) add(filter.column);
  for (const std::string& name : question.sort) add(name.starts_with('-') ? name.substr(1) : name);
}

Table rows(const QueryArguments& arguments, const Database& database) {
  Query question{.filters = filters_of(arguments),
                 .columns = split_at_commas(arguments.columns),
                 .sort = split_at_commas(arguments.sort),
                 .limit = arguments.limit};
  if (question.columns.empty() && arguments.format == "table") choose_columns(question);
  add_derived(database, question);
  return run_query(database, question);
}

Table groups(const QueryArguments& arguments, const Database& database) {
  GroupQuery question{.filters = filters_of(arguments),
                      .by = split_at_commas(arguments.by),
                      .sort = split_at_commas(arguments.sort),
                      .limit = arguments.limit};
  for (const std::string& text : split_at_commas(arguments.aggregates))
    question.aggregates.push_back(parse_aggregate(text));
  add_derived(database, question);
  return run_group_query(database, question);
}

void query(const QueryArguments& arguments, Session& session) {
  const bool grouped = !arguments.aggregates.empty() || !arguments.by.empty();
  const bool plain =
      arguments.filters.empty() && arguments.columns.empty() && arguments.sort.empty() && !arguments.limit && !grouped;
  if (arguments.sql && !plain)
    throw std::invalid_argument("--sql: stands alone; write filters, columns, order and limit in SQL");
  if (grouped && !arguments.columns.empty())
    throw std::invalid_argument("--columns = " + arguments.columns + ": has no place beside --aggregate and --by");
  const StopSignal signal;
  const GatheredDatabases gathered(arguments.databases);
  for (const auto& [file, name, here] : gathered.renamed())
    session.err << file << ": study " << name << " is defined otherwise and comes as " << here << '\n';
  Database database = open_database(gathered.file(), Access::read);
  database.stop_when(signal.requested());
  const Table table =
      arguments.sql ? run_sql(database, *arguments.sql) : (grouped ? groups : rows)(arguments, database);
  write_table(session.out, table, arguments.format);
  if (table.rows.empty()) {
    session.err << joined(arguments.databases) << ": nothing matches\n";
    session.status = ExitStatus::no_answer;
  }
}

}  // namespace

void add_query(Command& program, Session& session) {
  const auto [command, arguments] =
      program.add<QueryArguments>("query", "Find stored evaluations by any input or output", session, query);
  command->add_option(
      "filters FILTER", arguments.filters,
      "KEY=VALUE, also != < <= > >= and ~ (contains); all must hold; KEY is any column, a study (of several, any) or a "
      "position in it; VALUE is a number in SI, one with a unit, or a text; none: what is absent");
  command->add_option("--db FILE", arguments.databases, "database; may be repeated: several are read as one")
      ->one_value_each()
      ->required();
  command->add_option("--columns KEY,...", arguments.columns, "columns to print, separated by commas");
  command->add_option("--sort KEY,...", arguments.sort,
                      "columns to sort by, separated by commas; --sort=-KEY: largest first");
  command->add_option("--limit N", arguments.limit, "print no more than this many rows");
  command->add_option("--aggregate NUMBER,...", arguments.aggregates,
                      "numbers that stand for many rows, separated by commas: count, or min, max, mean, median, stddev "
                      "(of a sample), sum or count and a column; a mean or a sum may be weighted by another, as in "
                      "mean approach weighted share; sorted by as min_approach, count");
  command->add_option("--by KEY,...", arguments.by,
                      "columns, separated by commas: one row for each combination of their values");
  command->add_option("--sql STATEMENT", arguments.sql,
                      "one SQL statement that reads, in place of all the above; tables and views: result, converged, "
                      "resistance, evaluation, study, study_point, fields, provenance, fit, fit_parameter, "
                      "fit_correlation, fit_data, fit_profile, fit_curve");
  command->add_option("--format FORMAT", arguments.format, "table, csv, json, jsonl (one object a line) or markdown")
      ->one_of(table_formats);
  command->footer(
      "Exit status 1: nothing matches.\n"
      "Examples: rollres query --db results.db 'speed>0.1' 'load=20 kN/m' status=converged "
      "--sort=-rolling_resistance --limit 5\n"
      "          rollres query --db one.db --db other.db study=summer study=winter --aggregate 'mean "
      "rolling_resistance "
      "weighted share' --by study\n"
      "          rollres query --db results.db study=tyres --aggregate 'max rolling_resistance, mean approach, count' "
      "--by load");
}

}  // namespace rollres
