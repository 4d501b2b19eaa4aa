#pragma once

/// Independent pieces of work on several threads.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace rollres {

/// Threads for so many pieces of work. `jobs` is what is asked for; 0: one for each core.
inline std::size_t thread_count(int jobs, std::size_t pieces) {
  const std::size_t wanted =
      jobs > 0 ? static_cast<std::size_t>(jobs) : std::max(1u, std::thread::hardware_concurrency());
  return std::min(wanted, pieces);
}

/// Calls work(0) to work(pieces - 1), each once and in any order, and returns when all have ended. The first exception
/// is thrown again; what was not begun by then is left out.
template <class Work>
void for_each_piece(std::size_t pieces, int jobs, Work work) {
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
  {
    std::vector<std::jthread> others;
    for (std::size_t count = thread_count(jobs, pieces); count > 1; --count) others.emplace_back(run);
    run();
  }
  if (first_error) std::rethrow_exception(first_error);
}

}  // namespace rollres
