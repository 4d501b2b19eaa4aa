#pragma once

/// Independent pieces of work on several threads.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "core/numerics/cores.hpp"
#include "core/numerics/threads.hpp"

namespace rollres {

/// Jobs side by side for so many pieces of work. `wanted` is what is asked for; 0: one for each usable core.
inline std::size_t jobs_for(int wanted, std::size_t pieces) {
  return std::min(static_cast<std::size_t>(wanted > 0 ? wanted : usable_cores()), pieces);
}

/// Cores that each of so many jobs may take.
inline int cores_for_each(std::size_t jobs) {
  return std::max(1, usable_cores() / static_cast<int>(std::max<std::size_t>(1, jobs)));
}

/// Calls work(0) to work(pieces - 1), each once and in any order, and returns when all have ended. The first exception
/// is thrown again; what was not begun by then is left out. Solutions share the cores.
template <class Work>
void for_each_piece(std::size_t pieces, int wanted_jobs, Work work) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr first_error;
  const auto run = [&] {
    for (std::size_t piece; (piece = next++) < pieces;) try {
        work(piece);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!first_error) first_error = std::current_exception();
        next = pieces;
      }
  };
  const std::size_t jobs = jobs_for(wanted_jobs, pieces);
  if (jobs > 1) {
    std::vector<std::jthread> threads;
    for (std::size_t job = 0; job < jobs; ++job)
      threads.emplace_back([&] {
        limit_threads(cores_for_each(jobs));
        run();
      });
  } else {
    run();
  }
  if (first_error) std::rethrow_exception(first_error);
}

}  // namespace rollres
