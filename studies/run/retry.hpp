#pragma once

/// Which stored answers are solved again.

#include <array>
#include <string_view>

#include "core/scene/solution.hpp"

namespace rollres {

/// The new answer takes the place of the old one, in one transaction and under the same key; what converged never gives
/// way to what did not.
enum class Retry {
  nothing,
  not_converged,  ///< those with this status
  failed,         ///< all that did not converge: those without a steady state, too
  all
};
template <>
struct ChoiceNames<Retry> {
  static constexpr std::array<std::string_view, 4> names{"nothing", "not_converged", "failed", "all"};
};

/// Whether a stored answer of this status is to be solved again.
inline bool is_retried(Retry retry, Status status) {
  return retry == Retry::all || (retry == Retry::failed && status != Status::converged) ||
         (retry == Retry::not_converged && status == Status::not_converged);
}

/// The word of the option --retry.
inline Retry retry_named(std::string_view word) {
  return static_cast<Retry>(find_name(ChoiceNames<Retry>::names, word));
}

}  // namespace rollres
