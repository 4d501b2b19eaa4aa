#include "studies/colour_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include "studies/chart_layout.hpp"
#include "studies/gnuplot.hpp"
#include "studies/readable_number.hpp"

namespace rollres {

namespace {

constexpr std::array<std::string_view, 9> viridis{"#440154", "#472D7B", "#3B528B", "#2C728E", "#21918C",
                                                  "#28AE80", "#5EC962", "#ADDC30", "#FDE725"};
constexpr std::array<std::string_view, 9> blue_to_red{"#3B4CC0", "#6282EA", "#8DB0FE", "#B8D0F9", "#DDDDDD",
                                                      "#F5C4AD", "#F49A7B", "#DE604D", "#B40426"};
constexpr double lesser_sign = 0.25;  // of the greater: from there on both signs matter

}  // namespace

ColourBands::ColourBands(double lowest, double highest) {
  lowest = std::min(lowest, 0.0);
  highest = std::max(highest, 0.0);
  if (lowest == highest) highest = 1;
  diverging = std::min(-lowest, highest) > lesser_sign * std::max(-lowest, highest);
  if (diverging) {
    highest = std::max(-lowest, highest);
    lowest = -highest;
  }
  const double width = even_step(0.5 * (highest - lowest));
  constexpr double rounding = 1e-9;
  const auto first = static_cast<int>(std::floor(lowest / width + rounding));
  const auto last = static_cast<int>(std::ceil(highest / width - rounding));
  for (int i = first; i <= last; ++i) levels.push_back(i * width);
}

ColourBands ColourBands::between(double lowest, double highest) {
  constexpr double near_zero = 0.4;  // of the largest magnitude
  ColourBands bands(lowest, highest);
  if (lowest == highest || (lowest < 0 && highest > 0)) return bands;
  if (std::min(std::abs(lowest), std::abs(highest)) < near_zero * std::max(std::abs(lowest), std::abs(highest)))
    return bands;
  const double width = even_step(highest - lowest);
  bands.levels.clear();
  for (double i = std::floor(lowest / width); i < std::ceil(highest / width) + 0.5; ++i)
    bands.levels.push_back(i * width);
  return bands;
}

void write_colours(std::ostream& script, const ColourBands& bands, const std::string& label) {
  const auto& colours = bands.diverging ? blue_to_red : viridis;
  script << "set palette defined (";
  for (std::size_t i = 0; i < colours.size(); ++i) script << (i == 0 ? "" : ", ") << i << " '" << colours[i] << "'";
  script << ") maxcolors " << bands.levels.size() - 1 << "\nset cbrange [" << short_number(bands.levels.front()) << ":"
         << short_number(bands.levels.back()) << "]\nset cbtics (";
  const std::size_t every = bands.levels.size() > 12 ? 2 : 1;
  bool first = true;
  const auto zero = static_cast<std::size_t>(std::lround(-bands.levels.front() / bands.step()));
  for (std::size_t i = zero % every; i < bands.levels.size(); i += every) {
    script << (first ? "" : ", ") << short_number(bands.levels[i]);
    first = false;
  }
  script << ")\nset cblabel " << gnuplot::quoted(label) << "\n";
}

}  // namespace rollres
