#include "studies/run/stop_signal.hpp"

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <iterator>
#include <string_view>

#include "db/file/temporary_folder.hpp"

namespace rollres {

namespace {

std::atomic<bool> wish_to_stop = false;
std::atomic<std::int64_t> since = 0;  // [ms]
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

/// Within it a second signal is the first one's twin: timeout and shells send theirs to a process and to its group.
constexpr std::int64_t twin_within = 300;  // [ms]

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
  using namespace std::chrono;
  const std::int64_t now = duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
  if (!wish_to_stop.exchange(true)) {
    since = now;
  } else if (now - since > twin_within) {
    if (says_so) return end_in_words(signal);
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
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
