#include <ostream>

#include "db/rows/study_upkeep.hpp"
#include "studies/program/command_line.hpp"
#include "studies/program/commands.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/text/strict_json.hpp"

// What keeps a database in order: rename, delete, note, prune.

namespace rollres {

namespace {

struct UpkeepArguments {
  std::string database, study, text;
  bool yes = false;
};

/// The name of a study that there is; nothing is created.
std::string study_of(const UpkeepArguments& arguments) {
  ResultStore store(arguments.database, Access::read);
  return stored_study_name(store, arguments.study);
}

Database opened(const UpkeepArguments& arguments) { return open_database(arguments.database, Access::write); }

void rename(const UpkeepArguments& arguments, Session& session) {
  const std::string study = study_of(arguments);
  const std::string name = needed_name({{"name", arguments.text}}, "name", "NEW", "must be a text");
  rename_study(opened(arguments), study, name);
  session.out << arguments.database << ": " << study << " is " << name << " now\n";
}

void remove(const UpkeepArguments& arguments, Session& session) {
  const std::string study = study_of(arguments);
  const Database database = opened(arguments);
  delete_study(database, study);
  session.out << arguments.database << ": " << study << " is deleted; " << rows_of_no_study(database)
              << " rows belong to no study now (rollres prune deletes those)\n";
}

void note(const UpkeepArguments& arguments, Session& session) {
  const std::string study = study_of(arguments);
  set_note(opened(arguments), study, arguments.text);
  session.out << arguments.database << ": " << study << (arguments.text.empty() ? ": no note\n" : ": noted\n");
}

void prune(const UpkeepArguments& arguments, Session& session) {
  const Database database = open_database(arguments.database, arguments.yes ? Access::write : Access::read);
  const std::int64_t rows = rows_of_no_study(database);
  if (rows > 0 && arguments.yes) delete_rows_of_no_study(database);
  session.out << arguments.database << ": " << rows << (rows == 1 ? " row belongs" : " rows belong") << " to no study"
              << (rows == 0       ? ""
                  : arguments.yes ? ": deleted"
                                  : "; --yes deletes")
              << '\n';
}

}  // namespace

void add_upkeep(Command& program, Session& session) {
  {
    const auto [command, arguments] =
        program.add<UpkeepArguments>("rename", "Give a stored study another name", session, rename);
    command->add_option("study NAME", arguments.study, "study")->required();
    command->add_option("new NEW", arguments.text, "its new name")->required();
    command->add_option("--db FILE", arguments.database, "database")->or_usual_database();
    command->footer("Example: rollres rename belt 'belt, first compound' --db results.db");
  }
  {
    const auto [command, arguments] =
        program.add<UpkeepArguments>("delete", "Forget a stored study; its rows stay until prune", session, remove);
    command->add_option("study NAME", arguments.study, "study")->required();
    command->add_option("--db FILE", arguments.database, "database")->or_usual_database();
    command->footer("Example: rollres delete belt --db results.db");
  }
  {
    const auto [command, arguments] =
        program.add<UpkeepArguments>("note", "Write a note on a stored study; list and show print it", session, note);
    command->add_option("study NAME", arguments.study, "study")->required();
    command->add_option("text TEXT", arguments.text, "the note, in place of the one before; '' for none")->required();
    command->add_option("--db FILE", arguments.database, "database")->or_usual_database();
    command->footer("Example: rollres note belt 'cover of the second supplier' --db results.db");
  }
  const auto [command, arguments] =
      program.add<UpkeepArguments>("prune", "Delete the rows that belong to no study", session, prune);
  command->add_option("--db FILE", arguments.database, "database")->or_usual_database();
  command->add_flag("--yes", arguments.yes, "delete them; without it they are counted");
  command->footer(
      "These are rows of deleted studies, of studies that were replaced, and those that fits solved and would solve "
      "again.\n"
      "Example: rollres prune --db results.db --yes");
}

}  // namespace rollres
