#include <ostream>

#include "studies/program/commands.hpp"
#include "studies/report/report.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/text/files.hpp"

namespace rollres {

namespace {

struct ReportArguments {
  std::string database, out;
  std::vector<std::string> studies, filters;
  int rows = 200;
  ReportOptions options;
};

void report(const ReportArguments& arguments, Session& session) {
  if (arguments.out.empty()) throw std::invalid_argument("--out = \"\": must name a file");
  refuse_other_kind(arguments.out, {".html", ".htm"});
  ResultStore store(arguments.database, Access::read);
  ReportOptions options = arguments.options;
  if (!arguments.studies.empty()) {
    options.study = arguments.studies.front();
    options.more_studies.assign(arguments.studies.begin() + 1, arguments.studies.end());
  }
  for (const std::string& text : arguments.filters) options.filters.push_back(read_filter(text));
  options.most_rows = static_cast<std::size_t>(arguments.rows);
  const StudyReport made = study_report(store, options);
  const std::filesystem::path file = arguments.out;
  if (const auto folder = file.parent_path(); !folder.empty()) make_directory(folder);
  write_file(file, made.html);
  session.out << file.string() << ": " << made.study << ", " << made.pictures
              << (made.pictures == 1 ? " picture\n" : " pictures\n");
}

}  // namespace

void add_report(Command& program, Session& session) {
  const auto [command, arguments] = program.add<ReportArguments>(
      "report", "Write a stored study as one HTML file with its charts, to read, send or print", session, report);
  command->add_option("--db FILE", arguments.database, "database")->or_usual_database();
  command
      ->add_option("--study NAME", arguments.studies,
                   "study, or fit; may be left out if the database holds one study; may be repeated: a chart of all, "
                   "then one after the other")
      ->one_value_each();
  command->add_option("--out FILE", arguments.out, "HTML file; folders are made")->required();
  command
      ->add_option("--rows N", arguments.rows, "most rows of the table of results; of a longer study every n-th point")
      ->between(1, 100'000);
  command->add_option("--optimum NAME", arguments.options.optimum,
                      "optimisation in the same database, to be drawn into a map of the study");
  command->add_option("--x KEY", arguments.options.x,
                      "input or output along x of the charts of curves; left out: as in chart, and where that has too "
                      "many curves each axis in turn, the others at their middle values");
  command->add_option("--family KEY", arguments.options.family,
                      "axis with one curve for each value; left out: as in chart");
  command
      ->add_option("--where FILTER", arguments.filters,
                   "draw charts of points with KEY=VALUE only, as in query; may be repeated")
      ->one_value_each();
  command->footer(
      "The file needs no network; pictures are inside. Its small script zooms charts, shows one curve alone and\n"
      "sorts tables; all of it can be read without.\n"
      "Example: rollres report --db results.db --study speed_resistance --out report.html");
}

}  // namespace rollres
