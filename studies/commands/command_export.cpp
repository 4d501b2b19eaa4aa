#include <memory>
#include <ostream>

#include "db/rows/schema.hpp"
#include "studies/program/command_line.hpp"
#include "studies/program/commands.hpp"
#include "studies/program/merge_output.hpp"
#include "studies/run/export_study.hpp"

namespace rollres {

namespace {

struct ExportWords {
  std::string study, database, folder;
  bool json = false;
};

void export_one(const ExportWords& words, Session& session) {
  const std::string note = export_study(words.database, words.study, words.folder);
  if (!note.empty()) session.err << words.study << ": " << note << '\n';
  session.out << words.folder << ": study.json, results.csv, results.db, provenance.json, README.txt\n";
}

void import_one(const ExportWords& words, Session& session) {
  const Database into = open_database(words.database, Access::write);
  MergeOutput output(session, words.database, words.json);
  output.add(words.folder, [&] { return import_study(words.folder, into); });
  output.print();
}

}  // namespace

void add_export(Command& program, Session& session) {
  Command* command = program.add_subcommand("export", "Write a study with its results and provenance into a folder");
  const auto words = std::make_shared<ExportWords>();
  command->add_option("--study", words->study, "name of the study; may be left out if the database holds one")
      ->option_text("NAME");
  command->add_option("--db", words->database, "database")->option_text("FILE")->required();
  command->add_option("--out", words->folder, "folder; made if it is missing")->option_text("DIR")->required();
  command->footer(
      "README.txt in the folder tells what is what.\n"
      "Example: rollres export --study speed_resistance --db results.db --out speed_resistance");
  command->callback([words, &session] { export_one(*words, session); });
}

void add_import(Command& program, Session& session) {
  Command* command = program.add_subcommand("import", "Bring an exported study into a database");
  const auto words = std::make_shared<ExportWords>();
  command->add_option("folder", words->folder, "folder that rollres export wrote")->option_text("DIR")->required();
  command->add_option("--db", words->database, "database; created if it is missing")->option_text("FILE")->required();
  command->add_flag("--json", words->json, "print one JSON object");
  command->footer(
      "As rollres merge: importing again changes nothing.\n"
      "Example: rollres import speed_resistance --db mine.db");
  command->callback([words, &session] { import_one(*words, session); });
}

}  // namespace rollres
