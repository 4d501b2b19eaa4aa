#include <algorithm>
#include <memory>
#include <ostream>
#include <stdexcept>

#include "db/queries/query.hpp"
#include "db/rows/schema.hpp"
#include "studies/program/command_line.hpp"
#include "studies/program/commands.hpp"
#include "studies/run/stop_signal.hpp"
#include "studies/stored/read_filter.hpp"
#include "studies/text/split.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

namespace {

struct QueryWords {
  std::string database, columns, sort, aggregates, by, sql, format = "table";
  bool with_sql = false;
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

std::vector<Filter> filters_of(const QueryWords& words) {
  std::vector<Filter> filters;
  for (const std::string& text : words.filters) filters.push_back(read_filter(text));
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

Table rows(const QueryWords& words, const Database& database) {
  Query question{.filters = filters_of(words),
                 .columns = split_at_commas(words.columns),
                 .sort = split_at_commas(words.sort),
                 .limit = words.limit};
  if (question.columns.empty() && words.format == "table") choose_columns(question);
  return run_query(database, question);
}

Table groups(const QueryWords& words, const Database& database) {
  GroupQuery question{.filters = filters_of(words),
                      .by = split_at_commas(words.by),
                      .sort = split_at_commas(words.sort),
                      .limit = words.limit};
  for (const std::string& text : split_at_commas(words.aggregates))
    question.aggregates.push_back(parse_aggregate(text));
  return run_group_query(database, question);
}

void query(const QueryWords& words, Session& session) {
  const bool grouped = !words.aggregates.empty() || !words.by.empty();
  const bool plain = words.filters.empty() && words.columns.empty() && words.sort.empty() && !words.limit && !grouped;
  if (words.with_sql && !plain)
    throw std::invalid_argument("--sql: stands alone; write filters, columns, order and limit in SQL");
  if (grouped && !words.columns.empty())
    throw std::invalid_argument("--columns = " + words.columns + ": has no place beside --aggregate and --by");
  const StopSignal signal;
  Database database = open_database(words.database, Access::read);
  database.stop_when(signal.requested());
  const Table table = words.with_sql ? run_sql(database, words.sql) : (grouped ? groups : rows)(words, database);
  write_table(session.out, table, words.format);
  if (table.rows.empty()) {
    session.err << words.database << ": nothing matches\n";
    session.status = ExitStatus::no_answer;
  }
}

}  // namespace

void add_query(Command& program, Session& session) {
  Command* command = program.add_subcommand("query", "Find stored evaluations by any input or output");
  const auto words = std::make_shared<QueryWords>();
  command
      ->add_option("filters", words->filters,
                   "KEY=VALUE, also != < <= > >= and ~ (contains); all must hold; KEY is any column, a study or a "
                   "position in it; VALUE is a number in SI, one with a unit, or a text; none: what is absent")
      ->option_text("FILTER");
  command->add_option("--db", words->database, "database")->option_text("FILE")->required();
  command->add_option("--columns", words->columns, "columns to print, separated by commas")->option_text("KEY,...");
  command->add_option("--sort", words->sort, "columns to sort by, separated by commas; --sort=-KEY: largest first")
      ->option_text("KEY,...");
  command->add_option("--limit", words->limit, "print no more than this many rows")->option_text("N");
  command
      ->add_option("--aggregate", words->aggregates,
                   "numbers that stand for many rows, separated by commas: count, or min, max, mean, median, stddev "
                   "(of a sample), sum or count and a column; sorted by as min_approach, count")
      ->option_text("NUMBER,...");
  command->add_option("--by", words->by, "columns, separated by commas: one row for each combination of their values")
      ->option_text("KEY,...");
  CommandOption* const sql =
      command
          ->add_option("--sql", words->sql,
                       "one SQL statement that reads, in place of all the above; tables and views: result, converged, "
                       "resistance, evaluation, study, study_point, fields, provenance")
          ->option_text("STATEMENT");
  command->add_option("--format", words->format, "table, csv, json, jsonl (one object a line) or markdown")
      ->option_text("FORMAT")
      ->one_of(table_formats);
  command->footer(
      "Exit status 1: nothing matches.\n"
      "Examples: rollres query --db results.db 'speed>0.1' 'load=20 kN/m' status=converged "
      "--sort=-rolling_resistance --limit 5\n"
      "          rollres query --db results.db study=tyres --aggregate 'max rolling_resistance, mean approach, count' "
      "--by load");
  command->callback([words, sql, &session] {
    words->with_sql = sql->given();
    query(*words, session);
  });
}

}  // namespace rollres
