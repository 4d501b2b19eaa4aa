#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// An SVG file in pieces: words and signs as they stand, and numbers. Places within a picture are of use to a tenth of
/// a pixel only, and a number of its texts to its last digit; both may differ with the processor by rounding.
struct PicturePiece {
  std::string text;
  bool number = false, shown = false;  ///< shown: read by people, not a place
};

inline std::vector<PicturePiece> picture_pieces(std::string_view svg) {
  std::vector<PicturePiece> pieces;
  const auto digit = [&](std::size_t i) { return i < svg.size() && svg[i] >= '0' && svg[i] <= '9'; };
  bool shown = false;
  for (std::size_t i = 0; i < svg.size();) {
    if (svg[i] == '<') shown = false;
    if (svg[i] == '>') shown = true;
    std::size_t end = i;
    while (digit(end) || (end > i && svg[end] == '.' && digit(end + 1))) ++end;
    const bool number = end > i;
    if (!number) end = i + 1;
    if (number || pieces.empty() || pieces.back().number)
      pieces.push_back({std::string(svg.substr(i, end - i)), number, shown});
    else
      pieces.back().text += svg[i];
    i = end;
  }
  return pieces;
}

/// What tells two pictures apart, or nothing.
/// @param pixels  by which places may differ
inline std::string difference_of_pictures(std::string_view one, std::string_view other, double pixels = 0.6) {
  const std::vector<PicturePiece> a = picture_pieces(one), b = picture_pieces(other);
  if (a.size() != b.size())
    return "not as many parts: " + std::to_string(a.size()) + " and " + std::to_string(b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].text == b[i].text) continue;
    const std::string words = a[i].text + " and " + b[i].text + " after " + (i > 0 ? a[i - 1].text : "nothing");
    if (!a[i].number || !b[i].number) return words;
    const std::size_t point = a[i].text.find('.');
    const double last = point == std::string::npos ? 1 : std::pow(10.0, -double(a[i].text.size() - point - 1));
    const double allowed = a[i].shown ? 1.01 * last : pixels;
    if (!(std::abs(std::stod(a[i].text) - std::stod(b[i].text)) <= allowed)) return words;
  }
  return {};
}
