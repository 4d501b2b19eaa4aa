#include "studies/run/stop_signal.hpp"

#include <csignal>

namespace rollres {

namespace {

std::atomic<bool> wish_to_stop = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

constexpr int signals[] = {SIGINT, SIGTERM};

extern "C" void note_wish(int signal) {
  wish_to_stop = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

StopSignal::StopSignal() {
  wish_to_stop = false;
  for (const int signal : signals) std::signal(signal, note_wish);
}

StopSignal::~StopSignal() {
  for (const int signal : signals) std::signal(signal, SIG_DFL);
}

const std::atomic<bool>& StopSignal::requested() { return wish_to_stop; }

}  // namespace rollres
