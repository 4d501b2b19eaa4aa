#include "studies/run/measured_solve.hpp"

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

TEST_CASE("a solution comes back whole from the process that found it", "[studies][accuracy]") {
  const Evaluate evaluate = [](const RollingScene& scene) {
    RollingSolution solution = closed_form(scene);
    solution.status = Status::no_steady_state;
    solution.reason = "needs μ = 0.3";
    solution.model = std::string(100000, 'm');  // more than a pipe holds
    solution.warnings = {"one", "", "three"};
    return solution;
  };
  const RollingScene scene = plain_scene();
  const Measurement measured = measured_solve(evaluate, scene);
  const RollingSolution expected = evaluate(scene);
  CHECK(measured.failure.empty());
  CHECK(measured.seconds > 0);
  CHECK(measured.processor_seconds >= 0);
  CHECK(measured.solution.rolling_resistance == expected.rolling_resistance);
  CHECK(std::isnan(measured.solution.half_width));
  CHECK(measured.solution.contact_nodes == expected.contact_nodes);
  CHECK(measured.solution.status == Status::no_steady_state);
  CHECK(measured.solution.reason == expected.reason);
  CHECK(measured.solution.model == expected.model);
  CHECK(measured.solution.warnings == expected.warnings);
}

TEST_CASE("the peak memory of a solution is what it touched, not what was there before", "[studies][accuracy]") {
  const std::vector<char> before(50'000'000, 'b');
  const Evaluate hungry = [&](const RollingScene& scene) {
    std::vector<char> eaten(64'000'000, 'e');
    RollingSolution solution = closed_form(scene);
    solution.iterations = eaten[eaten.size() / 2] + before[7];
    return solution;
  };
  const double peak = measured_solve(hungry, plain_scene()).peak_memory;
  CHECK(peak > 63e6);
  CHECK(peak < 90e6);
}

TEST_CASE("no solution is warmed by an earlier one", "[studies][accuracy]") {
  static int cache = 0;
  const Evaluate remembering = [](const RollingScene& scene) {
    RollingSolution solution = closed_form(scene);
    solution.iterations = ++cache;
    return solution;
  };
  CHECK(measured_solve(remembering, plain_scene()).solution.iterations == 1);
  CHECK(measured_solve(remembering, plain_scene()).solution.iterations == 1);
}

TEST_CASE("exceptions, crashes, exits and endless solutions are findings", "[studies][accuracy]") {
  const auto failure_of = [](const Evaluate& evaluate, double limit) {
    return measured_solve(evaluate, plain_scene(), limit).failure;
  };
  constexpr double long_enough = 60;
  CHECK(failure_of([](const RollingScene&) -> RollingSolution { throw std::runtime_error("singular"); }, long_enough) ==
        "singular");
  CHECK(failure_of([](const RollingScene&) -> RollingSolution { throw std::bad_alloc(); }, long_enough) ==
        "out of memory");
  CHECK(failure_of([](const RollingScene&) -> RollingSolution { throw 42; }, long_enough) == "an unknown error");
  CHECK(failure_of(
            [](const RollingScene&) -> RollingSolution {
              std::raise(SIGKILL);
              std::abort();
            },
            long_enough) == "the process was ended by signal 9 (Killed)");
  CHECK(failure_of([](const RollingScene&) -> RollingSolution { std::_Exit(7); }, long_enough) ==
        "the process ended with exit status 7");
  const Evaluate endless = [](const RollingScene& scene) {
    std::this_thread::sleep_for(std::chrono::seconds(30));
    return closed_form(scene);
  };
  const Measurement stopped = measured_solve(endless, plain_scene(), 0.02);
  CHECK(stopped.stopped);
  CHECK(std::isnan(stopped.seconds));
}
