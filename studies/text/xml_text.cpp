#include "studies/text/xml_text.hpp"

#include <algorithm>
#include <cstdint>

#include "studies/text/printable.hpp"

namespace rollres {

namespace {

/// Length of the valid UTF-8 sequence at the start, or 0 (RFC 3629).
std::size_t sequence(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = byte(0) < 0x80   ? 1
                             : byte(0) < 0xc2 ? 0
                             : byte(0) < 0xe0 ? 2
                             : byte(0) < 0xf0 ? 3
                             : byte(0) < 0xf5 ? 4
                                              : 0;
  if (length == 0 || length > text.size()) return 0;
  std::uint32_t code = length == 1 ? byte(0) : byte(0) & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) return 0;
    code = code << 6 | (byte(i) & 0x3fU);
  }
  const bool shortest = length < 3 || code >= (length == 3 ? 0x800U : 0x10000U);
  return shortest && code <= 0x10ffff && !(code >= 0xd800 && code < 0xe000) ? length : 0;
}

}  // namespace

std::string xml_text(std::string_view plain) {
  std::string escaped;
  while (!plain.empty()) {
    const std::size_t length = sequence(plain);
    const char first = plain.front();
    if (length == 0)
      escaped += "\uFFFD";
    else if (first == '&')
      escaped += "&amp;";
    else if (first == '<')
      escaped += "&lt;";
    else if (first == '>')
      escaped += "&gt;";
    else if (first == '"')
      escaped += "&quot;";
    else if (first == '\'')
      escaped += "&#39;";
    else if (is_control(plain.substr(0, length)) && first != '\n' && first != '\t')
      escaped += ' ';
    else
      escaped += plain.substr(0, length);
    plain.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return escaped;
}

}  // namespace rollres
