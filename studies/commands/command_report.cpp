#include <memory>
#include <ostream>

#include "studies/program/command_line.hpp"
#include "studies/program/commands.hpp"
#include "studies/report/report.hpp"
#include "studies/text/write_file.hpp"

namespace rollres {

namespace {

struct ReportWords {
  std::string database, out;
  int rows = 200;
  ReportWishes wishes;
};

void report(const ReportWords& words, Session& session) {
  if (words.out.empty()) throw std::invalid_argument("--out = \"\": must name a file");
  ResultStore store(words.database, Access::read);
  ReportWishes wishes = words.wishes;
  wishes.most_rows = static_cast<std::size_t>(words.rows);
  const StudyReport made = study_report(store, wishes);
  const std::filesystem::path file = words.out;
  if (const auto folder = file.parent_path(); !folder.empty()) make_directory(folder);
  write_file(file, made.html);
  session.out << file.string() << ": " << made.study << ", " << made.pictures
              << (made.pictures == 1 ? " picture\n" : " pictures\n");
}

}  // namespace

void add_report(Command& program, Session& session) {
  Command* const command =
      program.add_subcommand("report", "Write a stored study as one HTML file with its charts, to read, send or print");
  const auto words = std::make_shared<ReportWords>();
  command->add_option("--db", words->database, "database")->required()->option_text("FILE");
  command->add_option("--study", words->wishes.study, "study, or fit; may be left out if the database holds one study")
      ->option_text("NAME");
  command->add_option("--out", words->out, "HTML file; folders are made")->required()->option_text("FILE");
  command->add_option("--rows", words->rows, "most rows of the table of results; of a longer study every n-th point")
      ->between(1, 100'000)
      ->option_text("N");
  command
      ->add_option("--optimum", words->wishes.optimum,
                   "optimisation in the same database, to be drawn into a map of the study")
      ->option_text("NAME");
  command->footer(
      "The file needs no network and runs no scripts; pictures are inside.\n"
      "Example: rollres report --db results.db --study speed_resistance --out report.html");
  command->callback([words, &session] { report(*words, session); });
}

}  // namespace rollres
