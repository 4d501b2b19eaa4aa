#include "studies/run/probed_cost.hpp"

#include <set>
#include <thread>

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

Study probed_study(const std::string& speeds) {
  const TemporaryDirectory folder;
  return read_study(
      folder
          .write("study.json", R"({"study": "probed", "scene": {"radius": 0.1, "layer_thickness": "infinite",
    "static_shear_modulus": 1e6, "material": "elastic", "load": 1}, "axes": {"speed": )" +
                                   speeds + "}}")
          .string());
}

}  // namespace

TEST_CASE("points spread over the whole study tell what one takes", "[studies][run][probed_cost]") {
  std::set<double> speeds;
  const Evaluate evaluate = [&](const RollingScene& scene) {
    speeds.insert(scene.speed);
    std::this_thread::sleep_for(std::chrono::microseconds(scene.speed > 500 ? 2000 : 0));
    return closed_form(scene);
  };
  const ProbedCost cost = probed_cost(probed_study(R"({"from": 1, "to": 1000, "points": 1000})"), evaluate);
  CHECK(cost.points == 48);
  CHECK(speeds.size() == 48);
  std::size_t fast = 0;
  for (const double speed : speeds) fast += speed > 500 ? 1 : 0;
  CHECK(fast >= 22);
  CHECK(fast <= 26);
  CHECK(cost.seconds_each > 0.0009);
  CHECK(probed_cost(probed_study("[1, 2, 3]"), closed_form).points == 3);
  const Evaluate slow = [](const RollingScene& scene) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return closed_form(scene);
  };
  CHECK(probed_cost(probed_study(R"({"from": 1, "to": 1000, "points": 1000})"), slow, 0.05).points <= 3);
}

TEST_CASE("status tells the time of a study of which nothing is stored from points that it solves",
          "[studies][run][probed_cost]") {
  const TemporaryDirectory folder;
  const std::string study = folder
                                .write("study.json", R"({"study": "probed", "scene": {"radius": 0.1,
    "layer_thickness": "infinite", "static_shear_modulus": 1e6, "material": "elastic", "load": 1},
    "axes": {"speed": [1, 2, 3, 4]}})")
                                .string();
  const ProgramRun run = run_rollres({"status", study}, closed_form);
  CHECK_THAT(run.err, Contains("the time is that of 4 points solved just now"));
  CHECK_THAT(run.out, Contains("4 missing, about "));
}
