#include "studies/run/stop_signal.hpp"

#include <unistd.h>

#include <csignal>
#include <iterator>
#include <string_view>

#include "db/file/temporary_folder.hpp"

namespace rollres {

namespace {

std::atomic<bool> wish_to_stop = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

constexpr int signals[] = {SIGINT, SIGTERM};
void (*before[std::size(signals)])(int) = {};  // who had them

std::atomic<bool> says_so = false;  // that a signal ends the program

/// Ends the program as the signal does by itself, after a line on standard error.
extern "C" void end_in_words(int signal) {
  const std::string_view line = signal == SIGINT ? "rollres: interrupted\n" : "rollres: terminated\n";
  if (::write(STDERR_FILENO, line.data(), line.size()) < 0) {
  }  // whoever listened has gone
  remove_temporary_folders();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

extern "C" void note_wish(int signal) {
  wish_to_stop = true;
  std::signal(signal, says_so ? end_in_words : SIG_DFL);
}

}  // namespace

void end_in_words_at_signals() {
  says_so = true;
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of writing, told as others are
  for (const int signal : signals)
    if (std::signal(signal, end_in_words) == SIG_IGN) std::signal(signal, SIG_IGN);
}

StopSignal::StopSignal() {
  wish_to_stop = false;
  for (std::size_t i = 0; i < std::size(signals); ++i) before[i] = std::signal(signals[i], note_wish);
}

StopSignal::~StopSignal() {
  for (std::size_t i = 0; i < std::size(signals); ++i) std::signal(signals[i], before[i]);
}

const std::atomic<bool>& StopSignal::requested() { return wish_to_stop; }

}  // namespace rollres
