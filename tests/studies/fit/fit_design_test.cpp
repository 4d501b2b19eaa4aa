#include "studies/fit/fit_design.hpp"

#include <nlohmann/json.hpp>
#include <sstream>

#include "studies/fit/design_space.hpp"
#include "studies/fit/design_wish.hpp"
#include "tests/catch.hpp"
#include "tests/fitting/measured_hunter.hpp"
#include "tests/studies/half_space_fit.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using nlohmann::json;

namespace {

/// A fit of three parameters to 2 loads and 8 speeds.
struct DesignFiles {
  TemporaryDirectory directory;
  json fit = half_space_fit();

  DesignFiles() {
    std::ostringstream table;
    table.precision(12);
    table << "load [kN/m],speed [cm/s],rolling_resistance [N/m],sigma [%]\n";
    for (const MeasuredScene& row : measured(quick_resistance, spread_speeds(0.005, 5, 8), {1e4, 4e4}, 0.02))
      table << *row.scene.load / 1e3 << ',' << row.scene.speed * 100 << ',' << row.measured.value << ",2\n";
    directory.write("table.csv", table.str());
  }
  std::string written(const std::string& name = "fit.json") const { return directory.write(name, fit.dump()).string(); }
  FitFile read() const { return read_fit(written()); }
};

FitReport fitted(const FitFile& file) { return fit(problem_of(file, quick_resistance), file); }

/// The least deviation of the worst aim that one datum of a fine grid over speed and load leaves.
double exhaustive(const FitFile& file, const FitReport& report, const MeasurementPlan& plan) {
  const DesignSpace space = design_space(file);
  std::vector<MeasuredScene> scenes;
  constexpr int pieces = 60;
  for (int i = 0; i <= pieces; ++i)
    for (int j = 0; j <= pieces; ++j)
      scenes.push_back(space.at(0, Eigen::Vector2d(static_cast<double>(i) / pieces, static_cast<double>(j) / pieces)));
  double least = plan.deviations[static_cast<Eigen::Index>(plan.worst)];
  for (const DesignChoice& choice : rated(plan, report, file.inputs, scenes, quick_resistance))
    least = std::min(least, choice.deviations[static_cast<Eigen::Index>(plan.worst)]);
  return least;
}

}  // namespace

TEST_CASE("the datum that a design names is as good as the best of an exhaustive search", "[studies][fit][design]") {
  DesignFiles files;
  for (const bool for_a_prediction : {false, true}) {
    if (for_a_prediction) files.fit["design"]["targets"] = {{{"speed", "30 m/s"}, {"load", "200 kN/m"}}};
    const FitFile file = files.read();
    const FitReport report = fitted(file);
    const FitDesign design = design_of(file, report, quick_resistance, 1);
    CHECK(design.inputs == std::vector<std::string>{"speed", "load"});
    const MeasurementPlan& plan = design.anywhere;
    const auto worst = static_cast<Eigen::Index>(plan.worst);
    REQUIRE_FALSE(plan.choices.empty());
    const double now = plan.deviations[worst], named = plan.choices.front().deviations[worst];
    CHECK(named < now);
    CHECK(now - named >= (1 - 2e-3) * (now - exhaustive(file, report, plan)));  // BOBYQA ends at 1e-3 of the ranges
    REQUIRE(design.together.size() == 3);
    for (std::size_t k = 1; k < 3; ++k)
      CHECK(design.together[k].deviations.maxCoeff() <= design.together[k - 1].deviations.maxCoeff());
  }
}

TEST_CASE("a measurement that is named for a prediction makes its band as narrow as foretold",
          "[studies][fit][design]") {
  DesignFiles files;
  files.fit["design"] = {{"targets", {{{"speed", "30 m/s"}}}}, {"points", 1}};
  const FitFile file = files.read();
  const FitReport report = fitted(file);
  const FitDesign design = design_of(file, report, quick_resistance, 1);
  REQUIRE(design.anywhere.aims.size() == 1);
  CHECK(design.anywhere.aims[0].name == "rolling_resistance at speed = 30 m/s");
  const DesignChoice& best = design.anywhere.choices.front();
  FitFile more = file;
  more.scenes.push_back({best.scene, {best.predicted, best.deviation, "new"}, best.set, file.output});
  const FitReport after = fitted(more);
  const DesignAim aim = prediction_aims(after, more.inputs, more.design.targets, quick_resistance).front();
  CHECK(std::sqrt(aim.direction.dot(design_covariance(after) * aim.direction)) ==
        Approx(best.deviations[0]).epsilon(0.02));  // the fit moves a little
}

TEST_CASE("ranges of a design hold its measurements, and wrong ones are refused", "[studies][fit][design]") {
  DesignFiles files;
  files.fit["design"]["ranges"] = {{"speed", {{"from", "1 cm/s"}, {"to", "2 cm/s"}}},
                                   {"radius", {{"from", "5 cm"}, {"to", "20 cm"}}}};
  const FitFile file = files.read();
  const FitDesign design = design_of(file, fitted(file), quick_resistance, 1);
  CHECK(design.inputs == std::vector<std::string>{"radius", "speed", "load"});
  for (const DesignChoice& choice : design.anywhere.choices) {
    CHECK(choice.scene.speed >= 0.01 * (1 - 1e-12));
    CHECK(choice.scene.speed <= 0.02 * (1 + 1e-12));
    CHECK(choice.scene.radius <= 0.2 * (1 + 1e-12));
  }
  for (const MeasurementPlan* const plan : {&design.speeds, &design.loads}) {
    CHECK_FALSE(plan->choices.empty());
    for (const DesignChoice& choice : plan->choices) {
      CHECK(choice.scene.speed >= 0.01);
      CHECK(choice.scene.speed <= 0.02);
    }
  }
  const auto refusal = [&](const json& wish) {
    files.fit["design"] = wish;
    return run_rollres({"fit", files.written(), "--db", (files.directory / "a.db").string()}, quick_resistance).err;
  };
  using Catch::Contains;
  CHECK_THAT(refusal({{"ranges", {{"speed", {{"from", 2}, {"to", 1}}}}}}), Contains("to = 1: must be above from"));
  CHECK_THAT(refusal({{"ranges", {{"spead", {{"from", 2}, {"to", 1}}}}}}), Contains("speed"));
  CHECK_THAT(refusal({{"ranges", {{"creep_time", {{"from", 1}, {"to", 2}}}}}}), Contains("is fitted"));
  CHECK_THAT(refusal({{"targets", json::array()}}), Contains("must be a list of objects"));
  CHECK_THAT(refusal({{"targets", {1}}}), Contains("design: targets = 1: must be objects of inputs"));
  CHECK_THAT(refusal({{"targets", {{{"speed", "1 kg"}}}}}), Contains("must have a unit"));
  CHECK_THAT(refusal({{"targets", {{{"data", "other"}}}}}), Contains("must be a data set"));
  CHECK_THAT(refusal({{"points", 0}}), Contains("design: points = 0"));
  CHECK_THAT(refusal({{"target", 1}}), Contains("targets"));
}

TEST_CASE("a design over all numbers names no measurement whose slopes are but noise", "[studies][fit][design]") {
  const DesignRange all{"speed", 1e-300, 1e300};
  CHECK(all.at(0) == Approx(1e-300));
  CHECK(all.at(0.5) == Approx(1).epsilon(1e-10));
  CHECK(all.at(1) == Approx(1e300));
  CHECK(all.part_of(1e150) == Approx(0.75));

  DesignFiles files;
  files.fit["design"]["ranges"] = {{"speed", {{"from", 1e-300}, {"to", 1e-200}}}};
  const FitFile file = files.read();
  const Evaluate rough = [](const RollingScene& scene) {
    RollingSolution solution = quick_resistance(scene);
    if (scene.speed < 1e-9) solution.rolling_resistance += 1 + 1e-3 * std::sin(1e9 * *scene.static_shear_modulus);
    return solution;
  };
  const FitDesign design = design_of(file, fitted(file), rough, 1);
  CHECK(design.anywhere.choices.empty());
  CHECK_THAT(design_summary(design, file), Catch::Contains("no scene in the ranges has an answer"));
}

TEST_CASE("two models are told apart where their predictions differ most, also beyond the data",
          "[studies][fit][design]") {
  DesignFiles files;
  std::vector<std::string> words{
      "fit", "", "", "--compare", "--db", (files.directory / "a.db").string(), "--json", "--no-profiles"};
  words[1] = files.written("free.json");
  files.fit["fit"] = "stiffening held";
  files.fit["parameters"]["stiffening"] = {{"start", 2.2}, {"fixed", true}};
  words[2] = files.written("held.json");
  const json answer = json::parse(run_rollres(words, quick_resistance).out);
  const json &at_data = answer["largest_difference"], &next = answer["next_measurement"];
  CHECK(next["deviations"].get<double>() >= at_data["deviations"].get<double>());
  CHECK(next["inputs"].contains("speed"));
  CHECK(next["inputs"].contains("load"));
  CHECK_THAT(next["where"].get<std::string>(), Catch::StartsWith("rolling_resistance at speed = "));
}
