#pragma once

/// What one solution may take of memory and of processor time.
///
/// `solve` sets the limits for the thread it runs on, and threads that help it (threads.hpp) take them over. Whatever
/// grows with a scene's numbers asks them before it begins (`require_memory`), its iterations as they go on
/// (`require_time`), and numbers of cells, panels and terms are made by `checked_count`. Beyond a limit, BeyondLimits
/// says what to change; `solve` answers not_converged with its words.

#include <atomic>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace rollres {

struct BeyondLimits : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Thrown out of a solution or an evaluation by the wish to stop.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
};

/// Limits of a scene that gives none: a quarter of the machine's memory, at most 4 GB and half of what the process may
/// have [bytes]; processor time [s].
double usual_memory_limit();
inline constexpr double usual_time_limit = 60;

class Interruptible;

/// Limits for this thread while it lives; those before it come back afterwards.
class SolutionLimits {
 public:
  /// @param seconds of processor time from now on, of this thread and of those that help it
  explicit SolutionLimits(double bytes, double seconds = std::numeric_limits<double>::infinity());
  ~SolutionLimits();

 private:
  friend class LimitsOfAnother;
  friend void require_time(double more);
  friend void require_memory(double bytes, std::string_view what);

  double bytes_, seconds_;
  Interruptible* interruptible_;
  std::atomic<double> used_ = 0;  // [s], up to when each thread last asked
  SolutionLimits* before_;
};

/// While it lives, solutions that this thread begins ask `stop` about a hundred times a second, on all threads that help
/// them, and end with Interrupted once it says yes.
class Interruptible {
 public:
  explicit Interruptible(std::function<bool()> stop);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

 private:
  friend class SolutionLimits;
  friend void require_time(double more);

  std::function<bool()> stop_;
  Interruptible* before_;
};

/// The limits of the calling thread, null if none; and their hold on a thread that helps, while it lives.
SolutionLimits* limits_of_this_thread();
class LimitsOfAnother {
 public:
  explicit LimitsOfAnother(SolutionLimits* limits);
  ~LimitsOfAnother();
  LimitsOfAnother(const LimitsOfAnother&) = delete;
  LimitsOfAnother& operator=(const LimitsOfAnother&) = delete;

 private:
  SolutionLimits* before_;
};

/// May be called every microsecond.
/// @param more seconds that are certain to follow   @throws BeyondLimits if the solution's time is over, or too short
/// @throws Interrupted see Interruptible
void require_time(double more = 0);

/// @param bytes that `what` needs   @throws BeyondLimits "what: ..." if that is more than the limit or no number
void require_memory(double bytes, std::string_view what);

/// Both, for the factorisation of a full matrix.
void require_factorisation(double unknowns, std::string_view what);

/// The whole number nearest to a count that was computed in doubles.
/// @throws BeyondLimits "what: ..." if that is no number or its size above 1e9
int checked_count(double value, std::string_view what);

}  // namespace rollres
