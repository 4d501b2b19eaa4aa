#pragma once

/// Which point is solved next, when several threads and perhaps several processes work on the same points.

#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rollres {

/// Hands out points in order. Processes that share a database do not talk to each other: each looks whether a point has
/// been stored meanwhile before it hands it out, and goes to the middle of the longest stretch that is still open as
/// soon as it meets the work of another, so that two of them soon walk apart. May be used by several threads.
class WorkList {
 public:
  /// @param keys     one for each point; equal keys are one piece of work; must outlive the list
  /// @param at_start whether the answer to each is known already
  /// @param known    tells whether the answer to a key is stored meanwhile; called by one thread at a time
  WorkList(std::span<const std::string> keys, const std::vector<bool>& at_start,
           std::function<bool(const std::string&)> known);

  /// Number of pieces of work that are not handed out, nor known to be stored.
  std::size_t open() const;
  /// Position of the next point in `keys`, or nothing if none is left.
  std::optional<std::size_t> next();
  /// Somebody else is working where we are: go on elsewhere.
  void move_away();

 private:
  void look_again();

  std::span<const std::string> keys_;
  std::function<bool(const std::string&)> known_;
  std::vector<char> is_open_;
  std::size_t open_ = 0;
  std::size_t cursor_ = 0;
  mutable std::mutex mutex_;
};

}  // namespace rollres
