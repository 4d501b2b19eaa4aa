#pragma once

/// Texts of messages and notes, with few digits.

#include <sstream>
#include <string>

namespace rollres {

/// The parts one after the other, numbers to so many digits.
template <int digits = 3, class... Parts>
std::string message_text(const Parts&... parts) {
  std::ostringstream line;
  line.precision(digits);
  (line << ... << parts);
  return line.str();
}

}  // namespace rollres
