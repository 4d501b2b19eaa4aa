#pragma once

/// Points of a sweep whose solution ended the program, so that the next start does not end at them again.
///
/// A fatal signal (a crash, not the end by the user or the system) in a thread that solves a point notes the point's
/// key beside the database, in FILE.ended, before the program ends as it would have.

#include <filesystem>
#include <string>
#include <vector>

namespace rollres {

/// Notes fatal signals of points while it lives; one at a time in a program.
class FatalSignalNotes {
 public:
  explicit FatalSignalNotes(const std::filesystem::path& database);
  ~FatalSignalNotes();
  FatalSignalNotes(const FatalSignalNotes&) = delete;
  FatalSignalNotes& operator=(const FatalSignalNotes&) = delete;
};

/// Says which point this thread solves while it lives.
class PointInWork {
 public:
  explicit PointInWork(const std::string& key);
  ~PointInWork();
  PointInWork(const PointInWork&) = delete;
  PointInWork& operator=(const PointInWork&) = delete;
};

struct EndedPoint {
  std::string key;
  int signal = 0;
};

/// What was noted beside a database.
std::vector<EndedPoint> ended_points(const std::filesystem::path& database);

/// Forgets it, once it is stored.
void forget_ended_points(const std::filesystem::path& database);

}  // namespace rollres
