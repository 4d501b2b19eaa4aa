#include <ostream>

#include "db/merge/merge.hpp"
#include "db/rows/schema.hpp"
#include "studies/program/commands.hpp"
#include "studies/program/merge_output.hpp"
#include "studies/run/export_study.hpp"

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

struct ExportArguments {
  std::string study, database, folder;
  bool json = false;
};

void export_one(const ExportArguments& arguments, Session& session) {
  const std::string note = export_study(arguments.database, arguments.study, arguments.folder);
  if (!note.empty()) session.err << arguments.study << ": " << note << '\n';
  session.out << arguments.folder << ": study.json, results.csv, results.db, provenance.json, README.txt\n";
}

void import_one(const ExportArguments& arguments, Session& session) {
  const Database into = open_database(arguments.database, Access::write);
  MergeOutput output(session, arguments.database, arguments.json);
  output.add(arguments.folder, [&] { return import_study(arguments.folder, into); });
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

void add_export(Command& program, Session& session) {
  const auto [command, arguments] = program.add<ExportArguments>(
      "export", "Write a study with its results and provenance into a folder", session, export_one);
  command->add_option("--study NAME", arguments.study, "name of the study; may be left out if the database holds one");
  command->add_option("--db FILE", arguments.database, "database")->required();
  command->add_option("--out DIR", arguments.folder, "folder; made if it is missing")->required();
  command->footer(
      "README.txt in the folder tells what is what.\n"
      "Example: rollres export --study speed_resistance --db results.db --out speed_resistance");
}

void add_import(Command& program, Session& session) {
  const auto [command, arguments] =
      program.add<ExportArguments>("import", "Bring an exported study into a database", session, import_one);
  command->add_option("folder DIR", arguments.folder, "folder that rollres export wrote")->required();
  command->add_option("--db FILE", arguments.database, "database; created if it is missing")->required();
  command->add_flag("--json", arguments.json, "print one JSON object");
  command->footer(
      "As rollres merge: importing again changes nothing.\n"
      "Example: rollres import speed_resistance --db mine.db");
}

}  // namespace rollres
