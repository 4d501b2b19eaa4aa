#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <memory>
#include <ostream>
#include <sstream>

#include "db/provenance.hpp"
#include "studies/command_line.hpp"
#include "studies/commands.hpp"
#include "studies/readable_number.hpp"
#include "studies/table_json.hpp"
#include "studies/table_output.hpp"
#include "studies/verification.hpp"

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

Json array_of(const std::vector<VerificationRow>& rows) {
  Json array = Json::array();
  for (const VerificationRow& row : rows)
    array.push_back({{"check", row.quantity},
                     {"source", row.source},
                     {"unit", row.unit},
                     {"expected", row.expected},
                     {"got", json_of(Cell(row.got))},
                     {"difference", json_of(Cell(row.difference()))},
                     {"tolerance", row.tolerance},
                     {"allowance", row.allowance},
                     {"passed", row.passed()},
                     {"reason", row.reason}});
  return array;
}

void verify(bool json, Session& session) {
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<VerificationRow> rows = verify(session.evaluate);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto failed = std::count_if(rows.begin(), rows.end(), [](const auto& row) { return !row.passed(); });
  const auto passed = static_cast<std::ptrdiff_t>(rows.size()) - failed;
  if (failed > 0) session.status = ExitStatus::no_answer;
  if (json) {
    const Json object{{"version", this_program().version},
                      {"passed", passed},
                      {"failed", failed},
                      {"seconds", seconds},
                      {"rows", array_of(rows)}};
    session.out << text_of(object, 2) << '\n';
    return;
  }
  write_aligned(session.out, table_of(rows));
  for (const VerificationRow& row : rows)
    if (!row.reason.empty()) session.out << row.quantity << ": " << row.reason << '\n';
  session.out << '\n'
              << passed << " of " << rows.size() << " pass"
              << (failed > 0 ? ", " + std::to_string(failed) + " FAIL" : "") << " (" << readable(seconds, "s") << ")\n";
}

}  // namespace

void add_verify(Command& program, Session& session) {
  Command* const command =
      program.add_subcommand("verify", "Solve what is known, and compare: the paper, closed forms, tables, energy");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "print one JSON object, with what each tolerance allows for");
  command->footer(
      "Differences are relative; where zero is expected, absolute. Exit status 1: a row fails.\n"
      "Example: rollres verify");
  command->callback([json, &session] { verify(*json, session); });
}

}  // namespace rollres
