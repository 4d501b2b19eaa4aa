#include "studies/run/measured_solve.hpp"

#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <new>

#include "studies/run/forked_work.hpp"

namespace rollres {

namespace {

using Clock = std::chrono::steady_clock;

double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Everything of a measurement that the child knows.
template <class Measured, class Visitor>
void visit_measurement(Measured&& measured, Visitor&& visitor) {
  visitor(measured.failure);
  visitor(measured.seconds);
  visitor(measured.processor_seconds);
  visitor(measured.peak_memory);
  visit_outputs(measured.solution, [&](const Quantity&, auto& value) { visitor(value); });
}

void keep_to_one_core() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<std::size_t>(std::max(0, sched_getcpu())), &cores);
  sched_setaffinity(0, sizeof cores, &cores);  // refused: the solution may use what the machine gives
}

/// The most that was resident at a time since this process was forked [B].
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

Measurement measured_here(const Evaluate& evaluate, RollingScene scene, double seconds_limit) {
  if (!scene.time_limit) scene.time_limit = std::min(seconds_limit, 1e9);
  keep_to_one_core();
  Measurement measured;
  const double memory_before = peak_memory(), processor_begin = processor_time();
  const Clock::time_point begin = Clock::now();
  try {
    measured.solution = evaluate(scene);
  } catch (const std::bad_alloc&) {
    measured.failure = "out of memory";
  } catch (const std::exception& error) {
    measured.failure = error.what();
  } catch (...) {
    measured.failure = "an unknown error";
  }
  measured.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  measured.processor_seconds = processor_time() - processor_begin;
  measured.peak_memory = peak_memory() - memory_before;
  return measured;
}

}  // namespace

Measurement measured_solve(const Evaluate& evaluate, const RollingScene& scene, double seconds_limit) {
  Measurement measured;
  ForkedWork work{.pieces = 1, .jobs = 1, .time_limit = seconds_limit};
  work.work = [&](std::size_t) {
    Packer packer;
    visit_measurement(measured_here(evaluate, scene, seconds_limit), packer);
    return packer.bytes;
  };
  work.done = [&](const PieceEnd& end) {
    measured.stopped = end.out_of_time;
    if (end.out_of_time)
      measured.failure = "stopped at the limit";
    else if (!end.death.empty())
      measured.failure = end.death;
    else
      visit_measurement(measured, Unpacker{end.answer});
    return measured.failure.empty();
  };
  run_forked(work);
  return measured;
}

}  // namespace rollres
