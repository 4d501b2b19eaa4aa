#include "db/file/digest.hpp"

#include <charconv>

namespace rollres {

std::string digest(std::string_view text) {
  __extension__ using Wide = unsigned __int128;
  constexpr Wide prime = (Wide{1} << 88) + 0x13b;
  Wide hash = (Wide{0x6c62272e07bb0142} << 64) + 0x62b821756295c58d;
  for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * prime;
  std::string digits(32, '0');
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, hash >>= 4)
    *digit = "0123456789abcdef"[static_cast<unsigned>(hash & 15)];
  return digits;
}

std::string twelve_digits(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value == 0 ? 0.0 : value, std::chars_format::scientific, 11);
  return {text, end.ptr};
}

}  // namespace rollres
