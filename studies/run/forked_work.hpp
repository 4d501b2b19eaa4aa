#pragma once

/// Work in child processes, so that a piece that crashes or hangs costs itself and nothing else.

#include <atomic>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "studies/run/progress.hpp"

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
  /// Called in this process, in the order of the ends; whether it went well.
  std::function<bool(const PieceEnd&)> done = {};
  std::function<void(const SweepProgress&)> report = {};  ///< called in this process ten times a second
  const std::atomic<bool>* stop =
      nullptr;  ///< set from outside: end the children at once; what they had in hand is lost
};

/// Values as bytes, for a process that runs the same program: what can be copied bit by bit, and lists and texts of it.
struct Packer {
  std::string bytes = {};

  template <class Value>
  void operator()(const Value& value) {
    if constexpr (std::is_trivially_copyable_v<Value>) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    } else {
      (*this)(value.size());
      for (const auto& part : value) (*this)(part);
    }
  }
};

/// Reads them, in the order in which they were packed.
struct Unpacker {
  const std::string& bytes;
  std::size_t at = 0;

  template <class Value>
  void operator()(Value& value) {
    if constexpr (std::is_trivially_copyable_v<Value>) {
      std::memcpy(&value, bytes.data() + at, sizeof value);
      at += sizeof value;
    } else {
      std::size_t size = 0;
      (*this)(size);
      value.resize(size);
      for (auto& part : value) (*this)(part);
    }
  }
};

/// Hands out pieces 0, 1, ... until all are done. The calling process must have no other threads.
/// @throws std::runtime_error if no process can be started
void run_forked(const ForkedWork& work);

/// The trials that ended, in their order, each tried in a child process: `tell(trial, pack)` there packs its answer,
/// `take(trial, end)` puts it into the trial and returns whether it went well. @throws likewise
template <class Trial, class Tell, class Take>
std::vector<Trial> try_forked(ForkedWork work, std::vector<Trial> trials, const Tell& tell, const Take& take) {
  std::vector<char> ended(trials.size(), 0);
  work.work = [&](std::size_t piece) {
    Packer pack;
    tell(std::as_const(trials[piece]), pack);
    return pack.bytes;
  };
  work.done = [&](const PieceEnd& end) {
    ended[end.piece] = 1;
    return take(trials[end.piece], end);
  };
  run_forked(work);
  std::size_t place = 0;
  std::erase_if(trials, [&](const Trial&) { return !ended[place++]; });
  return trials;
}

}  // namespace rollres
