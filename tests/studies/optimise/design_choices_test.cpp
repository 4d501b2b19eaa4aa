#include "studies/optimise/design_choices.hpp"

#include <cmath>
#include <sstream>

#include "studies/optimise/design_file.hpp"
#include "studies/optimise/optimise_report.hpp"
#include "studies/optimise/stored_optimum.hpp"
#include "tests/catch.hpp"
#include "tests/studies/design_bowl.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;

namespace {

const std::string head = R"({"study": "chosen", "scene": {"radius": 0.1, "layer_thickness": 0.005,
  "static_shear_modulus": 2e6, "stiffening": 2, "creep_time": 0.1, "speed": 1, "load": 1e4},
  "minimise": "rolling_resistance", )";

std::vector<DesignProblem> problems_with(const std::string& rest) {
  const TemporaryDirectory folder;
  return read_design_problems(folder.write("study.json", head + rest + "}"));
}

std::string refusal_of_choices(const std::string& rest) {
  return message_of([&] { problems_with(rest); });
}

/// ln R of the bowl at its best thickness for a modulus: the minimum over x of a parabola.
double best_resistance(double modulus) {
  const double dy = std::log10(modulus / 1e6) - 0.6;
  return Bowl::log_resistance(0.3 - 0.2 * dy, 0.6 + dy);
}

const std::string moduli =
    R"("variant": {"soft": {"static_shear_modulus": 1e6}, "medium": {"static_shear_modulus": 3e6},
  "hard": {"static_shear_modulus": 9e6}})";
const std::string any_thickness = R"("layer_thickness": {"from": "1 mm", "to": "20 mm"})";

}  // namespace

TEST_CASE("every combination of what is chosen from lists is a problem of the other variables",
          "[studies][optimise][choices]") {
  const auto problems = problems_with(R"("variables": {"drive": ["top_force", "free"], )" + any_thickness +
                                      R"(, "radius": ["10 cm",
    "20 cm", 0.3], )" + moduli + "}");
  REQUIRE(problems.size() == 18);
  CHECK(chosen_in_words(problems.front()) == "variant = soft, drive = top_force, radius = 100 mm");
  CHECK(chosen_in_words(problems.back()) == "variant = hard, drive = free, radius = 300 mm");
  for (const DesignProblem& problem : problems) CHECK(problem.variables.size() == 1);
  CHECK(problems.back().scenes[0].scene.radius == 0.3);
  CHECK(problems.back().scenes[0].scene.drive == Drive::free);
  CHECK(*problems.back().scenes[0].scene.static_shear_modulus == 9e6);
  CHECK(problems.back().variant() == "hard");
}

TEST_CASE("the best of all choices is found, each with the best values of the others", "[studies][optimise][choices]") {
  const auto problems = problems_with(R"("variables": {)" + moduli + ", " + any_thickness + "}");
  StoredEvaluations evaluations(Bowl::solve);
  const ChoicesReport report = optimise_choices(problems, evaluations);
  CHECK(report.status == DesignStatus::optimum);
  REQUIRE(report.best == 1);  // the bowl is lowest at 4 MPa
  const double moduli_of[] = {1e6, 3e6, 9e6};
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(std::log(report.reports[i].value()) == Approx(best_resistance(moduli_of[i])).margin(1e-5));
  CHECK(report.count.all() == evaluations.count().all());
}

TEST_CASE("choices that differ by less than their errors leave open are said to be undecided",
          "[studies][optimise][choices]") {
  const auto problems = problems_with(R"("variables": {)" + moduli + ", " + any_thickness + "}");
  const auto sentences = [&](double relative_error) {
    StoredEvaluations evaluations([=](const RollingScene& scene) {
      RollingSolution solution = Bowl::solve(scene);
      solution.rolling_resistance_error = relative_error * solution.rolling_resistance;
      return solution;
    });
    const ChoicesReport report = optimise_choices(problems, evaluations);
    REQUIRE(report.best == 1);
    std::ostringstream text;
    print_text(problems, report, text);
    CHECK((text.str().find("so the better one may be the worse in truth") != std::string::npos) ==
          (relative_error > 0.01));
    return json_of(problems, report)["undecided"];
  };
  CHECK(sentences(1e-6).empty());
  const auto open = sentences(10);  // of all
  REQUIRE(open.size() == 2);
  CHECK_THAT(open[0].get<std::string>(), Contains("variant = soft is worse than the best by "));
}

TEST_CASE("a search tells its choice, the best of all choices and how long it may take at most",
          "[studies][optimise][choices]") {
  const auto problems = problems_with(R"("variables": {)" + moduli + ", " + any_thickness + "}");
  StoredEvaluations evaluations(Bowl::solve);
  std::vector<OptimiseProgress> told;
  OptimiseOptions options;
  options.jobs = 1;
  options.report = [&](const OptimiseProgress& progress) { told.push_back(progress); };
  const ChoicesReport report = optimise_choices(problems, evaluations, options);
  CHECK(told.front().place == 1);
  CHECK(told.back().place == 3);
  double best = INFINITY;
  for (const OptimiseProgress& progress : told) {
    CHECK(progress.all == 3);
    CHECK(progress.limit == evaluation_limit(problems.front()));
    if (!progress.best) continue;
    CHECK(*progress.best <= best);  // over the choices, too
    best = *progress.best;
  }
  CHECK(best == report.reports[*report.best].value());
  const OptimiseProgress shown{{10, 0, 0}, best, 50, 2, 2, 3};
  CHECK_THAT(in_words(problems.front(), shown),
             Contains("choice 2 of 3: 10 of at most 50, best ") && EndsWith(", at most 18 s left"));
}

TEST_CASE("a constraint may rule out the choice that is best without it", "[studies][optimise][choices]") {
  // ln p = x + y - 1.2 <= -0.9: at 3 MPa y = 0.477, x <= -0.18 is outside the box.
  const auto problems = problems_with(R"("constraints": ["peak_pressure <= 0.40657 Pa"], "variables": {)" + moduli +
                                      ", " + any_thickness + "}");
  StoredEvaluations evaluations(Bowl::solve);
  const ChoicesReport report = optimise_choices(problems, evaluations);
  CHECK(report.status == DesignStatus::optimum);
  REQUIRE(report.best == 0);
  CHECK(report.reports[1].status == DesignStatus::no_feasible_design);
  CHECK(std::log(report.reports[0].value()) == Approx(Bowl::log_resistance(0.3, 0)).margin(2e-4));
}

TEST_CASE("choices alone need no search", "[studies][optimise][choices]") {
  const auto problems =
      problems_with(R"("variables": {"layer_thickness": ["1 mm", "2.5 mm", "20 mm"], )" + moduli + "}");
  StoredEvaluations evaluations(Bowl::solve);
  const ChoicesReport report = optimise_choices(problems, evaluations);
  CHECK(report.status == DesignStatus::optimum);
  REQUIRE(report.best);
  CHECK(chosen_in_words(problems[*report.best]) == "variant = medium, layer_thickness = 2.5 mm");
  CHECK(report.count.all() == 9);
}

TEST_CASE("rollres optimise tells the choice, stores its name with each point and repeats itself at no cost",
          "[studies][optimise][choices]") {
  const TemporaryDirectory folder;
  const std::string study = folder.write("s.json", head + R"("variables": {)" + moduli + ", " + any_thickness + "}}");
  const std::string db = folder / "a.db";
  const ProgramRun text = run_rollres({"optimise", study, "--db", db, "--out", folder / "course"}, Bowl::solve);
  CHECK(text.status == 0);
  CHECK_THAT(text.out, Contains("chosen: optimum") && Contains("the best, variant = medium:") && Contains("hard"));
  const Json answer = Json::parse(run_rollres({"optimise", study, "--db", db, "--json"}, Bowl::solve).out);
  CHECK(answer["chosen"]["variant"] == "medium");
  CHECK(answer["choices"].size() == 3);
  CHECK(answer["evaluations"]["solved"] == 0);
  for (const char* const name : {"soft", "medium", "hard"}) {
    const ProgramRun rows = run_rollres(
        {"query", "--db", db, "study=chosen", std::string("variant=") + name, "--by", "static_shear_modulus"},
        Bowl::solve);
    CHECK(rows.status == 0);
    CHECK(std::count(rows.out.begin(), rows.out.end(), '\n') == 2);  // a head and one modulus
  }
  ResultStore store(db, Access::read);
  const auto stored = stored_optimum(store, "chosen");
  REQUIRE(stored);
  CHECK(stored->problem.variant() == "medium");
  CHECK(std::log(stored->best->value) == Approx(best_resistance(3e6)).margin(1e-5));
  CHECK(run_rollres({"report", "--db", db, "--out", folder / "r.html"}, Bowl::solve).status == 0);
}

TEST_CASE("choices that are wrong are refused with file, key, value and rule", "[studies][optimise][choices]") {
  const auto variables = [](const std::string& of) { return R"("variables": {)" + of + "}"; };
  CHECK_THAT(refusal_of_choices(variables(R"("radius": [])")),
             Contains("variables: radius = []: must be a list of values"));
  CHECK_THAT(refusal_of_choices(variables(R"("radius": [0.1, 0.1])")), Contains("radius = 0.1: value given twice"));
  CHECK_THAT(refusal_of_choices(variables(R"("radius": ["3 s"])")),
             Contains("radius = \"3 s\": must have a unit of length"));
  CHECK_THAT(refusal_of_choices(variables(R"("drive": ["fre"])")), Contains("drive = \"fre\": must be one of"));
  CHECK_THAT(refusal_of_choices(variables(R"("indenter": ["cylinder", "sphere"])")),
             Contains("must be the same in all designs"));
  CHECK_THAT(refusal_of_choices(variables(R"("frequencies": [[1], [2]])")), Contains("give each list in a variant"));
  CHECK_THAT(refusal_of_choices(variables(moduli + R"(, "static_shear_modulus": {"from": 1e6, "to": 2e6})")),
             Contains("variables: variant: soft: static_shear_modulus = 1000000.0: is a variable too"));
  CHECK_THAT(refusal_of_choices(R"("set": {"static_shear_modulus": 1e6}, )" + variables(moduli)),
             Contains("variant: soft: static_shear_modulus = 1000000.0: is in \"set\" too"));
  CHECK_THAT(refusal_of_choices(R"("scenes": [{"set": {"static_shear_modulus": 1e6}}], )" + variables(moduli)),
             Contains("is in \"set\" too"));
  CHECK_THAT(message_of([&] {
               const TemporaryDirectory folder;
               read_design_problem(folder.write("s.json", head + variables(moduli) + "}"));
             }),
             Contains("variant: is chosen from a list, which has no range"));
}
