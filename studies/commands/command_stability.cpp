#include <algorithm>
#include <ostream>
#include <stdexcept>

#include "core/messages/message_text.hpp"
#include "studies/evidence/accuracy.hpp"
#include "studies/evidence/stability.hpp"
#include "studies/program/commands.hpp"
#include "studies/program/watched_run.hpp"
#include "studies/relations/relation_run.hpp"
#include "studies/scene_io/cells.hpp"
#include "studies/text/files.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t usual_cylinders = 1000, usual_spheres = 100;

struct StabilityArguments {
  std::string out;
  std::size_t scenes = 0;
  std::uint64_t seed = 1;
  std::vector<std::string> methods;
  std::string indenter = "both";
  int jobs = 0;
  double time_limit = 600;
  std::string materials = "both";
  std::size_t relations = 0;
  std::vector<std::string> only;
  bool json = false;
};

/// In the order of the list; all without a name.
std::vector<Method> methods_to_try(const std::vector<std::string>& names) {
  std::vector<Method> methods = methods_named(names);
  if (names.empty())
    for (std::size_t i = 0; i < ChoiceNames<Method>::names.size(); ++i)
      if (const auto method = static_cast<Method>(i); on_grid(method) || method == Method::spectral)
        methods.push_back(method);
  std::sort(methods.begin(), methods.end());
  return methods;
}

/// What both kinds of runs take alike. @param cylinders, spheres  where both are tried
RandomScenes random_scenes(const StabilityArguments& arguments, std::size_t cylinders, std::size_t spheres) {
  RandomScenes scenes;
  if (arguments.indenter != "sphere") scenes.cylinders = cylinders;
  if (arguments.indenter != "cylinder") scenes.spheres = spheres;
  scenes.seed = arguments.seed;
  scenes.spectra = static_cast<Spectra>(find_name(ChoiceNames<Spectra>::names, arguments.materials));
  scenes.jobs = arguments.jobs;
  scenes.time_limit = arguments.time_limit;
  return scenes;
}

StabilityPlan plan_of(const StabilityArguments& arguments) {
  const std::size_t asked = arguments.scenes;
  StabilityPlan plan{random_scenes(arguments, asked > 0 ? asked : usual_cylinders, asked > 0 ? asked : usual_spheres)};
  plan.methods = methods_to_try(arguments.methods);
  return plan;
}

/// Takes away what an earlier run left in the folder of failed scenes, and nothing else.
void remove_failed_scenes(const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    for (const std::string_view method : ChoiceNames<Method>::names)
      for (const std::string_view indenter : ChoiceNames<Indenter>::names) {
        const std::string start = std::string(method) + '-' + std::string(indenter) + '-';
        if (name.starts_with(start) && name.find_first_not_of("0123456789", start.size()) == name.rfind(".json"))
          fs::remove(entry.path(), error);
      }
  }
}

std::string share(std::size_t part, std::size_t whole) {
  if (part == 0) return "0";
  return std::to_string(part) + " (" + short_number(100.0 * static_cast<double>(part) / static_cast<double>(whole), 3) +
         " %)";
}

Table table_of(const std::vector<StabilityCount>& all) {
  return table_of(all, [](const StabilityCount& count) {
    NamedCells row{
        {"method", cell_of(count.method)}, {"indenter", cell_of(count.indenter)}, {"scenes", cell_of(count.trials())}};
    for (std::size_t i = 0; i < count.of.size(); ++i)
      row.emplace_back(ChoiceNames<Outcome>::names[i], share(count.of[i], count.trials()));
    row.emplace_back("median", readable(count.median_seconds, "s"));
    row.emplace_back("95 %", readable(count.seconds_95, "s"));
    row.emplace_back("longest", readable(count.longest_seconds, "s"));
    return row;
  });
}

Json object_of(const StabilityCount& count) {
  Json object{{"method", name_of(count.method)}, {"indenter", name_of(count.indenter)}, {"scenes", count.trials()}};
  for (std::size_t i = 0; i < count.of.size(); ++i) object[std::string(ChoiceNames<Outcome>::names[i])] = count.of[i];
  object["median_seconds"] = finite_or_null(count.median_seconds);
  object["seconds_95"] = finite_or_null(count.seconds_95);
  object["longest_seconds"] = finite_or_null(count.longest_seconds);
  return object;
}

std::vector<fs::path> draw_maps(const StabilityReport& report, const fs::path& folder) {
  std::vector<fs::path> pictures;
  for (const StabilityCount& count : counts(report.trials)) {
    std::vector<Trial> own;
    std::copy_if(report.trials.begin(), report.trials.end(), std::back_inserter(own), [&](const Trial& trial) {
      return trial.scene.method == count.method && trial.scene.indenter == count.indenter;
    });
    const std::string name = std::string(name_of(count.method)) + '-' + std::string(name_of(count.indenter));
    const ChartFiles files = draw_stability_map(own, folder / (name + ".svg"));
    for (const auto& file : {files.svg, files.png}) pictures.push_back(file);
  }
  return pictures;
}

/// Writes both scenes of each relation that is broken, or of which one alone has an answer. @returns the broken ones'
std::vector<std::string> write_broken(const RelationReport& report, const fs::path& folder) {
  std::vector<std::string> files;
  for (const RelationTrial& trial : report.trials) {
    if (trial.finding.outcome == RelationOutcome::kept || trial.finding.one.empty()) continue;
    const fs::path place = folder / std::string(name_of(trial.finding.outcome));
    make_directory(place);
    for (const auto& [which, scene] : {std::pair("one", trial.finding.one), std::pair("other", trial.finding.other)}) {
      const fs::path file = place / (trial_name(trial) + '-' + which + ".json");
      write_file(file, trial_scene_json(trial, scene));
      if (is_broken(trial)) files.push_back(file.string());
    }
  }
  return files;
}

/// @throws std::invalid_argument for a name that no relation has
void require_known(const std::vector<std::string>& names) {
  std::vector<std::string_view> known;
  for (const Relation& relation : relations()) known.push_back(relation.name);
  for (const std::string& name : names)
    if (find_name(known, name) < 0)
      throw std::invalid_argument("--only = \"" + name + "\": no relation has this name; there are " + joined(known));
}

/// Whether answers obey the relations that hold between them.
void relate(const StabilityArguments& arguments, Session& session) {
  require_known(arguments.only);
  make_directory(arguments.out);
  const std::size_t asked = arguments.relations;
  RelationPlan plan{random_scenes(arguments, asked, arguments.indenter == "sphere" ? asked : (asked + 9) / 10)};
  plan.names = arguments.only;
  const RelationReport report = watched_run(plan, session, [&] { return run_relations(plan, session.evaluate); });
  const std::vector<std::string> broken = write_broken(report, arguments.out);
  const fs::path file = fs::path(arguments.out) / "relations.csv";
  write_file(file, csv_of(relation_trials_table(report.trials)));
  const Table table = relations_table(report.trials);
  if (arguments.json) {
    session.out << text_of(json_object("seed", plan.seed, "interrupted", report.interrupted, "results", json_of(table),
                                       "broken", broken, "files", Json::array({file.string()})),
                           2)
                << '\n';
  } else {
    write_aligned(session.out, table);
    session.out << file.string() << '\n';
    if (!broken.empty())
      session.out << broken.size() / 2
                  << " broken, both scenes to be solved again with rollres solve, the first: " << broken.front()
                  << '\n';
  }
  if (report.interrupted) session.err << "interrupted: only part of the scenes was solved\n";
  if (report.interrupted || any_of(report.trials, is_broken)) session.status = ExitStatus::no_answer;
}

void stability(const StabilityArguments& arguments, Session& session) {
  if (arguments.relations > 0) return relate(arguments, session);
  StabilityPlan plan = plan_of(arguments);
  const fs::path folder = arguments.out, failed = folder / "failed";
  make_directory(folder);  // before the work, not after it
  remove_failed_scenes(failed);

  std::vector<std::string> failed_files;
  plan.on_trial = [&](const Trial& trial) {
    if (!is_failure(trial.outcome)) return;
    make_directory(failed);
    failed_files.push_back((failed / failed_scene_name(trial)).string());
    write_file(failed_files.back(), failed_scene_json(trial));
  };
  const StabilityReport report = watched_run(plan, session, [&] { return run_stability(plan, session.evaluate); });

  const fs::path rows = folder / "stability.csv";
  write_file(rows, csv_of(trials_table(report.trials)));
  const std::vector<StabilityCount> all = counts(report.trials);
  std::vector<fs::path> files = draw_maps(report, folder);
  files.insert(files.begin(), rows);

  if (arguments.json) {
    Json object = json_object("out", folder.string(), "seed", plan.seed, "cylinders", plan.cylinders, "spheres",
                              plan.spheres, "interrupted", report.interrupted, "seconds", report.seconds, "results",
                              Json::array(), "failed", failed_files, "files", Json::array());
    for (const StabilityCount& count : all) object["results"].push_back(object_of(count));
    for (const fs::path& file : files) object["files"].push_back(file.string());
    session.out << text_of(object, 2) << '\n';
  } else {
    write_aligned(session.out, table_of(all));
    for (const fs::path& file : files) session.out << file.string() << '\n';
    if (!failed_files.empty())
      session.out << failed_files.size() << " failed, to be solved again with rollres solve: " << failed.string()
                  << '\n';
  }
  if (report.interrupted) session.err << "interrupted: only part of the scenes was solved\n";
  const bool bad =
      any_of(all, [](const StabilityCount& count) { return count[Outcome::wrong] + count[Outcome::crashed] > 0; });
  if (bad || report.interrupted) session.status = ExitStatus::no_answer;
}

}  // namespace

void add_stability(Command& program, Session& session) {
  const auto [command, arguments] = program.add<StabilityArguments>(
      "stability", "Try the methods on random scenes: which fails where", session, stability);
  command->add_option("--out DIR", arguments.out, "folder for the table, the maps and the scenes that failed")
      ->required();
  CommandOption* const scenes =
      command
          ->add_option("--scenes N", arguments.scenes, "scenes for each indenter; default: 1000 cylinders, 100 spheres")
          ->between(1, 100'000'000);
  command->add_option("--seed S", arguments.seed, "of the random scenes; default: 1");
  CommandOption* const methods = command
                                     ->add_option("--methods METHOD,...", arguments.methods,
                                                  "the methods to try, with commas between; default: all")
                                     ->delimiter(',')
                                     ->one_value_each();
  command
      ->add_option("--materials MATERIALS", arguments.materials,
                   "of the random scenes: zener, wide (spectra over many decades) or both, at random; default: both")
      ->one_of(ChoiceNames<Spectra>::names);
  CommandOption* const related =
      command
          ->add_option(
              "--relations N", arguments.relations,
              "instead: whether answers obey the relations between them (a layer cut in two, other units, load "
              "found and given back, ...), each on so many random cylinders and a tenth as many spheres; into "
              "DIR/relations.csv, scenes that break one into DIR/broken")
          ->between(1, 1'000'000)
          ->excludes(scenes)
          ->excludes(methods);
  command
      ->add_option(
          "--only RELATION,...", arguments.only,
          "the relations to try, by their names in the table (\"cut in two\"), with commas between; default: all")
      ->delimiter(',')
      ->one_value_each()
      ->needs(related);
  command->add_option("--indenter INDENTER", arguments.indenter, "cylinder, sphere or both; default: both")
      ->one_of({"cylinder", "sphere", "both"});
  command->add_option("--jobs N", arguments.jobs, "processes; default: one for each core")->between(1, 1024);
  command->add_option("--time-limit SECONDS", arguments.time_limit, "for one scene, in seconds; default: 600")
      ->positive();
  command->add_flag("--json", arguments.json, "print the outcome as one JSON object");
  command->footer(
      "converged: every law of contact holds to 1e-8. wrong: the status is converged, but a law is broken.\n"
      "refused: the drive needs more friction; solving with 2 % more and 2 % less than needed confirms it.\n"
      "unconfirmed: refused, but not confirmed. Exit status 1: one is wrong or crashed, or a relation is broken.\n"
      "Example: rollres stability --out stability --scenes 200 --methods newton,active_set\n"
      "Example: rollres stability --out relations --relations 100\n"
      "Example: rollres stability --out relations --relations 300 --only \"cut in two\" --indenter cylinder");
}

}  // namespace rollres
