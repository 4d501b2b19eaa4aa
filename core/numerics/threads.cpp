#include "core/numerics/threads.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <limits>

#include "core/numerics/cores.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

thread_local int most_threads = std::numeric_limits<int>::max();

}  // namespace

void limit_threads(int count) { most_threads = count; }

int threads_for(double points) {
  constexpr double worth_sharing = 2e5;
  return points < worth_sharing ? 1 : std::min({most_threads, usable_cores(), tbb::this_task_arena::max_concurrency()});
}

void share_out(int count, int threads, const std::function<void(int index, int slot)>& work) {
  if (threads <= 1) {
    for (int index = 0; index < count; ++index) work(index, 0);
    return;
  }
  tbb::task_arena arena(threads);
  SolutionLimits* const limits = limits_of_this_thread();
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<int>(0, count), [&](const tbb::blocked_range<int>& range) {
      const LimitsOfAnother shared(limits);
      const int slot = tbb::this_task_arena::current_thread_index();
      for (int index = range.begin(); index < range.end(); ++index) work(index, slot);
    });
  });
}

}  // namespace rollres
