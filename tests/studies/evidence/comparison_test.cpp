#include "studies/evidence/comparison.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "studies/run/sweep.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers command_compare, too.

using namespace rollres;

namespace {

/// By `newton` one part in a thousand more at speed 2, one in ten thousand elsewhere; at speed 4 no answer.
RollingSolution by_method(const RollingScene& scene) {
  RollingSolution solution = closed_form(scene);
  solution.approach = 0.001;
  if (scene.method != Method::newton) return solution;
  solution.rolling_resistance *= std::lround(scene.speed) == 2 ? 1.001 : 1.0001;
  if (std::lround(scene.speed) == 4) throw std::runtime_error("singular matrix");
  return solution;
}

Study study_of(const std::string& name, Method method, std::vector<double> speeds, std::vector<double> loads) {
  Study study{.name = name, .base = plain_scene(speeds.front(), loads.front()), .axes = {{"speed"}, {"load"}}};
  study.base.method = method;
  study.axes[0].values = std::move(speeds);
  study.axes[1].values = std::move(loads);
  return study;
}

class Compared {
 public:
  Compared() {
    run_sweep(study_of("fine", Method::active_set, {1, 2, 3, 4}, {1e4, 2e4}), by_method, file());
    run_sweep(study_of("coarse", Method::newton, {2, 3, 4, 5}, {2e4, 1e4}), by_method, file());
    run_sweep(study_of("elsewhere", Method::newton, {6, 7}, {1e4}), by_method, file());
  }
  std::filesystem::path file() const { return folder_ / "a.db"; }
  StudyComparison run(const std::string& first, const std::string& second,
                      const ComparisonOptions& options = {}) const {
    ResultStore store(file(), Access::read);
    return compare_studies(store, first, store, second, options);
  }
  ProgramRun command(std::vector<std::string> words) const {
    words.insert(words.begin(), {"compare", "--db", file().string()});
    return run_rollres(words, closed_form);
  }

 private:
  TemporaryDirectory folder_;
};

}  // namespace

TEST_CASE("points of two studies match by their inputs, but for what the studies compare", "[studies][compare]") {
  const StudyComparison found = Compared().run("fine", "coarse");
  REQUIRE(found.compared.size() == 1);
  CHECK(found.compared[0].key == "method");
  CHECK(found.compared[0].first == Cell(std::string("active_set")));
  CHECK(found.compared[0].second == Cell(std::string("newton")));
  CHECK(found.axes == std::vector<std::string>{"speed", "load"});
  CHECK(found.matched == 6);
  CHECK(found.only_first == 2);
  CHECK(found.only_second == 2);
  CHECK(found.half_answered == 2);
  CHECK(found.unanswered == 0);
  REQUIRE(found.differences.size() == 4);
  for (int i = 0; i < 4; ++i) {
    const PointDifference& one = found.differences[static_cast<std::size_t>(i)];
    CHECK(one.inputs == std::vector<Cell>{i < 2 ? 2.0 : 3.0, i % 2 == 0 ? 1e4 : 2e4});
    CHECK(one.relative == Approx(i < 2 ? 1e-3 : 1e-4).epsilon(1e-9));  // rounding of 1.0001 - 1
  }
  REQUIRE(found.outputs.size() == 1);
  CHECK(found.outputs[0].points == 4);
  CHECK(found.outputs[0].largest == Approx(1e-3).epsilon(1e-9));
  CHECK(found.outputs[0].rms == Approx(std::sqrt((1e-6 + 1e-8) / 2)).epsilon(1e-9));
  CHECK_FALSE(found.within(1));  // two points have one answer only
}

TEST_CASE("comparing is symmetric but for sign and reference, and a study agrees with itself", "[studies][compare]") {
  const Compared compared;
  const StudyComparison there = compared.run("fine", "coarse"), back = compared.run("coarse", "fine");
  REQUIRE(there.differences.size() == back.differences.size());
  for (std::size_t i = 0; i < back.differences.size(); ++i)
    CHECK(1 + there.differences[i].relative == Approx(1 / (1 + back.differences[i].relative)).epsilon(1e-14));
  const StudyComparison same = compared.run("fine", "fine");
  CHECK(same.compared.empty());
  CHECK(same.matched == 8);
  CHECK(same.within(0));
}

TEST_CASE("ignored inputs may differ, as long as the points can still be told apart", "[studies][compare]") {
  const Compared compared;
  const StudyComparison apart = compared.run("coarse", "elsewhere", {.ignored = {}});
  CHECK(apart.matched == 0);
  CHECK_FALSE(apart.within(1));
  CHECK(message_of([&] { compared.run("coarse", "elsewhere", {.ignored = {"speed"}}); }) ==
        compared.file().string() + ": coarse: points 1 and 3 differ only in inputs that are ignored");
}

TEST_CASE("outputs without a meaning are left out, one that is there only once differs infinitely",
          "[studies][compare]") {
  const TemporaryDirectory folder;
  for (const std::string name : {"a", "b"})
    run_sweep(
        study_of("study", Method::newton, {1, 2}, {1e4}),
        [&](const RollingScene& scene) {
          RollingSolution solution = closed_form(scene);
          if (name == "b" && scene.speed == 1) solution.approach = 1;
          return solution;
        },
        folder / name);
  ResultStore a(folder / "a", Access::read), b(folder / "b", Access::read);
  const StudyComparison found =
      compare_studies(a, "study", b, "study", {.outputs = {"half_width", "approach", "contact_nodes"}});
  CHECK(found.outputs[0].points == 0);
  CHECK(found.outputs[1].points == 1);
  CHECK(std::isinf(found.outputs[1].largest));
  CHECK(found.outputs[2].points == 2);
  CHECK(found.differences.size() == 3);
  CHECK_FALSE(found.within(1e9));
}

TEST_CASE("compare prints the worst points first and tells by its exit status whether all are within",
          "[studies][compare]") {
  const Compared compared;
  const ProgramRun text = compared.command({"fine", "coarse", "--limit", "1"});
  CHECK(text.status == 0);
  CHECK(text.out ==
        "method: active_set against newton\n"
        "6 points match, 2 are only in the first study, 2 only in the second\n"
        "2 have an answer in one study only\n"
        "rolling_resistance: relative difference at most 0.001, rms 0.000711, at 4 points\n\n"
        "position  speed  load   output              first  second  difference\n"
        "       3  2 m/s  10000  rolling_resistance     40   40.04       0.001\n");
  CHECK(text.err == "3 smaller differences are not shown; --limit sets how many are\n");

  CHECK(compared.command({"fine", "coarse", "--within", "1"}).status == ExitStatus::no_answer);
  CHECK(compared.command({"fine", "fine", "--within", "0"}).status == 0);
  CHECK(compared.command({"fine", "--with", compared.file().string(), "--within", "0"}).status == 0);
  CHECK(compared.command({"coarse", "elsewhere"}).status == ExitStatus::no_answer);

  const ProgramRun csv = compared.command({"fine", "coarse", "--format", "csv", "--outputs", "approach, load"});
  CHECK(csv.out.starts_with("position,speed,load,output,first,second,difference\n3,2,10000,approach,0.001,0.001,0\n"));
  const auto json = nlohmann::json::parse(compared.command({"fine", "coarse", "--format", "json"}).out);
  CHECK(json["compared"][0]["key"] == "method");
  CHECK(json["differences"].size() == 4);
  CHECK(json["differences"][0]["speed"] == 2);
  CHECK(json["half_answered"] == 2);
}

TEST_CASE("the help of compare says that it takes several studies", "[studies][compare]") {
  CHECK(run_rollres({"compare", "--help"}, closed_form).out.find(" studies...\n") != std::string::npos);
}

TEST_CASE("compare refuses in one line what it cannot do", "[studies][compare]") {
  const Compared compared;
  const std::string file = compared.file().string();
  const std::vector<std::pair<std::vector<std::string>, std::string>> refusals{
      {{"fine", "corse"}, file + ": study = corse: unknown study; did you mean coarse?"},
      {{"fine"}, "study = fine: needs a second study, or a second database with --with"},
      {{"fine", "coarse", "--ignore", "sped"}, "ignore = sped: unknown input; did you mean speed?"},
      {{"fine", "coarse", "--outputs", "aproach"}, "output = aproach: unknown output; did you mean approach?"},
      {{"fine", "coarse", "--outputs", "status"}, "output = status: must be a number"},
      {{"fine", "coarse", "--within", "-1"}, ""},
      {{"fine", "coarse", "--format", "xml"}, ""},
      {{"fine", "coarse", "elsewher"}, file + ": study = elsewher: unknown study"}};
  for (const auto& [words, message] : refusals) {
    const ProgramRun run = compared.command(words);
    INFO(message + " / " + run.err);
    CHECK(run.status == ExitStatus::wrong_input);
    CHECK(run.err.starts_with("rollres: " + message));
    CHECK(run.out.empty());
  }
}
