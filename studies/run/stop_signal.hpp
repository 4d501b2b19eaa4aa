#pragma once

/// Ctrl-C (SIGINT) and SIGTERM as a wish to stop.

#include <atomic>

namespace rollres {

/// While it lives, the first of these signals sets `requested`; the second ends the program at once, as usual.
/// Afterwards they are as they were.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  static const std::atomic<bool>& requested();
};

}  // namespace rollres
