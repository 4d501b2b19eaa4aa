#include "studies/run/stop_signal.hpp"

#include <csignal>
#include <iterator>

namespace rollres {

namespace {

std::atomic<bool> wish_to_stop = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

constexpr int signals[] = {SIGINT, SIGTERM};
void (*before[std::size(signals)])(int) = {};  // who had them

extern "C" void note_wish(int signal) {
  wish_to_stop = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

StopSignal::StopSignal() {
  wish_to_stop = false;
  for (std::size_t i = 0; i < std::size(signals); ++i) before[i] = std::signal(signals[i], note_wish);
}

StopSignal::~StopSignal() {
  for (std::size_t i = 0; i < std::size(signals); ++i) std::signal(signals[i], before[i]);
}

const std::atomic<bool>& StopSignal::requested() { return wish_to_stop; }

}  // namespace rollres
