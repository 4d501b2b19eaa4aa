#pragma once

/// What one solution may take of memory and of time.
///
/// `solve` sets the limits for the thread it runs on. Whatever grows with a scene's numbers asks them before it begins
/// (`require_memory`), its iterations as they go on (`require_time`), and numbers of cells, panels and terms are made
/// by `checked_count`. Beyond a limit, BeyondLimits says what to change; `solve` answers not_converged with its words.

#include <limits>
#include <stdexcept>
#include <string_view>

namespace rollres {

struct BeyondLimits : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A quarter of the machine's memory [bytes].
double usual_memory_limit();

/// Limits for this thread while it lives; those before it come back afterwards.
class SolutionLimits {
 public:
  /// @param seconds of wall time from now on
  explicit SolutionLimits(double bytes, double seconds = std::numeric_limits<double>::infinity());
  ~SolutionLimits();
  SolutionLimits(const SolutionLimits&) = delete;
  SolutionLimits& operator=(const SolutionLimits&) = delete;

 private:
  double bytes_before_, end_before_, seconds_before_;
};

/// @throws BeyondLimits if the thread's time is over
void require_time();

/// @param bytes that `what` needs   @throws BeyondLimits "what: ..." if that is more than the limit or no number
void require_memory(double bytes, std::string_view what);

/// The whole number nearest to a count that was computed in doubles.
/// @throws BeyondLimits "what: ..." if that is no number or its size above 1e9
int checked_count(double value, std::string_view what);

}  // namespace rollres
