#pragma once

/// Texts of messages and notes, with few digits.

#include <sstream>
#include <string>
#include <string_view>

namespace rollres {

/// The parts one after the other, numbers to so many digits.
template <int digits = 3, class... Parts>
std::string message_text(const Parts&... parts) {
  std::ostringstream line;
  line.precision(digits);
  (line << ... << parts);
  return line.str();
}

/// One text of all: "speed, load". @param text_of what of each is told
template <class List, class TextOf>
std::string joined(const List& list, std::string_view between, TextOf&& text_of) {
  std::string text;
  for (const auto& one : list) (text += text.empty() ? "" : between) += text_of(one);
  return text;
}
template <class List>
std::string joined(const List& list, std::string_view between = ", ") {
  return joined(list, between, [](const auto& one) { return std::string_view(one); });
}

}  // namespace rollres
