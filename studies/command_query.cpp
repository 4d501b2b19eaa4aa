#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <ostream>

#include "db/query.hpp"
#include "studies/commands.hpp"
#include "studies/read_filter.hpp"
#include "studies/table_output.hpp"

namespace rollres {

namespace {

struct QueryWords {
  std::string database, columns, sort, format = "table";
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

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= text.size() && !text.empty();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

void query(const QueryWords& words, Session& session) {
  Query question{.columns = split_at_commas(words.columns), .sort = split_at_commas(words.sort), .limit = words.limit};
  for (const std::string& text : words.filters) question.filters.push_back(read_filter(text));
  if (question.columns.empty() && words.format == "table") {
    question.columns.assign(std::begin(usual_columns), std::end(usual_columns));
    auto add = [&](const std::string& name) {
      if (std::find(question.columns.begin(), question.columns.end(), name) == question.columns.end())
        question.columns.insert(question.columns.end() - 1, name);
    };
    for (const Filter& filter : question.filters)
      if (filter.comparison != Comparison::equal) add(filter.column);
    for (const std::string& name : question.sort) add(name.starts_with('-') ? name.substr(1) : name);
  }
  const Table table = run_query(Database(words.database, Access::read), question);
  if (words.format == "csv")
    write_csv(session.out, table);
  else if (words.format == "json")
    write_json(session.out, table);
  else if (!table.rows.empty())
    write_aligned(session.out, table);
  if (table.rows.empty()) {
    session.err << words.database << ": nothing matches\n";
    session.status = ExitStatus::no_answer;
  }
}

}  // namespace

void add_query(CLI::App& program, Session& session) {
  CLI::App* command = program.add_subcommand("query", "Find stored evaluations by any input or output");
  const auto words = std::make_shared<QueryWords>();
  command->add_option("filters", words->filters,
                      "KEY=VALUE, also != < <= > >= and ~ (contains); all must hold; KEY is any column, a study or a "
                      "position in it; VALUE is a number in SI, one with a unit, or a text; none: what is absent");
  command->add_option("--db", words->database, "database")->required();
  command->add_option("--columns", words->columns, "columns to print, separated by commas");
  command->add_option("--sort", words->sort, "columns to sort by, separated by commas; --sort=-KEY: largest first");
  command->add_option_function<std::int64_t>(
      "--limit", [words](const std::int64_t& limit) { words->limit = limit; }, "print no more than this many rows");
  command->add_option("--format", words->format, "table, csv or json")->check(CLI::IsMember({"table", "csv", "json"}));
  command->footer(
      "Exit status 1: nothing matches.\n"
      "Example: rollres query --db results.db 'speed>0.1' 'load=20 kN/m' status=converged "
      "--sort=-rolling_resistance --limit 5");
  command->callback([words, &session] { query(*words, session); });
}

}  // namespace rollres
