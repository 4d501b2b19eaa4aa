#pragma once

/// Points of a sweep whose solution ended the program, so that the next start does not end at them again.
///
/// A fatal signal (a crash, not the end by the user) in a thread that solves a point notes the point's key beside the
/// database, in FILE.ended, before the program ends as it would have. When the system ends the program for want of
/// memory (SIGKILL, proc(5): oom_kill in /proc/vmstat), a small process that waits for that end notes all points in
/// work.

#include <signal.h>

#include <filesystem>
#include <string>
#include <vector>

namespace rollres {

/// Notes such ends while it lives; one at a time in a program.
class FatalSignalNotes {
 public:
  /// @param counters  the system's, with a line "oom_kill N"; if it has none, SIGKILL is never noted
  explicit FatalSignalNotes(const std::filesystem::path& database,
                            const std::filesystem::path& counters = "/proc/vmstat");
  ~FatalSignalNotes();
  FatalSignalNotes(const FatalSignalNotes&) = delete;
  FatalSignalNotes& operator=(const FatalSignalNotes&) = delete;

 private:
  int watcher_ = -1;  ///< the process that waits
};

/// Says which point this thread solves while it lives.
class PointInWork {
 public:
  explicit PointInWork(const std::string& key);
  ~PointInWork();
  PointInWork(const PointInWork&) = delete;
  PointInWork& operator=(const PointInWork&) = delete;

 private:
  struct PointSlot* slot_;
  stack_t stack_before_{};  ///< the thread's own for signal handlers
};

struct EndedPoint {
  std::string key;
  int signal = 0;
};

/// What was noted beside a database. @throws std::runtime_error if that is no regular file
std::vector<EndedPoint> ended_points(const std::filesystem::path& database);

/// Puts these in its place.
void keep_ended_points(const std::filesystem::path& database, const std::vector<EndedPoint>& points);

}  // namespace rollres
