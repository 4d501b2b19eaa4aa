#include <charconv>
#include <ostream>

#include "db/queries/query.hpp"
#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/program/commands.hpp"
#include "studies/run/progress.hpp"
#include "studies/scene_io/fields_file.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "studies/scene_io/summary.hpp"
#include "studies/stored/derived_columns.hpp"
#include "studies/stored/shown_table.hpp"
#include "studies/stored_fits/stored_fit.hpp"
#include "studies/study/study_definition.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

Json summary_json(const StudySummary& study) {
  return json_object("study", study.name, "axes", study.axes, "points", study.points, "answered", study.answered,
                     "failed", study.failed, "created", study.created, "started", study.started, "last_result",
                     study.last_result, "note", study.note);
}

struct ListArguments {
  std::string database;
  bool json = false;
};

void list(const ListArguments& arguments, Session& session) {
  ResultStore store(arguments.database, Access::read);
  const std::vector<StudySummary> studies = store.studies();
  const Table fits = fit_table(stored_fits(store.database()));
  if (arguments.json) {
    Json object{{"db", arguments.database}, {"studies", Json::array()}, {"fits", json_of(fits)}};
    for (const StudySummary& study : studies) object["studies"].push_back(summary_json(study));
    session.out << text_of(object, 2) << '\n';
    return;
  }
  if (studies.empty() && fits.rows.empty()) {
    session.err << arguments.database << ": holds no study\n";
    return;
  }
  if (studies.empty()) return write_aligned(session.out, fits);
  Table table{{"study", "points", "answered", "failed", "created (UTC)", "last result (UTC)", "axes"}, {}};
  const bool noted = any_of(studies, [](const auto& study) { return !study.note.empty(); });
  if (noted) table.columns.emplace_back("note");
  for (const StudySummary& study : studies) {
    table.rows.push_back({study.name, study.points, study.answered, study.failed, to_the_second(study.created),
                          to_the_second(study.last_result), joined(study.axes)});
    if (noted) table.rows.back().emplace_back(study.note);
  }
  write_aligned(session.out, table);
  if (fits.rows.empty()) return;
  session.out << '\n';
  write_aligned(session.out, fits);
}

struct ShowArguments {
  std::string what, database;
  std::optional<std::string> fields;
  bool json = false, si = false;
};

/// Outputs in the table of a study, beside its axes, where its file does not list them.
constexpr const char* main_outputs[] = {
    "rolling_resistance", "rolling_resistance_coefficient", "load", "approach", "rotation_ratio", "contact_area",
    "peak_pressure"};

/// What stands in a column, with its unit: "20 kN/m".
std::string with_unit_of(const std::string& heading, const Cell& cell) {
  const std::size_t bracket = heading.rfind(" [");
  const bool number = !std::holds_alternative<std::string>(cell);
  const std::string value =
      number ? short_number(std::holds_alternative<double>(cell) ? std::get<double>(cell)
                                                                 : static_cast<double>(std::get<std::int64_t>(cell)))
             : std::get<std::string>(cell);
  if (bracket == std::string::npos) return value;
  return value + ' ' + heading.substr(bracket + 2, heading.size() - bracket - 3);
}

/// Takes the columns that are the same in all rows out of a table, but those that are asked for, and tells them.
std::string take_constants(Table& table, std::size_t first, const std::vector<std::string>& asked) {
  std::string constants;
  for (std::size_t i = table.columns.size(); table.rows.size() > 1 && i-- > first;) {
    const std::string name = table.columns[i].substr(0, table.columns[i].rfind(" ["));
    const Cell& value = table.rows.front()[i];
    const bool same = all_of(table.rows, [&](const auto& row) { return row[i] == value; });
    if (!same || contains(asked, name)) continue;
    if (!std::holds_alternative<std::monostate>(value))
      constants = name + " = " + with_unit_of(table.columns[i], value) + (constants.empty() ? "" : ", ") + constants;
    table.columns.erase(table.columns.begin() + static_cast<std::ptrdiff_t>(i));
    for (auto& row : table.rows) row.erase(row.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return constants;
}

constexpr std::int64_t most_designs = 20;

/// How the designs of an optimisation are sorted for its best to come first; nothing for another study, or one whose
/// goals are not stored. @param names  of the columns
std::vector<std::string> best_first(ResultStore& store, const StudySummary& study,
                                    const std::vector<std::string>& names) {
  const auto has = [&](const char* name) { return contains(names, name); };
  if (!has("goal") || !has("feasible")) return {};
  const Json file = parse_object(store.definition(study.name).value_or("{}"), store.database().name());
  std::vector<std::string> sort{"-feasible", file.contains("maximise") ? "-goal" : "goal"};
  if (has("front") && file.contains("pareto")) sort.insert(sort.begin(), "-front");
  return sort;
}

void show_study(const ShowArguments& arguments, ResultStore& store, const StudySummary& study, Session& session) {
  const Database& database = store.database();
  const StudyDefinition definition =
      definition_in(store.definition(study.name).value_or(""), database.name() + ": " + study.name);
  Query query{.filters = {{"study", Comparison::equal, study.name}}, .columns = {"position", "id"}};
  std::vector<std::string> names = query.columns;
  const auto add = [&](const std::string& column, const std::string& name) {
    if (contains(names, name)) return;
    query.columns.push_back(column);
    names.push_back(name);
  };
  for (const std::string& axis : study.axes) add(input_column(axis), axis);
  if (!definition.goals.empty() && column_names(database.connection(), "result").contains("goal"))
    for (const char* const name : {"front", "goal", "second_goal", "feasible"}) add(name, name);
  std::vector<std::string> outputs = definition.compute;
  if (outputs.empty()) outputs.assign(std::begin(main_outputs), std::end(main_outputs));
  const std::vector<std::string> charted = charted_numbers(definition, study.axes);
  outputs.insert(outputs.begin(), charted.begin(), charted.end());
  for (const std::string& output : outputs) add(output, output);
  add("status", "status");
  const FormulaDefinitions formulas = add_derived(database, query);
  if (const std::vector<std::string> best = best_first(store, study, names); !best.empty()) {
    query.sort = best;
    if (!arguments.json) query.limit = most_designs;
  }
  if (arguments.json) {
    Table table = run_query(database, query);
    table.columns = names;
    Json object = summary_json(study);
    object["results"] = json_of(table);
    session.out << text_of(object, 2) << '\n';
    return;
  }
  Table table = shown_rows(database, query, formulas, arguments.si ? ShownUnits::si : ShownUnits::scaled, names);
  session.out << study.name << ": " << study.answered << " of " << study.points << " points answered, " << study.failed
              << " failed\n"
              << (study.note.empty() ? "" : study.note + "\n");
  if (query.limit && study.points > most_designs)
    session.out << "the best " << most_designs << " designs come first: --json has all\n";
  constexpr std::size_t position_and_id = 2;
  std::vector<std::string> asked = definition.compute;
  asked.insert(asked.end(), charted.begin(), charted.end());
  const std::string constants = take_constants(table, position_and_id, asked);
  if (!constants.empty()) session.out << "in all points: " << constants << '\n';
  std::vector<std::string> droppable;
  for (const std::string& name : names)
    if (name != "position" && name != "rolling_resistance" && name != "status") droppable.push_back(name);
  const std::size_t width = terminal_width(session.out);
  const auto dropped = fit_to_width(table, width > 0 ? width : 160, droppable);
  if (!dropped.empty())
    session.out << "no room for " << joined(dropped) << ": rollres query 'study=" << study.name << "' --columns ...\n";
  session.out << '\n';
  write_aligned(session.out, table);
}

void show_evaluation(const ShowArguments& arguments, const StoredEvaluation& evaluation, Session& session) {
  const Provenance& program = evaluation.provenance;
  if (arguments.json) {
    Json object{{"id", evaluation.id}, {"created", evaluation.created}, {"studies", evaluation.studies}};
    object["provenance"] = json_of(program);
    object.update(Json::parse(solution_json(evaluation.scene, evaluation.solution)));
    session.out << text_of(object, 2) << '\n';
    return;
  }
  session.out << "evaluation " << evaluation.id << ", stored " << evaluation.created << "\nby rollres "
              << program.version << " (" << program.git_hash << ", solver " << program.solver << ", "
              << program.compiler << ") on " << program.machine << '\n';
  for (const std::string& study : evaluation.studies) session.out << "a point of the study " << study << '\n';
  session.out << '\n' << summary(evaluation.scene, evaluation.solution);
}

void export_fields(const ShowArguments& arguments, ResultStore& store, const StoredEvaluation& evaluation,
                   Session& session) {
  if (const auto fields = store.find_fields(evaluation.key))
    return write_fields(*arguments.fields, evaluation.scene, *fields, evaluation.solution);
  session.err << arguments.database << ": evaluation " << evaluation.id
              << ": no fields are stored; rollres sweep STUDY --fields stores them\n";
  session.status = ExitStatus::no_answer;
}

void show(const ShowArguments& arguments, Session& session) {
  if (arguments.fields && arguments.fields->empty())
    throw std::invalid_argument("--fields = \"\": must name a directory");
  ResultStore store(arguments.database, Access::read);
  if (const auto study = store.study(arguments.what)) {
    if (arguments.fields)
      throw std::invalid_argument("--fields = " + *arguments.fields +
                                  ": needs the number of an evaluation, not a study");
    return show_study(arguments, store, *study, session);
  }
  if (const auto fit = find_fit(store.database(), arguments.what, FitParts::with_data)) {
    if (arguments.fields) throw std::invalid_argument("--fields = " + *arguments.fields + ": a fit has no fields");
    session.out << (arguments.json ? text_of(json_of(*fit), 2) + "\n" : fit_summary(*fit));
    return;
  }
  auto evaluation = store.find(arguments.what);
  std::int64_t id = 0;
  const char* end = arguments.what.data() + arguments.what.size();
  if (!evaluation && std::from_chars(arguments.what.data(), end, id).ptr == end) evaluation = store.find(id);
  if (evaluation) {
    show_evaluation(arguments, *evaluation, session);
    if (arguments.fields) export_fields(arguments, store, *evaluation, session);
    return;
  }
  std::vector<std::string> all = store.study_names();
  for (const FitSummary& fit : stored_fits(store.database())) all.push_back(fit.name);
  throw std::invalid_argument(
      unknown(arguments.database + ": " + arguments.what + ": no such study, fit or evaluation", all, arguments.what));
}

}  // namespace

void add_show(Command& program, Session& session) {
  const auto [command, arguments] = program.add<ShowArguments>(
      "show", "Show the results of a study, a fit, or one evaluation in full", session, show);
  command
      ->add_option("what NAME|ID", arguments.what,
                   "name of a study or of a fit, or number (id) or name of an evaluation")
      ->required();
  command->add_option("--db FILE", arguments.database, "database")->or_usual_database();
  command->add_flag("--json", arguments.json, "print one JSON object");
  command->add_flag("--si", arguments.si, "SI numbers in the table of a study");
  command->add_option("--fields DIR", arguments.fields,
                      "write an evaluation's stored fields to DIR/fields.csv and .vti");
  command->footer("Example: rollres show --db results.db 'speed and load'");
}

void add_list(Command& program, Session& session) {
  const auto [command, arguments] = program.add<ListArguments>(
      "list", "List the studies of a database and how far they are, and its fits", session, list);
  command->add_option("--db FILE", arguments.database, "database")->or_usual_database();
  command->add_flag("--json", arguments.json, "print one JSON object");
  command->footer("Example: rollres list --db results.db");
}

}  // namespace rollres
