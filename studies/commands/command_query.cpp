#include <algorithm>
#include <array>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "db/merge/gathered.hpp"
#include "studies/program/commands.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/stop_signal.hpp"
#include "studies/stored/derived_columns.hpp"
#include "studies/stored/shown_table.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/stored/workbook.hpp"
#include "studies/stored_fits/fit_question.hpp"
#include "studies/study/study_definition.hpp"
#include "studies/text/files.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

struct QueryArguments {
  std::vector<std::string> databases;
  std::string columns, sort, aggregates, by, format = "table", out;
  std::optional<std::string> sql;
  std::vector<std::string> filters;
  std::optional<std::int64_t> limit;
  bool si = false, fits = false;
};

std::vector<Filter> filters_of(const QueryArguments& arguments) {
  std::vector<Filter> filters;
  for (const std::string& text : arguments.filters) filters.push_back(read_filter(text));
  return filters;
}

constexpr auto query_formats = table_formats_and(std::array<std::string_view, 1>{"xlsx"});
constexpr const char* workbook_format = "xlsx";

bool is_for_people(const QueryArguments& arguments) {
  return arguments.format == "table" || arguments.format == "markdown" || arguments.format == workbook_format;
}

ShownUnits units_of(const QueryArguments& arguments) {
  if (arguments.si) return ShownUnits::si;
  return arguments.format == workbook_format ? ShownUnits::scaled_exactly : ShownUnits::scaled;
}

/// What the file of the only study that the question names says; nothing otherwise.
std::optional<StudyDefinition> only_definition(const Database& database, const Query& question) {
  std::vector<std::string> studies;
  for (const Filter& filter : question.filters)
    if (filter.column == study_key && filter.comparison == Comparison::equal) studies.push_back(filter.value);
  if (studies.size() == 1)
    for (const auto& row : run_sql(database, "SELECT name, definition FROM study").rows)
      if (row[0] == Cell(studies.front()))
        return definition_in(std::get<std::string>(row[1]), database.name() + ": " + studies.front());
  return std::nullopt;
}

/// What the only study that the question names computes; the usual outputs otherwise.
std::vector<std::string> outputs_for(const Database& database, const Query& question) {
  const std::optional<StudyDefinition> study = only_definition(database, question);
  std::vector<std::string> outputs = study ? study->compute : std::vector<std::string>();
  if (outputs.empty()) outputs = {"rolling_resistance", "rolling_resistance_coefficient"};
  return outputs;
}

/// For people: what differs, what the question names, and the outputs. Returns those that may be left out for want of
/// room, the least needed last.
std::vector<std::string> choose_columns(const Database& database, Query& question) {
  std::vector<std::string> droppable;
  question.columns = {"id"};
  const auto add = [&](const std::string& name) {
    const bool there = contains(question.columns, name);
    if (!there) question.columns.push_back(name);
    return !there;
  };
  std::vector<std::string> varied = varied_columns(database, question);
  const bool alone = varied.empty();
  if (alone) varied = {"indenter", "speed", "load"};
  std::vector<std::string> named;
  for (const Filter& filter : question.filters)
    if (filter.comparison != Comparison::equal) named.push_back(filter.column);
  for (const std::string& name : question.sort) named.push_back(name.starts_with('-') ? name.substr(1) : name);
  for (const std::string& name : varied)
    if (add(name) && !contains(named, name)) droppable.push_back(name);
  for (const std::string& name : named) add(name);
  if (contains(named, "goal")) add("feasible");
  for (const std::string& name : outputs_for(database, question))
    if (add(name) && name != "rolling_resistance") droppable.push_back(name);
  add("status");
  return droppable;
}

/// All columns, and behind them the formulas of the only study that the question names.
void choose_all(const Database& database, Query& question) {
  const std::optional<StudyDefinition> study = only_definition(database, question);
  if (!question.columns.empty() || !study || study->formulas.empty()) return;
  Query none = question;
  none.limit = 0;
  add_derived(database, none);
  question.columns = run_query(database, none).columns;
  for (const auto& [name, formula] : study->formulas) question.columns.push_back(name);
}

/// Leaves out what a terminal has no room for, and says so.
void fit_to_terminal(Table& table, const std::vector<std::string>& droppable, Session& session) {
  constexpr std::size_t usual_width = 120;  // where there is no terminal
  const std::size_t terminal = terminal_width(session.out);
  const auto dropped = fit_to_width(table, terminal > 0 ? terminal : usual_width, droppable);
  constexpr std::size_t most = 8;
  if (dropped.empty()) return;
  const std::vector<std::string> named(dropped.begin(),
                                       dropped.begin() + static_cast<std::ptrdiff_t>(std::min(most, dropped.size())));
  session.err << "no room for " << joined(named);
  if (dropped.size() > most) session.err << " and " << dropped.size() - most << " others";
  session.err << ": --columns chooses, --format csv has all\n";
}

Query question_of(const QueryArguments& arguments) {
  return {.filters = filters_of(arguments),
          .columns = split_at_commas(arguments.columns),
          .sort = split_at_commas(arguments.sort),
          .limit = arguments.limit};
}

Table rows(const QueryArguments& arguments, const Database& database, Session& session) {
  Query question = question_of(arguments);
  const bool chosen = question.columns.empty() && is_for_people(arguments);
  std::vector<std::string> droppable;
  if (chosen) {
    add_derived(database, question);  // which the filters may name
    droppable = choose_columns(database, question);
  }
  if (!is_for_people(arguments)) choose_all(database, question);
  const FormulaDefinitions formulas = add_derived(database, question);
  if (!is_for_people(arguments)) return run_query(database, question);
  Table table = shown_rows(database, question, formulas, units_of(arguments));
  if (chosen && arguments.format == "table") fit_to_terminal(table, droppable, session);
  return table;
}

Table fits(const QueryArguments& arguments, const Database& database, Session& session) {
  Query question{
      .columns = split_at_commas(arguments.columns), .sort = split_at_commas(arguments.sort), .limit = arguments.limit};
  for (const std::string& text : arguments.filters) question.filters.push_back(read_fit_filter(database, text));
  if (!is_for_people(arguments)) return run_fit_query(database, question);
  ShownFits shown = shown_fits(database, question, units_of(arguments));
  if (arguments.format == "table") fit_to_terminal(shown.table, shown.droppable, session);
  return shown.table;
}

Table groups(const QueryArguments& arguments, const Database& database) {
  GroupQuery question{.filters = filters_of(arguments),
                      .by = split_at_commas(arguments.by),
                      .sort = split_at_commas(arguments.sort),
                      .limit = arguments.limit};
  for (const std::string& text : split_at_commas(arguments.aggregates))
    question.aggregates.push_back(parse_aggregate(text));
  const FormulaDefinitions formulas = add_derived(database, question);
  return is_for_people(arguments) ? shown_groups(database, question, formulas, units_of(arguments))
                                  : run_group_query(database, question);
}

void query(const QueryArguments& arguments, Session& session) {
  const bool grouped = !arguments.aggregates.empty() || !arguments.by.empty();
  const bool plain =
      arguments.filters.empty() && arguments.columns.empty() && arguments.sort.empty() && !arguments.limit && !grouped;
  if (arguments.fits && (arguments.sql || grouped))
    throw std::invalid_argument("--fits: has no place beside --sql, --aggregate and --by");
  if (arguments.sql && !plain)
    throw std::invalid_argument("--sql: stands alone; write filters, columns, order and limit in SQL");
  if (grouped && !arguments.columns.empty())
    throw std::invalid_argument("--columns = " + arguments.columns + ": has no place beside --aggregate and --by");
  if (arguments.format == workbook_format && arguments.out.empty())
    throw std::invalid_argument("--format = xlsx: needs --out FILE, a workbook is not printed");
  const StopSignal signal;
  const GatheredDatabases gathered(arguments.databases);
  session.err << gathered.renamed_in_words();
  Database database = open_database(gathered.file(), Access::read);
  database.stop_when(signal.requested());
  std::size_t found = 0;
  const auto deliver = [&](std::size_t count, const auto& write) {
    found = count;
    if (arguments.out.empty()) return write(session.out);
    std::ostringstream text;
    write(text);
    write_file(arguments.out, std::move(text).str());
  };
  if (arguments.format == "csv" && !arguments.sql && !arguments.fits && !grouped) {  // of any number of rows
    Query question = question_of(arguments);
    choose_all(database, question);
    add_derived(database, question);
    const ColumnTable table = run_column_query(database, question);
    deliver(table.rows, [&](std::ostream& out) { write_csv(out, table); });
  } else {
    const Table table = arguments.sql    ? run_sql(database, *arguments.sql)
                        : arguments.fits ? fits(arguments, database, session)
                        : grouped        ? groups(arguments, database)
                                         : rows(arguments, database, session);
    if (arguments.format == workbook_format) {
      write_workbook(arguments.out, table);
      session.out << arguments.out << ": " << table.rows.size() << " rows\n";
      found = table.rows.size();
    } else {
      deliver(table.rows.size(), [&](std::ostream& out) { write_table(out, table, arguments.format); });
    }
  }
  if (found == 0) {
    session.err << joined(arguments.databases) << ": nothing matches\n";
    session.status = ExitStatus::no_answer;
  }
}

}  // namespace

void add_query(Command& program, Session& session) {
  const auto [command, arguments] =
      program.add<QueryArguments>("query", "Find stored evaluations by any input or output, or fits", session, query);
  command->add_option(
      "filters FILTER", arguments.filters,
      "KEY=VALUE, also != < <= > >= and ~ (contains); all must hold, of several study=NAME any one. KEY is a column, "
      "study, or position (in the study). VALUE is a number in SI, a number with a unit, or a text; none: the value is "
      "absent");
  command->add_option("--db FILE", arguments.databases, "database; may be repeated: several are read as one")
      ->one_value_each()
      ->or_usual_database();
  command->add_flag("--fits", arguments.fits,
                    "fits in place of evaluations: KEY is name, kind, status, reduced_chi_squared and so on, a fitted "
                    "parameter, or this with _error, _lowest or _highest (its 95 % interval)");
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
                      "fit_correlation, fit_data, fit_input, fit_profile, fit_curve, fit_failure");
  command
      ->add_option("--format FORMAT", arguments.format,
                   "table, csv, json, jsonl (one object a line), markdown, or xlsx (a workbook for Excel and others: "
                   "all digits, units in the headings)")
      ->one_of(query_formats);
  command->add_option("--out FILE", arguments.out, "write into this file, not to the terminal; xlsx needs it");
  command->add_flag(
      "--si", arguments.si,
      "SI numbers in a table, too, where there are units with a prefix and degrees Celsius; csv, json and "
      "jsonl always have them");
  command->footer(
      "Exit status 1: nothing matches.\n"
      "Examples: rollres query --db results.db 'speed>0.1' 'load=20 kN/m' status=converged "
      "--sort=-rolling_resistance --limit 5\n"
      "          rollres query --db one.db --db other.db study=summer study=winter --aggregate 'mean "
      "rolling_resistance "
      "weighted share' --by study\n"
      "          rollres query --db results.db study=optimise_layer feasible=1 --sort goal --limit 5   (the best "
      "designs)\n"
      "          rollres query --db results.db --fits status=GOOD 'creep_time_error<1 ms' --sort creep_time\n"
      "          rollres query --db results.db study=tyres --aggregate 'max rolling_resistance, mean approach, count' "
      "--by load");
}

}  // namespace rollres
