#pragma once

/// Ctrl-C (SIGINT) and SIGTERM as a wish to stop.

#include <atomic>

namespace rollres {

/// From now on a signal that no StopSignal takes ends the program with the line "rollres: interrupted" (or
/// "terminated") on standard error, and with the status that signals give: 130, 143. One that is ignored stays so.
void end_in_words_at_signals();

/// While it lives, the first of these signals sets `requested`; a second one, some tenths of a second later or more,
/// ends the program at once, as usual. Afterwards they are as they were.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  static const std::atomic<bool>& requested();
};

}  // namespace rollres
