#pragma once

/// Work in child processes, so that a piece that crashes or hangs costs itself and nothing else.

#include <atomic>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>

namespace rollres {

/// How a piece of work ended.
struct PieceEnd {
  std::size_t piece = 0;
  std::string answer = {};   ///< what the work returned, if its process lived
  std::string death = {};    ///< how its process died, in words; empty if it lived
  bool out_of_time = false;  ///< it was ended for taking longer than the limit
  double seconds = 0;        ///< [s], as seen from outside
};

struct ForkedWork {
  std::size_t pieces = 0;
  int jobs = 0;                                                 ///< processes at a time; 0: one for each core
  double time_limit = std::numeric_limits<double>::infinity();  ///< for one piece [s]
  std::function<std::string(std::size_t)> work = {};            ///< called in a child process
  std::function<void(PieceEnd)> done = {};                      ///< called in this process, in the order of the ends
  std::function<void()> tick = {};                              ///< called in this process ten times a second
  const std::atomic<bool>* stop =
      nullptr;  ///< set from outside: end the children at once; what they had in hand is lost
};

/// Hands out pieces 0, 1, ... until all are done. The calling process must have no other threads.
/// @throws std::runtime_error if no process can be started
void run_forked(const ForkedWork& work);

}  // namespace rollres
