#include <ostream>

#include "db/rows/schema.hpp"
#include "studies/program/command_line.hpp"
#include "studies/program/commands.hpp"
#include "studies/program/merge_output.hpp"
#include "studies/run/export_study.hpp"

namespace rollres {

namespace {

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
