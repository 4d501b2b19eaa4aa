#include "studies/relations/relations.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "core/model/stated_error.hpp"
#include "studies/relations/relation_run.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers layer_relations, material_relations, unit_relations, scenes_to_relate, related_answers, relation_run and command_stability, too.

using namespace rollres;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

const Relation& relation(std::string_view name) {
  for (const Relation& one : relations())
    if (one.name == name) return one;
  throw std::logic_error("no relation has this name");
}

/// Solves both scenes, and tells which differ.
void check_relation(const Relation& relation, Indenter indenter, std::uint64_t seed, Spectra spectra) {
  const RelationFinding finding = try_relation(related_scenes(relation, indenter, seed, 0, spectra), solve);
  INFO(relation.name << ", " << name_of(indenter) << " of seed " << seed << ": " << finding.words << "\n"
                     << finding.one << finding.other);
  CHECK(finding.outcome != RelationOutcome::broken);
}

/// An answer with the right dimensions, and a few wrong ones.
RollingSolution dimensional(const RollingScene& scene, double bias) {
  RollingSolution solution = closed_form(scene);
  solution.approach = scene.approach.value_or(bias * 0.01 * scene.radius);
  solution.load = scene.load.value_or(1e3);
  solution.rolling_resistance = 0.01 * solution.load;
  solution.rolling_resistance_error = 1e-9 * solution.rolling_resistance;
  solution.leading_edge = 0.1 * scene.radius;
  solution.trailing_edge = -0.1 * scene.radius;
  solution.method = Method::spectral;
  return solution;
}

}  // namespace

/// The materials of the scenes below.
constexpr Spectra tried_spectra = Spectra::wide;

TEST_CASE("answers to random cylinders obey the relations that hold between them", "[studies][relations][long]") {
  for (const Relation& one : relations())
    for (const std::uint64_t seed : {16, 20})  // which take some seconds
      check_relation(one, Indenter::cylinder, seed, tried_spectra);
}

TEST_CASE("answers to random spheres obey the relations that hold between them", "[studies][relations][long]") {
  for (const char* name : {"cut in two", "term split", "term unseen", "scaled", "given back"})
    check_relation(relation(name), Indenter::sphere, 5, tried_spectra);
}

TEST_CASE("a scene in other units is the same scene", "[studies][relations]") {
  const UnitFactors factors{8, 0.25, 1024}, back{0.125, 4, 1.0 / 1024};
  for (std::size_t number = 0; number < 20; ++number) {
    const RollingScene scene = stability_scene(Indenter::sphere, 1, number, Spectra::wide);
    const RollingScene other = in_units(scene, factors);
    CHECK(other.radius == 8 * scene.radius);
    CHECK(other.speed == scene.speed / 128);
    CHECK(*other.load == 16 * *scene.load);
    CHECK(scene_json(in_units(other, back)) == scene_json(scene));
  }
}

TEST_CASE("both scenes of a relation depend on the seed, the indenter and the number alone", "[studies][relations]") {
  const auto drawn = [](std::uint64_t seed, std::size_t number) {
    const RelatedScenes scenes = related_scenes(relation("cut in two"), Indenter::cylinder, seed, number);
    return scene_json(scenes.one) + scene_json(scenes.other({}));
  };
  CHECK(drawn(1, 2) == drawn(1, 2));
  CHECK(drawn(1, 2) != drawn(2, 2));
  CHECK(drawn(1, 2) != drawn(1, 3));
}

TEST_CASE("a layer cut in two or in five keeps its thickness and its material", "[studies][relations]") {
  for (std::size_t number = 0; number < 20; ++number)
    for (const char* name : {"cut in two", "cut in five"}) {
      const RelatedScenes scenes = related_scenes(relation(name), Indenter::cylinder, 1, number);
      const RollingScene &one = scenes.one, other = scenes.other({});
      const auto layers = [](const RollingScene& scene) {
        return 1 + scene.lower_layers.size() + scene.coating_layers.size();
      };
      CHECK(layers(other) == layers(one) + (std::string(name) == "cut in two" ? 1 : 4));
      const auto thickness = [](const RollingScene& scene, const BondedLayers& list, double sum) {
        for (const BondedLayer& layer : list) sum += layer.layer_thickness;
        return sum / scene.radius;
      };
      const double expected = thickness(one, one.lower_layers, one.layer_thickness);
      if (std::isfinite(expected))
        CHECK(thickness(other, other.lower_layers, other.layer_thickness) == Approx(expected).epsilon(1e-12));
      CHECK(thickness(other, other.coating_layers, 0) == Approx(thickness(one, one.coating_layers, 0)).epsilon(1e-12));
    }
}

TEST_CASE("an output that a relation contradicts is found, and named with both values", "[studies][relations]") {
  const RelatedScenes scenes = related_scenes(relation("cut in two"), Indenter::cylinder, 1, 0);
  RelatedScenes loaded = scenes;
  loaded.one.approach.reset();
  loaded.one.load = 1e3;
  const auto biased = [&](double bias) {
    return [&, bias](const RollingScene& scene) {
      return dimensional(scene, scene_json(scene) == scene_json(loaded.one) ? 1 : bias);
    };
  };
  loaded.other = [other = scenes.other](const RollingSolution& found) {
    RollingScene scene = other(found);
    scene.approach.reset();
    scene.load = 1e3;
    return scene;
  };
  CHECK(try_relation(loaded, biased(1)).outcome == RelationOutcome::kept);
  const RelationFinding broken = try_relation(loaded, biased(1.1));
  CHECK(broken.outcome == RelationOutcome::broken);
  CHECK(broken.output == "approach");
  CHECK(broken.difference == Approx(0.1));
  CHECK_THAT(broken.words, Contains("0.1 apart where"));
  CHECK(scene_json(parse_scene(broken.one, "one")) == scene_json(loaded.one));
}

TEST_CASE("a solver that counts in units of its own contradicts scaling", "[studies][relations]") {
  const auto own_units = [](const RollingScene& scene) {
    RollingSolution solution = dimensional(scene, 1);
    solution.rolling_resistance *= 1 + scene.speed;
    return solution;
  };
  const RelatedScenes scaled = related_scenes(relation("scaled"), Indenter::cylinder, 1, 1);
  CHECK(try_relation(scaled, own_units).outcome == RelationOutcome::broken);
}

TEST_CASE("a scene of which only one side has an answer is told apart, and is broken where only units differ",
          "[studies][relations]") {
  for (const auto& [name, outcome] : {std::pair("cut in five", RelationOutcome::one_sided),
                                      std::pair("speed and memories", RelationOutcome::broken)}) {
    const RelatedScenes scenes = related_scenes(relation(name), Indenter::cylinder, 1, 0);
    const auto first_alone = [&](const RollingScene& scene) {
      return scene_json(scene) == scene_json(scenes.one) ? dimensional(scene, 1) : RollingSolution{};
    };
    CHECK(try_relation(scenes, first_alone).outcome == outcome);
    CHECK(try_relation(scenes, [](const RollingScene&) { return RollingSolution{}; }).outcome ==
          RelationOutcome::unanswered);
  }
}

TEST_CASE("answers that a limit cut short differ by what they state where only units differ", "[studies][relations]") {
  const UnitFactors factors{8, 0.25, 1024};
  RollingScene plain = plain_scene();
  plain.load = 1e3;
  const RelatedScenes scaled{.one = plain,
                             .other = [&](const RollingSolution&) { return in_units(plain, factors); },
                             .factors = factors,
                             .exact = 1e-6,
                             .strict = true};
  const auto with_edges = [&](const std::string& warning, double share, double error) {
    return [&, warning, share, error](const RollingScene& scene) {
      RollingSolution solution = dimensional(scene, 1);
      solution.edge_error = error * scene.radius;
      if (scene_json(scene) == scene_json(scaled.one)) return solution;
      solution.trailing_edge *= 1 + share;
      solution.warnings.push_back(warning);
      return solution;
    };
  };
  const std::string missed = tolerance_missed(1e-6, RollingSolution{}, "", "a limit");
  const RelationFinding kept = try_relation(scaled, with_edges(missed, 0.01, 0.002));
  CAPTURE(kept.words);
  CHECK(kept.outcome == RelationOutcome::kept);
  CHECK(try_relation(scaled, with_edges(missed, 0.1, 0.002)).outcome == RelationOutcome::broken);
  CHECK(try_relation(scaled, with_edges("a word", 0.01, 0.002)).outcome == RelationOutcome::broken);
  const auto ended = [&](const RollingScene& scene) {
    if (scene_json(scene) == scene_json(scaled.one)) return dimensional(scene, 1);
    RollingSolution solution;
    solution.status = Status::not_converged;
    solution.reason = "not solved within the time_limit of 1 s of processor time";
    return solution;
  };
  CHECK(try_relation(scaled, ended).outcome == RelationOutcome::one_sided);
}

TEST_CASE("rollres stability --relations leaves a table and both scenes of what is broken", "[studies][relations]") {
  const TemporaryDirectory folder;
  const std::string out = (folder.path / "new").string();
  const auto run = [&](const Evaluate& evaluate, const std::vector<std::string>& more) {
    std::vector<std::string> words{"stability", "--out",  out, "--relations", "2", "--indenter",
                                   "cylinder",  "--jobs", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return run_rollres(words, evaluate);
  };
  // Numbers of its own units in the load contradict scaling alone.
  const ProgramRun bad = run([](const RollingScene& scene) { return closed_form(scene); }, {"--json"});
  CHECK(bad.status == ExitStatus::no_answer);
  const auto object = nlohmann::json::parse(bad.out);
  REQUIRE(object["results"].size() == relations().size());
  REQUIRE(object["broken"].size() >= 4);
  const RollingScene again = read_scene(object["broken"][0].get<std::string>());
  CHECK(again.indenter == Indenter::cylinder);
  const std::string csv = file_text(fs::path(out) / "relations.csv");
  CHECK(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')) == 1 + 2 * relations().size());
  CHECK_THAT(csv, Contains("speed and memories"));

  const ProgramRun one = run(closed_form, {"--only", "cut in two,long period", "--json"});
  CHECK(nlohmann::json::parse(one.out)["results"].size() == 2);
  CHECK_THAT(run(closed_form, {"--only", "cut in to"}).err,
             Contains("no relation has this name; there are cut in two"));
  const ProgramRun refused = run(solve, {"--scenes", "3"});
  CHECK(refused.status == ExitStatus::wrong_input);
}
