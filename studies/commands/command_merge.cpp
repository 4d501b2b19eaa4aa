#include <filesystem>
#include <ostream>

#include "db/merge/merge.hpp"
#include "db/rows/schema.hpp"
#include "studies/program/command_line.hpp"
#include "studies/program/commands.hpp"
#include "studies/program/merge_output.hpp"

namespace rollres {

namespace {

struct MergeArguments {
  std::vector<std::string> sources;
  std::string database;
  bool json = false;
};

void merge_all(const MergeArguments& arguments, Session& session) {
  const Database into = open_database(arguments.database, Access::write);
  MergeOutput output(session, arguments.database, arguments.json);
  for (const std::string& source : arguments.sources) output.add(source, [&] { return merge(into, source); });
  output.print();
}

}  // namespace

void add_merge(Command& program, Session& session) {
  const auto [command, arguments] = program.add<MergeArguments>(
      "merge", "Bring the results of several databases together in one", session, merge_all);
  command->add_option("sources FILE", arguments.sources, "databases; they are only read")->required();
  command->add_option("--db FILE", arguments.database, "database that takes them; created if it is missing")
      ->required();
  command->add_flag("--json", arguments.json, "print one JSON object");
  command->footer(
      "Merging again changes nothing. A result that is there stays, unless it had not converged and the new one has.\n"
      "Exit status 1: two converged results for the same scene differ by more than 1e-9; the first is kept.\n"
      "Exit status 3: a source is missing or damaged; nothing of it was taken, all of the others.\n"
      "Example: rollres merge shard-*.db --db results.db");
}

}  // namespace rollres
