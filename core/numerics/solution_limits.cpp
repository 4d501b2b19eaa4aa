#include "core/numerics/solution_limits.hpp"

#include <unistd.h>

#include <chrono>
#include <cmath>

#include "core/messages/message_text.hpp"

namespace rollres {

namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// Limits of this thread: bytes, and the end of its time by `now`.
thread_local double allowed_bytes = none, end_of_time = none, allowed_seconds = none;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

double usual_memory_limit() {
  return 0.25 * static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

SolutionLimits::SolutionLimits(double bytes, double seconds)
    : bytes_before_(allowed_bytes), end_before_(end_of_time), seconds_before_(allowed_seconds) {
  allowed_bytes = bytes;
  end_of_time = now() + seconds;
  allowed_seconds = seconds;
}

SolutionLimits::~SolutionLimits() {
  allowed_bytes = bytes_before_;
  end_of_time = end_before_;
  allowed_seconds = seconds_before_;
}

void require_time() {
  if (end_of_time < none && now() > end_of_time)
    throw BeyondLimits(message_text("not solved within the time_limit of ", allowed_seconds, " s"));
}

void require_memory(double bytes, std::string_view what) {
  if (bytes <= allowed_bytes) return;
  throw BeyondLimits(
      message_text(what, ": about ", bytes / 1e9, " GB, more than the limit of ", allowed_bytes / 1e9, " GB"));
}

int checked_count(double value, std::string_view what) {
  constexpr double most = 1e9;
  if (!(std::abs(value) <= most)) throw BeyondLimits(message_text(what, ": ", value, " are too many"));
  return static_cast<int>(std::lround(value));
}

}  // namespace rollres
