#include <algorithm>
#include <ostream>
#include <stdexcept>

#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/program/commands.hpp"
#include "studies/run/export_study.hpp"
#include "studies/stored_fits/stored_fit.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"

namespace rollres {

namespace {

/// What `rollres merge` and `rollres import` tell.
class MergeOutput {
 public:
  MergeOutput(Session& session, std::string database, bool json)
      : session_(session), database_(std::move(database)), json_(json) {}

  /// Does one merge and takes note of what came of it; a source that fails is a message and exit status 3.
  void add(const std::string& source, const std::function<MergeReport()>& work) {
    Merged& merged = merged_.emplace_back(Merged{source, {}, {}});
    try {
      merged.report = work();
      if (!merged.report.conflicts.empty()) session_.status = std::max(session_.status, ExitStatus::no_answer);
    } catch (const std::runtime_error& error) {
      merged.failure = error.what();
      session_.err << "rollres: " << merged.failure << '\n';
      session_.status = ExitStatus::failure;
    }
  }

  /// One line for each conflict, and one for all; or JSON.
  void print() const { json_ ? print_json() : print_lines(); }

 private:
  struct Merged {
    std::string source;
    MergeReport report;
    std::string failure;
  };

  void print_json() const {
    Json object{{"db", database_}, {"sources", Json::array()}};
    for (const Merged& merged : merged_) {
      Json& entry = object["sources"].emplace_back(Json{{"source", merged.source}});
      if (!merged.failure.empty()) {
        entry["failure"] = merged.failure;
        continue;
      }
      entry["evaluations"] = merged.report.evaluations;
      entry["added"] = merged.report.added;
      entry["replaced"] = merged.report.replaced;
      entry["studies"] = merged.report.studies;
      entry["renamed"] = Json::object();
      for (const auto& [name, other] : merged.report.renamed) entry["renamed"][name] = other;
      entry["conflicts"] = Json::array();
      for (const MergeConflict& conflict : merged.report.conflicts)
        entry["conflicts"].push_back(
            {{"key", conflict.key}, {"column", conflict.column}, {"kept", conflict.kept}, {"other", conflict.other}});
    }
    session_.out << text_of(object, 2) << '\n';
  }

  void print_lines() const {
    MergeReport sum;
    std::size_t failed = 0;
    constexpr std::size_t shown = 10;
    for (const auto& [source, report, failure] : merged_) {
      failed += !failure.empty();
      sum.evaluations += report.evaluations;
      sum.added += report.added;
      sum.replaced += report.replaced;
      sum.studies += report.studies;
      for (const auto& [name, other] : report.renamed)
        session_.err << source << ": study " << name << " is defined otherwise in " << database_ << ": it is " << other
                     << " there\n";
      for (const MergeConflict& conflict : report.conflicts) {
        sum.conflicts.push_back(conflict);
        if (sum.conflicts.size() <= shown)
          session_.err << source << ": evaluation " << conflict.key << ": " << conflict.column << " = "
                       << shortest(conflict.other) << ", but " << shortest(conflict.kept) << " is kept\n";
      }
    }
    if (sum.conflicts.size() > shown) session_.err << "and " << sum.conflicts.size() - shown << " other conflicts\n";
    session_.out << database_ << ": " << sum.evaluations << " evaluations in " << merged_.size() - failed << " of "
                 << merged_.size() << " databases: " << sum.added << " new, " << sum.replaced << " replaced, "
                 << sum.evaluations - sum.added - sum.replaced - sum.conflicts.size() << " there already, "
                 << sum.conflicts.size() << " in conflict\n";
  }

  Session& session_;
  std::string database_;
  bool json_;
  std::vector<Merged> merged_;
};

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
  ResultStore store(arguments.database, Access::read);
  if (const auto fit = meant_fit(store, arguments.study, FitParts::with_data)) {
    session.out << arguments.folder << ": " << joined(export_fit(*fit, arguments.folder)) << '\n';
    return;
  }
  const std::string note = export_study(arguments.database, arguments.study, arguments.folder);
  if (!note.empty()) session.err << arguments.study << ": " << note << '\n';
  session.out << arguments.folder << ": study.json, results.csv, results.db, provenance.json, README.txt\n";
}

void import_one(const ExportArguments& arguments, Session& session) {
  if (arguments.folder.empty()) throw std::invalid_argument("folder = \"\": must name a folder");
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
      ->or_usual_database();
  command->add_flag("--json", arguments.json, "print one JSON object");
  command->footer(
      "Merging again changes nothing. A result that is there stays, unless it had not converged and the new one has.\n"
      "Exit status 1: two converged results for the same scene differ by more than 1e-9; the first is kept.\n"
      "Exit status 3: a source is missing or damaged; nothing of it was taken, all of the others.\n"
      "Example: rollres merge shard-*.db --db results.db");
}

void add_export(Command& program, Session& session) {
  const auto [command, arguments] = program.add<ExportArguments>(
      "export", "Write a study with its results and provenance, or a fit, into a folder", session, export_one);
  command->add_option("--study NAME", arguments.study,
                      "name of the study, or fit; may be left out if the database holds one");
  command->add_option("--db FILE", arguments.database, "database")->or_usual_database();
  command->add_option("--out DIR", arguments.folder, "folder; made if it is missing")->required();
  command->footer(
      "README.txt in the folder tells what is what.\n"
      "Example: rollres export --study speed_resistance --db results.db --out speed_resistance");
}

void add_import(Command& program, Session& session) {
  const auto [command, arguments] =
      program.add<ExportArguments>("import", "Bring an exported study into a database", session, import_one);
  command->add_option("folder DIR", arguments.folder, "folder that rollres export wrote")->required();
  command->add_option("--db FILE", arguments.database, "database; created if it is missing")->or_usual_database();
  command->add_flag("--json", arguments.json, "print one JSON object");
  command->footer(
      "As rollres merge: importing again changes nothing.\n"
      "Example: rollres import speed_resistance --db mine.db");
}

}  // namespace rollres
