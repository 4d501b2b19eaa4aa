#include "core/messages/number_list.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace rollres {

std::string text_of_list(std::span<const double> numbers) {
  std::string text = "[";
  for (const double number : numbers) {
    std::array<char, 40> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    text.append(text.size() > 1 ? ", " : "").append(digits.data(), end.ptr);
  }
  return text + "]";
}

std::optional<std::vector<double>> list_in(std::string_view text) {
  const auto skip_blanks = [&] {
    while (text.starts_with(' ')) text.remove_prefix(1);
  };
  const auto take = [&](char letter) {
    skip_blanks();
    if (!text.starts_with(letter)) return false;
    text.remove_prefix(1);
    skip_blanks();
    return true;
  };
  std::vector<double> numbers;
  if (!take('[')) return {};
  if (!take(']')) {
    do {
      double number = 0;
      const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
      if (error != std::errc{} || !std::isfinite(number)) return {};
      numbers.push_back(number);
      text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    } while (take(','));
    if (!take(']')) return {};
  }
  if (!text.empty()) return {};
  return numbers;
}

}  // namespace rollres
