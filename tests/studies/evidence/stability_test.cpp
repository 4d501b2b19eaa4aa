#include "studies/evidence/stability.hpp"

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "studies/evidence/stability_scene.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers stability_map and command_stability, too.

using namespace rollres;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// An answer to which nothing can be objected.
RollingSolution flawless(const RollingScene& scene) {
  RollingSolution solution = closed_form(scene);
  visit_outputs(solution, [](const Quantity&, auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>)
      if (std::isnan(value)) value = 1;
  });
  solution.friction_needed = RollingSolution::absent;
  solution.law_violation = 1e-12;
  return solution;
}

/// Refuses below a friction coefficient and says so.
Evaluate needs_friction(double needed, double said) {
  return [=](const RollingScene& scene) {
    if (scene.friction_coefficient >= needed) return flawless(scene);
    RollingSolution solution;
    solution.status = Status::no_steady_state;
    solution.friction_needed = said;
    solution.reason = "needs more friction";
    return solution;
  };
}

/// An answer of each kind in turn, by the number of nodes that the scene's spacing asks for.
RollingSolution answer_of_kind(std::size_t kind, const RollingScene& scene) {
  RollingSolution solution = flawless(scene);
  switch (kind % 6) {
    case 1:
      return needs_friction(2 * scene.friction_coefficient, 2 * scene.friction_coefficient)(scene);
    case 2:
      solution.status = Status::no_steady_state;
      break;
    case 3:
      solution = {};
      solution.reason = "stopped";
      break;
    case 4:
      solution.law_violation = 1e-6;
      break;
    case 5:
      std::raise(SIGKILL);
      break;
    default:
      break;
  }
  return solution;
}

/// The random scenes of seed 1 answered by kinds in turn.
Evaluate all_kinds(std::size_t scenes) {
  std::vector<double> speeds;
  for (std::size_t number = 0; number < scenes; ++number)
    speeds.push_back(stability_scene(Indenter::cylinder, 1, number).speed);
  return [=](const RollingScene& scene) {
    const auto found = std::find(speeds.begin(), speeds.end(), scene.speed);
    const auto number = static_cast<std::size_t>(found - speeds.begin());
    // The confirmation of a refusal: the same scene with more or less friction than its own.
    const double own = stability_scene(Indenter::cylinder, 1, number).friction_coefficient;
    if (scene.friction_coefficient != own) return needs_friction(2 * own, 2 * own)(scene);
    return answer_of_kind(number, scene);
  };
}

Outcome outcome_of(const Evaluate& evaluate) { return judge(evaluate, plain_scene()).outcome; }

}  // namespace

TEST_CASE("an answer that says converged is believed only if its laws hold and its numbers are finite",
          "[studies][stability]") {
  CHECK(outcome_of(flawless) == Outcome::converged);
  const auto with = [](auto change) {
    return [=](const RollingScene& scene) {
      RollingSolution solution = flawless(scene);
      change(solution);
      return solution;
    };
  };
  CHECK(outcome_of(with([](auto& s) { s.law_violation = 1.1e-8; })) == Outcome::wrong);
  CHECK(outcome_of(with([](auto& s) { s.law_violation = RollingSolution::absent; })) == Outcome::wrong);
  CHECK(outcome_of(with([](auto& s) { s.rolling_resistance = INFINITY; })) == Outcome::wrong);
  CHECK(outcome_of(with([](auto& s) { s.rotation_ratio = RollingSolution::absent; })) == Outcome::wrong);
  CHECK(outcome_of(with([](auto& s) { s.half_width = RollingSolution::absent; })) == Outcome::converged);

  RollingScene frictionless = plain_scene();
  frictionless.friction_coefficient = 0;
  const auto without_rotation = with([](auto& s) { s.rotation_ratio = RollingSolution::absent; });
  CHECK(judge(without_rotation, frictionless).outcome == Outcome::converged);

  // An approach is missing, but not to a half-space.
  const auto without_approach = with([](auto& s) { s.approach = RollingSolution::absent; });
  CHECK(outcome_of(without_approach) == Outcome::wrong);
  RollingScene deep = plain_scene();
  deep.layer_thickness = INFINITY;
  CHECK(judge(without_approach, deep).outcome == Outcome::converged);

  const Trial wrong = judge(with([](auto& s) { s.law_violation = 1e-3; }), plain_scene());
  CHECK_THAT(wrong.reason, Contains("law of contact is violated by 0.001"));
  CHECK(wrong.solution.law_violation == 1e-3);
  CHECK(wrong.solution.contact_nodes == 31);
}

TEST_CASE("an answer that did not converge and an exception are told apart", "[studies][stability]") {
  CHECK(outcome_of([](const RollingScene&) { return RollingSolution{}; }) == Outcome::not_converged);
  const Trial crashed =
      judge([](const RollingScene&) -> RollingSolution { throw std::runtime_error("no memory"); }, plain_scene());
  CHECK(crashed.outcome == Outcome::crashed);
  CHECK(crashed.reason == "no memory");
  CHECK(outcome_of([](const RollingScene&) -> RollingSolution { throw 1; }) == Outcome::crashed);
}

TEST_CASE("a refusal counts if the friction it asks for is needed and suffices, to 2 %", "[studies][stability]") {
  CHECK(outcome_of(needs_friction(0.5, 0.5)) == Outcome::refused);
  CHECK(outcome_of(needs_friction(0.5, 0.505)) == Outcome::refused);
  CHECK(outcome_of(needs_friction(0.5, 0.495)) == Outcome::refused);
  CHECK(outcome_of(needs_friction(0.5, 0.52)) == Outcome::unconfirmed);
  CHECK(outcome_of(needs_friction(0.5, 0.48)) == Outcome::unconfirmed);
  CHECK(outcome_of(needs_friction(0.5, RollingSolution::absent)) == Outcome::unconfirmed);
  CHECK(outcome_of(needs_friction(0.5, INFINITY)) == Outcome::unconfirmed);
  CHECK(outcome_of(needs_friction(0.5, 0.2)) == Outcome::unconfirmed);  // the scene has 0.3
  CHECK_THAT(judge(needs_friction(0.5, 0.52), plain_scene()).reason,
             Contains("needs more friction; but it converges with 2 % less"));
}

TEST_CASE("every method solves every random scene, and one that ends its process is counted as crashed",
          "[studies][stability]") {
  StabilityPlan plan;
  plan.cylinders = 12;
  plan.methods = {Method::newton, Method::active_set};
  plan.jobs = 2;
  std::size_t heard = 0;
  plan.on_trial = [&](const Trial&) { ++heard; };
  const StabilityReport report = run_stability(plan, all_kinds(12));

  CHECK_FALSE(report.interrupted);
  REQUIRE(report.trials.size() == 24);
  CHECK(heard == 24);
  for (std::size_t i = 0; i < 24; ++i) {
    const Trial& trial = report.trials[i];
    CHECK(trial.number == i / 2);
    CHECK(trial.scene.method == plan.methods[i % 2]);
    CHECK(trial.outcome == static_cast<Outcome>(trial.number % 6));
  }
  CHECK_THAT(report.trials[10].reason, Contains("signal 9"));

  const std::vector<StabilityCount> all = counts(report.trials);
  REQUIRE(all.size() == 2);
  for (const StabilityCount& count : all) {
    CHECK(count.trials() == 12);
    for (const std::size_t number : count.of) CHECK(number == 2);
    CHECK(count.median_seconds <= count.seconds_95);
    CHECK(count.seconds_95 <= count.longest_seconds);
  }

  const Table table = trials_table(report.trials);
  REQUIRE(table.rows.size() == 24);
  for (const auto& row : table.rows) CHECK(row.size() == table.columns.size());
  for (const std::string_view key : input_keys())
    CHECK(std::count(table.columns.begin(), table.columns.end(), std::string(key)) == 1);
}

TEST_CASE("a stability run that is stopped keeps what was solved until then", "[studies][stability]") {
  std::atomic<bool> stop = false;
  StabilityPlan plan;
  plan.cylinders = 500;
  plan.spheres = 50;
  plan.spectra = Spectra::zener;  // which are drawn in less time
  plan.methods = {Method::newton};
  plan.stop = &stop;
  std::size_t heard = 0;
  plan.on_trial = [&](const Trial&) { stop = ++heard >= 44; };
  const StabilityReport report = run_stability(plan, flawless);
  CHECK(report.interrupted);
  CHECK(report.trials.size() == heard);
  // Spheres come in even mixture, so that the first part of a run tells of both.
  const auto spheres = std::count_if(report.trials.begin(), report.trials.end(),
                                     [](const Trial& trial) { return trial.scene.indenter == Indenter::sphere; });
  CHECK(spheres >= 3);
  CHECK(spheres <= 5);
}

TEST_CASE("a failed scene is a scene file that reads back as the same scene", "[studies][stability][long]") {
  for (std::size_t number = 0; number < 40; ++number)
    for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
      Trial trial;
      trial.number = number;
      trial.scene = stability_scene(indenter, 1, number);
      trial.scene.method = Method::active_set;
      trial.outcome = Outcome::not_converged;
      trial.reason = "stopped after \"60\" iterations\n";
      const std::string file = failed_scene_json(trial);
      CHECK_THAT(file, Contains("not_converged: stopped after"));
      CHECK(scene_json(parse_scene(file, "file")) == scene_json(trial.scene));
    }
  Trial trial;
  trial.number = 17;
  trial.scene.method = Method::newton;
  CHECK(failed_scene_name(trial) == "newton-cylinder-17.json");
}

TEST_CASE("a stability map tells outcomes apart by colour and by mark", "[studies][stability]") {
  std::vector<Trial> trials(12);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    trials[i].scene = stability_scene(Indenter::cylinder, 1, i);
    trials[i].scene.method = Method::newton;
    trials[i].outcome = static_cast<Outcome>(i % 6);
  }
  const std::string script = stability_map(trials, chart_files("map")).script;
  std::set<std::string> types, colours;
  for (std::size_t at = 0; (at = script.find("using 1:2 with points pt ", at)) != std::string::npos; ++at) {
    const std::string look = script.substr(at, script.find(" ps ", at) - at);
    types.insert(look.substr(25, look.find(" lc") - 25));
    colours.insert(look.substr(look.find('#')));
  }
  CHECK(types.size() == 6);
  CHECK(colours.size() == 6);
  CHECK_THAT(script, Contains("set logscale x") && Contains("set logscale y") && Contains("'2 not converged"));

  const TemporaryDirectory folder;
  const ChartFiles files = draw_stability_map(trials, folder.path / "map");
  CHECK(file_text(files.png).substr(1, 3) == "PNG");
  CHECK_THAT(file_text(files.svg), Contains("2 crashed") && Contains("newton, cylinder: 12 random scenes"));
}

TEST_CASE("rollres stability leaves a table, maps and the failed scenes behind", "[studies][stability]") {
  const TemporaryDirectory folder;
  const std::string out = (folder.path / "new").string();
  const auto run = [&](const Evaluate& evaluate, const std::string& methods) {
    return run_rollres({"stability", "--out", out, "--scenes", "6", "--indenter", "cylinder", "--methods", methods,
                        "--jobs", "2", "--json"},
                       evaluate);
  };
  const ProgramRun bad = run(all_kinds(6), "newton,active_set");
  CHECK(bad.status == ExitStatus::no_answer);
  CHECK(bad.err.empty());
  const auto object = nlohmann::json::parse(bad.out);
  REQUIRE(object["results"].size() == 2);
  CHECK(object["results"][1]["method"] == "active_set");
  for (const std::string_view outcome : ChoiceNames<Outcome>::names)
    CHECK(object["results"][0][std::string(outcome)] == 1);
  CHECK(object["failed"].size() == 8);
  for (const auto& file : object["files"]) CHECK(fs::file_size(file.get<std::string>()) > 0);
  const std::string csv = file_text(fs::path(out) / "stability.csv");
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 1 + 12);

  // What failed is solved again from its file.
  const std::string wrong = (fs::path(out) / "failed" / "newton-cylinder-4.json").string();
  const ProgramRun again = run_rollres({"solve", wrong, "--json"}, all_kinds(6));
  CHECK(nlohmann::json::parse(again.out)["law_violation"] == 1e-6);

  // A later run takes the failed scenes of an earlier one away, and leaves what is not its own.
  folder.write("new/failed/newton-cylinder-mine.json", "{}");
  const ProgramRun good = run(flawless, "newton");
  CHECK(good.status == ExitStatus::answered);
  CHECK(nlohmann::json::parse(good.out)["failed"].empty());
  CHECK(std::distance(fs::directory_iterator(fs::path(out) / "failed"), {}) == 1);
}

TEST_CASE("rollres stability prints a table with counts and shares", "[studies][stability]") {
  const TemporaryDirectory folder;
  const ProgramRun run =
      run_rollres({"stability", "--out", folder.path.string(), "--scenes", "4", "--methods", "newton"}, flawless);
  CHECK(run.status == ExitStatus::answered);
  CHECK_THAT(run.out, Contains("method  indenter") && Contains("4 (100 %)") && Contains("stability.csv"));
  CHECK(fs::exists(folder.path / "newton-cylinder.svg"));
  CHECK(fs::exists(folder.path / "newton-sphere.png"));
}

TEST_CASE("rollres stability refuses a method it does not know, and a folder it cannot make", "[studies][stability]") {
  const TemporaryDirectory folder;
  const ProgramRun unknown =
      run_rollres({"stability", "--out", folder.path.string(), "--methods", "newton,activeset"}, flawless);
  CHECK(unknown.status == ExitStatus::wrong_input);
  CHECK_THAT(unknown.err, Contains("--methods = \"activeset\": unknown method; did you mean active_set?"));
  const std::string file = folder.write("file", "").string();
  const ProgramRun blocked = run_rollres({"stability", "--out", file + "/x", "--scenes", "1"}, flawless);
  CHECK(blocked.status == ExitStatus::failure);
  CHECK_THAT(blocked.err, Contains(file + "/x"));
}
