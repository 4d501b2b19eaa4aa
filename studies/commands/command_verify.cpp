#include <chrono>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>

#include "studies/evidence/verification.hpp"
#include "studies/program/commands.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

namespace {

/// "4.9e-05", "0".
std::string in_powers(double value) {
  if (value == 0) return "0";
  std::ostringstream text;
  text << std::scientific << std::setprecision(1) << value;
  return std::isnan(value) ? "-" : text.str();
}

Table table_of(const std::vector<VerificationRow>& rows) {
  Table table{{"check", "source", "expected", "got", "difference", "tolerance", "result"}, {}};
  for (const VerificationRow& row : rows)
    table.rows.push_back({row.quantity, row.source, readable(row.expected, row.unit), readable(row.got, row.unit),
                          in_powers(row.difference()), in_powers(row.tolerance),
                          std::string(row.passed() ? "pass" : "FAIL")});
  return table;
}

/// The same for people: under the name of each source its checks, at most 120 columns wide.
void write_by_source(std::ostream& out, const std::vector<VerificationRow>& rows) {
  Table table = table_of(rows);
  table.columns = {"check", "expected", "got", "off by", "allowed", "result"};
  for (std::vector<Cell>& row : table.rows) row.erase(row.begin() + 1);
  std::ostringstream aligned;
  write_aligned(aligned, table);
  std::istringstream lines(aligned.str());
  std::string line;
  std::getline(lines, line);
  out << line << '\n';
  for (std::size_t i = 0; i < rows.size() && std::getline(lines, line); ++i) {
    if (i == 0 || rows[i].source != rows[i - 1].source) out << (i == 0 ? "" : "\n") << rows[i].source << '\n';
    out << "  " << line << '\n';
  }
}

/// One row for each source: how many checks, and the one that comes closest to what it is allowed.
Table summary_of(const std::vector<VerificationRow>& rows) {
  Table table{{"source", "checks", "pass", "closest to its tolerance", "difference", "tolerance"}, {}};
  std::vector<std::string> sources;
  for (const VerificationRow& row : rows)
    if (!contains(sources, row.source)) sources.push_back(row.source);
  for (const std::string& source : sources) {
    std::int64_t checks = 0, passed = 0;
    const VerificationRow* closest = nullptr;
    const auto share = [](const VerificationRow& row) {
      return row.difference() == 0 ? 0 : row.passed() ? row.difference() / row.tolerance : HUGE_VAL;
    };
    for (const VerificationRow& row : rows) {
      if (row.source != source) continue;
      ++checks;
      passed += row.passed();
      if (!closest || share(row) > share(*closest)) closest = &row;
    }
    table.rows.push_back(
        {source, checks, passed, closest->quantity, in_powers(closest->difference()), in_powers(closest->tolerance)});
  }
  return table;
}

Json array_of(const std::vector<VerificationRow>& rows) {
  Json array = Json::array();
  for (const VerificationRow& row : rows)
    array.push_back(json_object("check", row.quantity, "source", row.source, "unit", row.unit, "expected", row.expected,
                                "got", json_of(Cell(row.got)), "difference", json_of(Cell(row.difference())),
                                "tolerance", row.tolerance, "allowance", row.allowance, "passed", row.passed(),
                                "reason", row.reason));
  return array;
}

struct VerifyArguments {
  bool json = false, summary = false;
  std::string format = "table";
};

void run_verify(const VerifyArguments& arguments, Session& session) {
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<VerificationRow> rows = verify(session.evaluate);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto failed = count_if(rows, [](const auto& row) { return !row.passed(); });
  const auto passed = static_cast<std::ptrdiff_t>(rows.size()) - failed;
  if (failed > 0) session.status = ExitStatus::no_answer;
  if (arguments.json) {
    const Json object = json_object("version", this_program().version, "passed", passed, "failed", failed, "seconds",
                                    seconds, "rows", array_of(rows));
    session.out << text_of(object, 2) << '\n';
    return;
  }
  if (arguments.summary || arguments.format != "table")
    write_table(session.out, arguments.summary ? summary_of(rows) : table_of(rows), arguments.format);
  else
    write_by_source(session.out, rows);
  for (const VerificationRow& row : rows)
    if (!row.reason.empty()) session.out << row.quantity << ": " << row.reason << '\n';
  session.out << '\n'
              << passed << " of " << rows.size() << " pass"
              << (failed > 0 ? ", " + std::to_string(failed) + " FAIL" : "") << " (" << readable(seconds, "s") << ")\n";
}

}  // namespace

void add_verify(Command& program, Session& session) {
  const auto [command, arguments] = program.add<VerifyArguments>(
      "verify", "Solve what is known, and compare: the paper, closed forms, tables, energy", session, run_verify);
  command->add_flag("--summary", arguments.summary, "one line for each source");
  command->add_option("--format FORMAT", arguments.format, "table or markdown")->one_of({"table", "markdown"});
  command->add_flag("--json", arguments.json, "print one JSON object, with what each tolerance allows for");
  command->footer(
      "Differences are relative; where zero is expected, absolute. Exit status 1: a row fails.\n"
      "Example: rollres verify");
}

}  // namespace rollres
