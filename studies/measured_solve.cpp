#include "studies/measured_solve.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <ctime>
#include <new>
#include <stdexcept>
#include <system_error>

namespace rollres {

namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Values as bytes, for a process that runs the same program.
struct Packer {
  std::string bytes;

  template <class Value>
  void operator()(const Value& value) {
    if constexpr (std::is_trivially_copyable_v<Value>) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    } else {
      (*this)(value.size());
      for (const auto& part : value) (*this)(part);
    }
  }
};

struct Unpacker {
  const std::string& bytes;
  std::size_t at = 0;

  template <class Value>
  void operator()(Value& value) {
    if constexpr (std::is_trivially_copyable_v<Value>) {
      if (bytes.size() - at < sizeof value) throw std::out_of_range("cut short");
      std::memcpy(&value, bytes.data() + at, sizeof value);
      at += sizeof value;
    } else {
      std::size_t size = 0;
      (*this)(size);
      if (size > bytes.size() - at) throw std::out_of_range("cut short");
      value.resize(size);
      for (auto& part : value) (*this)(part);
    }
  }
};

/// Everything of a measurement that the child knows.
template <class Measured, class Visitor>
void visit_measurement(Measured& measured, Visitor& visitor) {
  visitor(measured.failure);
  visitor(measured.seconds);
  visitor(measured.processor_seconds);
  visit_outputs(measured.solution, [&](const Quantity&, auto& value) { visitor(value); });
}

Measurement timed(const Evaluate& evaluate, const RollingScene& scene) {
  Measurement measured;
  const double processor_begin = processor_time();
  const Clock::time_point begin = Clock::now();
  try {
    measured.solution = evaluate(scene);
  } catch (const std::bad_alloc&) {
    measured.failure = "out of memory";
  } catch (const std::exception& error) {
    measured.failure = error.what();
  } catch (...) {
    measured.failure = "an unknown error";
  }
  measured.seconds = since(begin);
  measured.processor_seconds = processor_time() - processor_begin;
  return measured;
}

void keep_to_one_core() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<std::size_t>(std::max(0, sched_getcpu())), &cores);
  sched_setaffinity(0, sizeof cores, &cores);  // refused: the solution may use what the machine gives
}

[[noreturn]] void solve_and_exit(const Evaluate& evaluate, const RollingScene& scene, int out, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it ended before it could be tied to
  keep_to_one_core();
  const Measurement measured = timed(evaluate, scene);
  Packer packer;
  visit_measurement(measured, packer);
  for (std::size_t sent = 0; sent < packer.bytes.size();) {
    const ssize_t count = write(out, packer.bytes.data() + sent, packer.bytes.size() - sent);
    if (count < 0 && errno != EINTR) _exit(1);
    sent += static_cast<std::size_t>(std::max<ssize_t>(0, count));
  }
  _exit(0);
}

/// Reads until the other end closes; false if that takes longer than the limit.
bool read_all(int descriptor, double seconds_limit, std::string& bytes) {
  const Clock::time_point begin = Clock::now();
  std::array<char, 4096> part;
  for (;;) {
    const double left = seconds_limit - since(begin);
    if (left <= 0) return false;
    constexpr double longest_wait = 1e5;  // poll counts milliseconds in an int
    pollfd wanted{descriptor, POLLIN, 0};
    if (poll(&wanted, 1, static_cast<int>(std::ceil(1e3 * std::min(left, longest_wait)))) <= 0) continue;
    const ssize_t count = read(descriptor, part.data(), part.size());
    if (count == 0) return true;
    if (count > 0) bytes.append(part.data(), static_cast<std::size_t>(count));
  }
}

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), std::string("a process for a measurement: ") + what);
}

Measurement measured_apart(const Evaluate& evaluate, const RollingScene& scene, double seconds_limit) {
  std::array<int, 2> ends;
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail("pipe");
  const pid_t parent = getpid(), child = fork();
  if (child < 0) {
    const int error = errno;
    for (const int end : ends) close(end);
    errno = error;
    fail("fork");
  }
  if (child == 0) {
    close(ends[0]);
    solve_and_exit(evaluate, scene, ends[1], parent);
  }
  close(ends[1]);
  std::string bytes;
  const bool ended = read_all(ends[0], seconds_limit, bytes);
  close(ends[0]);
  if (!ended) kill(child, SIGKILL);
  int state = 0;
  rusage usage{};
  while (wait4(child, &state, 0, &usage) < 0 && errno == EINTR) {
  }
  Measurement measured;
  if (!ended) {
    measured.stopped = true;
    measured.failure = "stopped at the limit";
  } else if (WIFSIGNALED(state)) {
    const char* name = sigabbrev_np(WTERMSIG(state));
    measured.failure = "crashed: SIG" + std::string(name ? name : "?");
  } else {
    try {
      Unpacker unpacker{bytes};
      visit_measurement(measured, unpacker);
    } catch (const std::out_of_range&) {
      measured = {};
      measured.failure = "ended without an answer, exit status " + std::to_string(WEXITSTATUS(state));
    }
  }
  measured.peak_memory = 1024.0 * static_cast<double>(usage.ru_maxrss);
  return measured;
}

}  // namespace

Measurement measured_solve(const Evaluate& evaluate, const RollingScene& scene, double seconds_limit) {
  const auto idle = [](const RollingScene&) { return RollingSolution(); };
  const double idle_memory = measured_apart(idle, scene, std::numeric_limits<double>::infinity()).peak_memory;
  Measurement measured = measured_apart(evaluate, scene, seconds_limit);
  measured.peak_memory = std::max(0.0, measured.peak_memory - idle_memory);
  return measured;
}

}  // namespace rollres
