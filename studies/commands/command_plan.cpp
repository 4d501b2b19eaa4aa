#include <ostream>
#include <stdexcept>

#include "studies/program/commands.hpp"
#include "studies/scene_io/model_text.hpp"
#include "studies/stored/shown_table.hpp"
#include "studies/study/plan_table.hpp"
#include "studies/study/study_axes.hpp"
#include "studies/study/study_keys.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

namespace {

struct PlanArguments {
  std::string study, database, format = "table";
  bool json = false, si = false, explain = false;
  std::size_t point = 1;
  std::size_t limit = std::numeric_limits<std::size_t>::max();
};

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
}

/// "3 of load x 60 of speed x 5 of layer_thickness, static_shear_modulus"
std::string combinations(const Study& study) {
  std::string text;
  for (const auto& group : groups_of(study.axes)) {
    text += (text.empty() ? "" : " x ") + std::to_string(study.axes[group.front()].size()) + " of ";
    for (const std::size_t axis : group) text += (axis == group.front() ? "" : ", ") + study.axes[axis].key;
  }
  return text;
}

void print_summary(std::ostream& out, const Study& study, const StudyPlan& plan) {
  out << study.name << ": " << counted(plan.size(), "point") << ", " << combinations(study) << '\n';
  for (std::size_t i = 0; i < plan.dropped().size(); ++i)
    out << "dropped by " << study.constraints[i].text() << ": " << counted(plan.dropped()[i], "point") << '\n';
}

Json axes_json(const Study& study) {
  Json axes = Json::array();
  for (const Axis& axis : study.axes) {
    axes.push_back({{"key", axis.key}, {"values", axis.size()}});
    if (!axis.group.empty()) axes.back()["group"] = axis.group;
  }
  return axes;
}

Json charts_json(const Study& study) {
  Json charts = Json::array();
  for (const StudyChart& chart : study.charts) {
    Json object = Json::object();
    for (const auto& [key, value] :
         {std::pair{"name", chart.name}, {"x", chart.x}, {"y", chart.y}, {"family", chart.family}})
      if (!value.empty()) object[key] = value;
    charts.push_back(object);
  }
  return charts;
}

void print_json(std::ostream& out, const PlanArguments& arguments, const Study& study, const StudyPlan& plan,
                const std::vector<Cell>& status, const Table& table) {
  Json object{
      {"study", study.name}, {"points", plan.size()}, {"dropped", plan.all_dropped()}, {"axes", axes_json(study)}};
  object["constraints"] = Json::array();
  for (std::size_t i = 0; i < plan.dropped().size(); ++i)
    object["constraints"].push_back({{"constraint", study.constraints[i].text()}, {"dropped", plan.dropped()[i]}});
  object["compute"] = study.compute;
  object["fields"] = study.fields;
  object["charts"] = charts_json(study);
  if (!arguments.database.empty()) {
    const StoredPoints stored = count_stored(status);
    object["db"] = arguments.database;
    object["stored"] = stored.answered;
    object["failed"] = stored.failed;
  }
  object["plan"] = json_of(table);
  out << text_of(object, 2) << '\n';
}

/// The points as people read them.
Table shown_plan(Table table, const StudyPlan& plan, ShownUnits units) {
  ShownColumns columns;
  for (const std::string& key : table.columns)
    columns.quantities.push_back(find_input(key) ? find_quantity_column(input_column(key)) : nullptr);
  for (std::size_t point = 0; point < table.rows.size(); ++point)
    columns.bodies.emplace_back(body_of(plan.scene(point)));
  return shown_table(std::move(table), columns, units);
}

/// The model of one point.
void explain(const PlanArguments& arguments, const StudyPlan& plan, Session& session) {
  if (arguments.point < 1 || arguments.point > plan.size())
    throw std::invalid_argument("--point = " + std::to_string(arguments.point) + ": " + arguments.study + " has " +
                                counted(plan.size(), "point") + ", counted from 1");
  const RollingScene scene = plan.scene(arguments.point - 1);
  session.out << (arguments.json ? model_json(scene) + '\n' : model_text(scene));
}

void plan(const PlanArguments& arguments, Session& session) {
  const Study study = read_study(arguments.study);
  const StudyPlan plan(study);
  if (arguments.explain) return explain(arguments, plan, session);
  std::vector<Cell> status;
  if (!arguments.database.empty()) {
    ResultStore store(arguments.database, Access::read);
    status = stored_status(store, plan);
  }
  Table table = plan_table(study, plan, status, arguments.limit);
  if (arguments.json) return print_json(session.out, arguments, study, plan, status, table);
  if (arguments.format != "table" && arguments.format != "markdown")
    return write_table(session.out, table, arguments.format);
  const std::size_t rows = table.rows.size();
  table = shown_plan(std::move(table), plan, arguments.si ? ShownUnits::si : ShownUnits::scaled);
  if (arguments.format == "markdown") return write_table(session.out, table, arguments.format);
  print_summary(session.out, study, plan);
  if (!arguments.database.empty()) {
    const StoredPoints stored = count_stored(status);
    session.out << stored.answered << " of them in " << arguments.database << ", " << stored.failed << " failed\n";
  }
  if (rows == 0) return;
  session.out << '\n';
  write_table(session.out, table, arguments.format);
  if (rows < plan.size()) session.out << "and " << counted(plan.size() - rows, "more point") << '\n';
}

}  // namespace

void add_plan(Command& program, Session& session) {
  const auto [command, arguments] =
      program.add<PlanArguments>("plan", "Print the points of a study without solving any", session, plan);
  command->add_option("study STUDY", arguments.study, "study file")->required();
  command->add_option("--db FILE", arguments.database,
                      "database: tells which points are stored there, and their status");
  command->add_option("--limit N", arguments.limit, "print no more than this many points")->between(0, most_points);
  CommandOption* const format =
      command
          ->add_option("--format FORMAT", arguments.format,
                       "table, csv, json, jsonl (one object a line) or markdown: the points alone")
          ->one_of(table_formats);
  command->add_flag("--json", arguments.json, "print one JSON object: what the file asks for, and its points")
      ->excludes(format);
  command->add_flag("--explain", arguments.explain,
                    "print the model of one point, and the method that solves it, in place of the points");
  command->add_option("--point N", arguments.point, "the point that --explain tells of, counted from 1; default: 1");
  command->add_flag("--si", arguments.si, "SI numbers in the table, too");
  command->footer(
      "Numbers of csv, json and jsonl are SI.\n"
      "Example: rollres plan studies/examples/speed_resistance.json --limit 10");
}

}  // namespace rollres
