#include <cmath>
#include <memory>
#include <ostream>

#include "studies/evidence/comparison.hpp"
#include "studies/program/command_line.hpp"
#include "studies/program/commands.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/split.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

namespace {

struct CompareWords {
  std::vector<std::string> studies;
  std::string database, other_database, outputs, ignored, format = "table";
  std::optional<double> within;
  std::optional<std::size_t> limit;
};

constexpr std::size_t lines_on_screen = 20;

std::string cell_in_words(const Cell& cell) {
  if (const auto* const number = std::get_if<double>(&cell)) return readable(*number, "");
  if (const auto* const text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* const count = std::get_if<std::int64_t>(&cell)) return std::to_string(*count);
  return "not given";
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
    out << input.key << ": " << cell_in_words(input.first) << " against " << cell_in_words(input.second) << '\n';
  out << comparison.matched << " points match, " << comparison.only_first << " are only in the first study, "
      << comparison.only_second << " only in the second\n";
  if (comparison.half_answered > 0) out << comparison.half_answered << " have an answer in one study only\n";
  if (comparison.unanswered > 0) out << comparison.unanswered << " have an answer in neither\n";
  for (const OutputDifference& output : comparison.outputs)
    if (output.points > 0)
      out << output.output << ": relative difference at most " << short_number(output.largest, 3) << ", rms "
          << short_number(output.rms, 3) << ", at " << output.points << " points\n";
}

Json report_of(const StudyComparison& comparison, const CompareWords& words) {
  Json object{{"first", words.studies.front()},
              {"second", words.studies.back()},
              {"compared", Json::array()},
              {"matched", comparison.matched},
              {"only_first", comparison.only_first},
              {"only_second", comparison.only_second},
              {"half_answered", comparison.half_answered},
              {"unanswered", comparison.unanswered},
              {"outputs", Json::array()}};
  for (const ComparedInput& input : comparison.compared)
    object["compared"].push_back(
        {{"key", input.key}, {"first", json_of(input.first)}, {"second", json_of(input.second)}});
  for (const OutputDifference& output : comparison.outputs)
    object["outputs"].push_back({{"output", output.output},
                                 {"points", output.points},
                                 {"largest", json_of(Cell(output.largest))},
                                 {"rms", json_of(Cell(output.rms))}});
  if (words.within) object["within"] = comparison.within(*words.within);
  object["differences"] = json_of(table_of(comparison, words.limit));
  return object;
}

void print_table(const CompareWords& words, const StudyComparison& comparison, Session& session) {
  print_summary(session.out, comparison);
  const Table table = table_of(comparison, words.limit.value_or(lines_on_screen));
  if (table.rows.empty()) return;
  session.out << '\n';
  write_aligned(session.out, table);
  if (const std::size_t left = comparison.differences.size() - table.rows.size(); left > 0)
    session.err << left << " smaller differences are not shown; --limit sets how many are\n";
}

void compare(const CompareWords& words, Session& session) {
  ComparisonWishes wishes{.ignored = split_at_commas(words.ignored)};
  if (!words.outputs.empty()) wishes.outputs = split_at_commas(words.outputs);
  const std::string& other = words.other_database.empty() ? words.database : words.other_database;
  if (words.studies.size() == 1 && words.other_database.empty())
    throw std::invalid_argument("study = " + words.studies.front() +
                                ": needs a second study, or a second database with --with");
  ResultStore first(words.database, Access::read), second(other, Access::read);
  const StudyComparison comparison =
      compare_studies(first, words.studies.front(), second, words.studies.back(), wishes);
  if (words.format == "json") {
    session.out << text_of(report_of(comparison, words), 2) << '\n';
  } else if (words.format == "csv") {
    print_summary(session.err, comparison);
    write_csv(session.out, table_of(comparison, words.limit));
  } else {
    print_table(words, comparison, session);
  }
  const bool good = words.within ? comparison.within(*words.within) : comparison.matched > 0;
  if (good) return;
  session.status = ExitStatus::no_answer;
  if (comparison.matched == 0)
    session.err << "nothing matches: --ignore names inputs that may differ\n";
  else if (comparison.differences.empty())
    session.err << "no point has an answer in both studies\n";
  else
    session.err << "not within " << short_number(*words.within) << '\n';
}

}  // namespace

void add_compare(Command& program, Session& session) {
  Command* command = program.add_subcommand("compare", "Compare two stored studies point by point");
  const auto words = std::make_shared<CompareWords>();
  command->add_option("studies", words->studies, "names of two studies, or of one that both databases hold")
      ->option_text("NAME")
      ->required()
      ->expected(1, 2);
  command->add_option("--db", words->database, "database")->option_text("FILE")->required();
  command->add_option("--with", words->other_database, "database of the second study; left out: the same")
      ->option_text("FILE");
  command
      ->add_option("--outputs", words->outputs, "numbers to compare, separated by commas; left out: rolling_resistance")
      ->option_text("KEY,...");
  command
      ->add_option("--ignore", words->ignored,
                   "inputs that may differ in matching points, separated by commas; those that are one value in each "
                   "study, but not the same, are found by themselves")
      ->option_text("KEY,...");
  command
      ->add_option("--within", words->within,
                   "exit status 1 if a relative difference is larger, or a point has an answer in one study only")
      ->option_text("X")
      ->not_negative();
  command->add_option("--limit", words->limit, "print this many, the largest first")->option_text("N")->not_negative();
  command->add_option("--format", words->format, "table, csv or json")
      ->option_text("FORMAT")
      ->one_of({"table", "csv", "json"});
  command->footer(
      "Exit status 1: nothing matches, or not within.\n"
      "Example: rollres compare spectral newton --db results.db --outputs rolling_resistance,approach --within 1e-3");
  command->callback([words, &session] { compare(*words, session); });
}

}  // namespace rollres
