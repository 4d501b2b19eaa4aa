#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <system_error>
#include <thread>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "studies/program/commands.hpp"
#include "studies/run/stop_signal.hpp"

namespace {

/// Matrices take up to 128 kB of the stack at a time. Where the system gives little of it (ulimit -s), the program runs
/// on a thread with more, as do the threads that it starts.
int on_enough_stack(const std::function<int()>& program) {
  constexpr std::size_t little = 1 << 20, enough = 8 << 20;
  rlimit stack{};
  if (::getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= little) return program();
#ifdef __GLIBC__
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  ::pthread_attr_setstacksize(&attributes, enough);
  ::pthread_setattr_default_np(&attributes);
  ::pthread_attr_destroy(&attributes);
#endif
  int status = 0;
  try {
    std::thread([&] { status = program(); }).join();
  } catch (const std::system_error&) {  // no thread to be had
    status = program();
  }
  return status;
}

}  // namespace

int main(int count, char** words) {
#ifdef __GLIBC__
  // Matrices of some hundred rows are made and dropped all the time: to hand them back to the system each time costs a
  // seventh of what cylinders with inertia cost. (The library comes to these values itself once it frees 32 MB.)
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
  rollres::end_in_words_at_signals();
  return on_enough_stack([&] {
    return rollres::run_program({words + std::min(count, 1), words + count}, {std::cout, std::cerr, rollres::solve});
  });
}
