#pragma once

/// Refusals of arguments outside their range, in one wording.

#include <cmath>
#include <stdexcept>
#include <string_view>

#include "core/messages/message_text.hpp"

namespace rollres {

/// @throws std::invalid_argument "name = value: rule" unless `holds`
inline void require(bool holds, std::string_view name, double value, std::string_view rule) {
  if (!holds) throw std::invalid_argument(message_text<6>(name, " = ", value, ": ", rule));
}

/// Refuses what is not a finite number > 0.
inline void require_positive(std::string_view name, double value) {
  require(value > 0 && std::isfinite(value), name, value, "must be > 0 and finite");
}

/// Refuses what is not a number > 0; infinity passes.
inline void require_positive_or_infinite(std::string_view name, double value) {
  require(value > 0, name, value, "must be > 0");
}

/// Refuses what is not a finite number >= 0.
inline void require_not_negative(std::string_view name, double value) {
  require(value >= 0 && std::isfinite(value), name, value, "must be >= 0 and finite");
}

}  // namespace rollres
