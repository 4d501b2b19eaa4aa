#include <ostream>
#include <tuple>

#include "db/rows/fit_store.hpp"
#include "studies/evidence/comparison.hpp"
#include "studies/program/commands.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/stored_fits/stored_comparison.hpp"
#include "studies/stored_fits/stored_fit.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

struct CompareArguments {
  std::vector<std::string> studies;
  std::string database, other_database, outputs, ignored, format = "table";
  std::optional<double> within;
  std::optional<std::size_t> limit;
};

constexpr std::size_t lines_on_screen = 20;

/// With its unit, where that is the same for all bodies.
std::string input_in_words(const std::string& key, const Cell& cell) {
  if (std::holds_alternative<std::monostate>(cell)) return "not given";
  const QuantityColumn* const column = find_quantity_column(key);
  if (!column || column->quantity.grows_with_width()) return value_in_words(cell, "");
  return value_in_words(column->quantity, cell, column->quantity.unit);
}

Table table_of(const StudyComparison& comparison, std::optional<std::size_t> limit) {
  Table table{{"position"}, {}};
  table.columns.insert(table.columns.end(), comparison.axes.begin(), comparison.axes.end());
  for (const char* name : {"output", "first", "second", "difference"}) table.columns.emplace_back(name);
  for (const PointDifference& one : comparison.differences) {
    if (limit && table.rows.size() >= *limit) break;
    std::vector<Cell>& row = table.rows.emplace_back();
    row.emplace_back(one.position);
    row.insert(row.end(), one.inputs.begin(), one.inputs.end());
    row.insert(row.end(), {one.output, one.first, one.second, one.relative});
  }
  return table;
}

void print_summary(std::ostream& out, const StudyComparison& comparison) {
  for (const ComparedInput& input : comparison.compared)
    out << input.key << ": " << input_in_words(input.key, input.first) << " against "
        << input_in_words(input.key, input.second) << '\n';
  out << comparison.matched << " points match, " << comparison.only_first << " are only in the first study, "
      << comparison.only_second << " only in the second\n";
  if (comparison.half_answered > 0) out << comparison.half_answered << " have an answer in one study only\n";
  if (comparison.unanswered > 0) out << comparison.unanswered << " have an answer in neither\n";
  for (const OutputDifference& output : comparison.outputs)
    if (output.points > 0)
      out << output.output << ": relative difference at most " << short_number(output.largest, 3) << ", rms "
          << short_number(output.rms, 3) << ", at " << output.points << " points\n";
}

Json report_of(const StudyComparison& comparison, const CompareArguments& arguments) {
  Json object = json_object("first", arguments.studies.front(), "second", arguments.studies.back(), "compared",
                            Json::array(), "matched", comparison.matched, "only_first", comparison.only_first,
                            "only_second", comparison.only_second, "half_answered", comparison.half_answered,
                            "unanswered", comparison.unanswered, "outputs", Json::array());
  for (const ComparedInput& input : comparison.compared)
    object["compared"].push_back(
        {{"key", input.key}, {"first", json_of(input.first)}, {"second", json_of(input.second)}});
  for (const OutputDifference& output : comparison.outputs)
    object["outputs"].push_back(json_object("output", output.output, "points", output.points, "largest",
                                            json_of(Cell(output.largest)), "rms", json_of(Cell(output.rms))));
  if (arguments.within) object["within"] = comparison.within(*arguments.within);
  object["differences"] = json_of(table_of(comparison, arguments.limit));
  return object;
}

void print_table(const CompareArguments& arguments, const StudyComparison& comparison, Session& session) {
  print_summary(session.out, comparison);
  Table table = table_of(comparison, arguments.limit.value_or(lines_on_screen));
  if (table.rows.empty()) return;
  for (std::vector<Cell>& row : table.rows)  // after the position
    for (std::size_t i = 0; i < comparison.axes.size(); ++i)
      row[i + 1] = input_in_words(comparison.axes[i], row[i + 1]);
  session.out << '\n';
  write_aligned(session.out, table);
  if (const std::size_t left = comparison.differences.size() - table.rows.size(); left > 0)
    session.err << left << " smaller differences are not shown; --limit sets how many are\n";
}

/// The two fits that are meant where the names are not those of studies; empty: studies are.
std::optional<StoredComparison> compared_fits(const CompareArguments& arguments) {
  const std::string& other = arguments.other_database.empty() ? arguments.database : arguments.other_database;
  ResultStore first(arguments.database, Access::read), second(other, Access::read);
  if (first.definition(arguments.studies.front()) || second.definition(arguments.studies.back())) return std::nullopt;
  const auto a = find_fit(first.database(), arguments.studies.front(), FitParts::with_data);
  const auto b = find_fit(second.database(), arguments.studies.back(), FitParts::with_data);
  if (!a && !b) return std::nullopt;
  for (const auto& [found, name, store] : {std::tuple(a.has_value(), arguments.studies.front(), &first),
                                           {b.has_value(), arguments.studies.back(), &second}}) {
    if (!found) refuse_fit(store->database(), name, store->database().name() + ": ");
  }
  if (arguments.studies.size() == 1 && arguments.other_database.empty())
    throw std::invalid_argument("fit = " + a->name + ": needs a second fit, or a second database with --with");
  return compare_fits(*a, *b);
}

void print_fits(const CompareArguments& arguments, const StoredComparison& comparison, Session& session) {
  for (const auto& [option, word] :
       {std::pair("--outputs", arguments.outputs), std::pair("--ignore", arguments.ignored)})
    if (!word.empty())
      throw std::invalid_argument(std::string(option) + " = " + word + ": is for studies, not for fits");
  if (arguments.limit) throw std::invalid_argument("--limit: is for studies, not for fits");
  if (arguments.format == "csv") throw std::invalid_argument("--format = csv: of fits there are table and json");
  Json object = json_of(comparison);
  if (arguments.within) object["within"] = comparison.within(*arguments.within);
  session.out << (arguments.format == "json" ? text_of(object, 2) + "\n" : stored_comparison_summary(comparison));
  if (arguments.within ? comparison.within(*arguments.within) : !comparison.parameters.empty()) return;
  session.status = ExitStatus::no_answer;
  session.err << (comparison.parameters.empty() ? "nothing matches\n"
                                                : "not within " + short_number(*arguments.within) + "\n");
}

/// Two studies, or fits, the first and the last that are named.
void compare_two(const CompareArguments& arguments, Session& session) {
  if (const auto fits = compared_fits(arguments)) return print_fits(arguments, *fits, session);
  ComparisonOptions options{.ignored = split_at_commas(arguments.ignored)};
  if (!arguments.outputs.empty()) options.outputs = split_at_commas(arguments.outputs);
  const std::string& other = arguments.other_database.empty() ? arguments.database : arguments.other_database;
  if (arguments.studies.size() == 1 && arguments.other_database.empty())
    throw std::invalid_argument("study = " + arguments.studies.front() +
                                ": needs a second study, or a second database with --with");
  ResultStore first(arguments.database, Access::read), second(other, Access::read);
  const StudyComparison comparison =
      compare_studies(first, arguments.studies.front(), second, arguments.studies.back(), options);
  if (arguments.format == "json") {
    session.out << text_of(report_of(comparison, arguments), 2) << '\n';
  } else if (arguments.format == "csv") {
    print_summary(session.err, comparison);
    write_csv(session.out, table_of(comparison, arguments.limit));
  } else {
    print_table(arguments, comparison, session);
  }
  const bool good = arguments.within ? comparison.within(*arguments.within) : comparison.matched > 0;
  if (good) return;
  session.status = ExitStatus::no_answer;
  if (comparison.matched == 0)
    session.err << "nothing matches: --ignore names inputs that may differ\n";
  else if (comparison.differences.empty())
    session.err << "no point has an answer in both studies\n";
  else
    session.err << "not within " << short_number(*arguments.within) << '\n';
}

/// The first study with each of the others.
void compare(CompareArguments arguments, Session& session) {
  const std::vector<std::string> studies = arguments.studies;
  if (studies.size() <= 2) return compare_two(arguments, session);
  if (arguments.format != "table")
    throw std::invalid_argument("--format = " + arguments.format + ": is for two studies; compare them two by two");
  {
    const std::string& other = arguments.other_database.empty() ? arguments.database : arguments.other_database;
    ResultStore store(other, Access::read);
    for (std::size_t i = 1; i < studies.size(); ++i)
      if (store.definition(studies[i]) || !find_fit(store.database(), studies[i]))
        stored_study_name(store, studies[i]);  // or refuses, before any is printed
  }
  for (std::size_t i = 1; i < studies.size(); ++i) {
    arguments.studies = {studies.front(), studies[i]};
    session.out << (i == 1 ? "" : "\n") << studies.front() << " and " << studies[i] << '\n';
    compare_two(arguments, session);
  }
}

}  // namespace

void add_compare(Command& program, Session& session) {
  const auto [command, arguments] = program.add<CompareArguments>(
      "compare", "Compare two stored studies point by point, or two fits", session, compare);
  command
      ->add_option(
          "studies NAME", arguments.studies,
          "names of two studies, of one study that both databases hold, or of two fits; of more than two the first is "
          "compared with each of the others")
      ->required();
  command->add_option("--db FILE", arguments.database, "database")->or_usual_database();
  command->add_option("--with FILE", arguments.other_database, "database of the second study; left out: the same");
  command->add_option("--outputs KEY,...", arguments.outputs,
                      "numbers to compare, separated by commas; left out: rolling_resistance");
  command->add_option(
      "--ignore KEY,...", arguments.ignored,
      "inputs that may differ in matching points, separated by commas; those that are one value in each "
      "study, but not the same, are found by themselves");
  command
      ->add_option("--within X", arguments.within,
                   "exit status 1 if a relative difference is larger, or a point has an answer in one study only")
      ->not_negative();
  command->add_option("--limit N", arguments.limit, "print this many, the largest first")->not_negative();
  command->add_option("--format FORMAT", arguments.format, "table, csv or json")->one_of({"table", "csv", "json"});
  command->footer(
      "Exit status 1: nothing matches, or not within (of fits: a relative difference of a parameter).\n"
      "Example: rollres compare spectral newton --db results.db --outputs rolling_resistance,approach --within 1e-3\n"
      "         rollres compare rubber_2012 rubber_2013 --db fits.db");
}

}  // namespace rollres
