#include <ostream>

#include "db/rows/result_store.hpp"
#include "studies/program/command_line.hpp"
#include "studies/program/commands.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

struct ListArguments {
  std::string database;
  bool json = false;
};

/// "2013-05-01T12:00:00.000Z" to the second, as it is read.
std::string to_the_second(const std::string& time) {
  return time.empty() ? "" : time.substr(0, 10) + " " + time.substr(11, 8);
}

void list(const ListArguments& arguments, Session& session) {
  const std::vector<StudySummary> studies = ResultStore(arguments.database, Access::read).studies();
  if (arguments.json) {
    Json object{{"db", arguments.database}, {"studies", Json::array()}};
    for (const StudySummary& study : studies)
      object["studies"].push_back({{"study", study.name},
                                   {"axes", study.axes},
                                   {"points", study.points},
                                   {"answered", study.answered},
                                   {"failed", study.failed},
                                   {"created", study.created},
                                   {"started", study.started},
                                   {"last_result", study.last_result}});
    session.out << text_of(object, 2) << '\n';
    return;
  }
  if (studies.empty()) {
    session.err << arguments.database << ": holds no study\n";
    return;
  }
  Table table{{"study", "points", "answered", "failed", "created (UTC)", "last result (UTC)", "axes"}, {}};
  for (const StudySummary& study : studies)
    table.rows.push_back({study.name, study.points, study.answered, study.failed, to_the_second(study.created),
                          to_the_second(study.last_result), joined(study.axes)});
  write_aligned(session.out, table);
}

}  // namespace

void add_list(Command& program, Session& session) {
  const auto [command, arguments] =
      program.add<ListArguments>("list", "List the studies of a database and how far they are", session, list);
  command->add_option("--db FILE", arguments.database, "database")->required();
  command->add_flag("--json", arguments.json, "print one JSON object");
  command->footer("Example: rollres list --db results.db");
}

}  // namespace rollres
