#include "core/numerics/solution_limits.hpp"

#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/messages/message_text.hpp"

namespace rollres {

namespace {

thread_local SolutionLimits* limits = nullptr;
thread_local Interruptible* interruptible = nullptr;
thread_local double counted_until = 0;  // of this thread's processor time [s]
thread_local double asked_at = 0;       // [s], when require_time last asked how much there was

double seconds_of(clockid_t clock) {
  timespec time{};
  ::clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double seconds_since_last_count() {
  const double now = seconds_of(CLOCK_THREAD_CPUTIME_ID);
  return now - std::exchange(counted_until, now);
}

}  // namespace

double usual_memory_limit() {
  const double machine = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  rlimit process{};
  const bool limited = ::getrlimit(RLIMIT_AS, &process) == 0 && process.rlim_cur != RLIM_INFINITY;
  return std::min({4e9, 0.25 * machine, limited ? 0.5 * static_cast<double>(process.rlim_cur) : machine});
}

SolutionLimits::SolutionLimits(double bytes, double seconds)
    : bytes_(bytes), seconds_(seconds), interruptible_(interruptible), before_(limits) {
  const double seconds_of_others = seconds_since_last_count();
  if (before_) before_->used_ += seconds_of_others;
  limits = this;
  asked_at = 0;
}

SolutionLimits::~SolutionLimits() {
  used_ += seconds_since_last_count();
  if (before_) before_->used_ += used_;
  limits = before_;
}

Interruptible::Interruptible(std::function<bool()> stop)
    : stop_(std::move(stop)), before_(std::exchange(interruptible, this)) {}

Interruptible::~Interruptible() { interruptible = before_; }

SolutionLimits* limits_of_this_thread() { return limits; }

LimitsOfAnother::LimitsOfAnother(SolutionLimits* others) : before_(limits) {
  if (others == before_) return;
  seconds_since_last_count();
  limits = others;
}

LimitsOfAnother::~LimitsOfAnother() {
  if (limits == before_) return;
  const double seconds = seconds_since_last_count();
  if (limits) limits->used_ += seconds;
  limits = before_;
}

void require_time(double more) {
  if (!limits) return;
  // The clock of processor time costs a call of the system; this one does not.
  constexpr double seldom = 0.01;
  const double now = seconds_of(CLOCK_MONOTONIC_COARSE);
  if (now < asked_at + seldom && more < seldom) return;
  asked_at = now;
  if (limits->interruptible_ && limits->interruptible_->stop_()) throw Interrupted();
  const double seconds = seconds_since_last_count();
  const double used = limits->used_ += seconds;
  if (used > limits->seconds_)
    throw BeyondLimits(message_text("not solved within the time_limit of ", limits->seconds_, " s of processor time"));
  if (used + more > limits->seconds_)
    throw BeyondLimits(message_text("needs about ", used + more, " s of processor time, more than the time_limit of ",
                                    limits->seconds_, " s"));
}

void require_memory(double bytes, std::string_view what) {
  if (!limits || bytes <= limits->bytes_) return;
  throw BeyondLimits(
      message_text(what, ": about ", bytes / 1e9, " GB, more than the memory_limit of ", limits->bytes_ / 1e9, " GB"));
}

void require_factorisation(double unknowns, std::string_view what) {
  constexpr double copies = 2, operations_per_second = 3e10;
  require_memory(copies * 8 * unknowns * unknowns, what);
  require_time(2.0 / 3 * unknowns * unknowns * unknowns / operations_per_second);
}

int checked_count(double value, std::string_view what) {
  constexpr double most = 1e9;
  if (!(std::abs(value) <= most)) throw BeyondLimits(message_text(what, ": ", value, " are too many"));
  return static_cast<int>(std::lround(value));
}

}  // namespace rollres
