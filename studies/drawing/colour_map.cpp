#include "studies/drawing/colour_map.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>

#include "studies/drawing/chart_frame.hpp"
#include "studies/drawing/gnuplot.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

constexpr std::array<std::string_view, 9> viridis{"#440154", "#472D7B", "#3B528B", "#2C728E", "#21918C",
                                                  "#28AE80", "#5EC962", "#ADDC30", "#FDE725"};
constexpr std::array<std::string_view, 9> blue_to_red{"#3B4CC0", "#6282EA", "#8DB0FE", "#B8D0F9", "#DDDDDD",
                                                      "#F5C4AD", "#F49A7B", "#DE604D", "#B40426"};
std::array<int, 3> red_green_blue(std::string_view colour) {
  std::array<int, 3> parts{};
  for (std::size_t i = 0; i < 3; ++i) parts[i] = std::stoi(std::string(colour.substr(1 + 2 * i, 2)), nullptr, 16);
  return parts;
}

/// (L1 + 0.05)/(L2 + 0.05) with the relative luminance L of sRGB (WCAG 2.1).
double contrast_to_white(const std::array<int, 3>& colour) {
  constexpr std::array<double, 3> weights{0.2126, 0.7152, 0.0722};
  double luminance = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = colour[i] / 255.0;
    luminance += weights[i] * (part <= 0.03928 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4));
  }
  return 1.05 / (luminance + 0.05);
}

std::string written(const std::array<int, 3>& colour) {
  std::ostringstream text;
  text << '#' << std::hex << std::uppercase << std::setfill('0');
  for (const int part : colour) text << std::setw(2) << part;
  return text.str();
}

/// A colour between those of a list, at 0 the first and at 1 the last.
std::string mixed(const std::array<std::string_view, 9>& colours, double place) {
  const double at = place * (static_cast<double>(colours.size()) - 1);
  const auto below = std::min(static_cast<std::size_t>(at), colours.size() - 2);
  const std::array<int, 3> from = red_green_blue(colours[below]), to = red_green_blue(colours[below + 1]);
  std::array<int, 3> parts{};
  for (std::size_t i = 0; i < 3; ++i)
    parts[i] = static_cast<int>(std::lround(from[i] + (at - static_cast<double>(below)) * (to[i] - from[i])));
  return written(parts);
}

/// gnuplot's maxcolors draws the bar of fewer bands than colours with other steps than the picture: there each band is
/// written out.
void write_palette(std::ostream& script, const std::array<std::string_view, 9>& colours, std::size_t bands) {
  script << "set palette defined (";
  if (bands < colours.size()) {
    for (std::size_t i = 0; i < bands; ++i) {
      const std::string colour =
          mixed(colours, bands == 1 ? 0.5 : static_cast<double>(i) / static_cast<double>(bands - 1));
      script << (i == 0 ? "" : ", ") << i << " '" << colour << "', " << i + 1 << " '" << colour << "'";
    }
    script << ") maxcolors 0\n";
    return;
  }
  for (std::size_t i = 0; i < colours.size(); ++i) script << (i == 0 ? "" : ", ") << i << " '" << colours[i] << "'";
  script << ") maxcolors " << bands << "\n";
}

constexpr double lesser_sign = 0.25;  // of the greater: from there on both signs matter

}  // namespace

std::string ordered_colour(std::size_t place, std::size_t count) {
  constexpr double lightest = 0.64;
  return mixed(viridis, count < 2 ? 0 : lightest * static_cast<double>(place) / static_cast<double>(count - 1));
}

std::string letter_colour(std::string_view colour) {
  constexpr double wanted = 4.5, step = 0.97;
  std::array<int, 3> parts = red_green_blue(colour);
  while (contrast_to_white(parts) < wanted)
    for (int& part : parts) part = static_cast<int>(part * step);
  return written(parts);
}

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
  write_palette(script, bands.diverging ? blue_to_red : viridis, bands.levels.size() - 1);
  script << "set cbrange [" << short_number(bands.levels.front()) << ":" << short_number(bands.levels.back())
         << "]\nset cbtics (";
  const std::size_t every = bands.levels.size() > 12 ? 2 : 1;
  bool first = true;
  const auto zero = static_cast<std::size_t>(std::lround(-bands.levels.front() / bands.step()));
  for (std::size_t i = zero % every; i < bands.levels.size(); i += every) {
    script << (first ? "" : ", ") << short_number(bands.levels[i]);
    first = false;
  }
  script << ")\nset cblabel " << gnuplot::quoted(label) << "\n";
}

std::vector<double> logarithmic_levels(double lowest, double highest) {
  constexpr double some_decades = 4, many_decades = 8, rounding = 1e-9;
  const double decades = std::log10(highest / lowest);
  std::vector<int> steps{1};
  if (decades <= some_decades)
    steps = {1, 2, 5};
  else if (decades <= many_decades)
    steps = {1, 3};
  std::vector<double> all;
  const double first = std::floor(std::log10(lowest) + rounding), last = std::ceil(std::log10(highest) - rounding);
  for (double decade = first; decade <= last; ++decade)
    for (const int step : steps) all.push_back(step * std::pow(10.0, decade));
  std::vector<double> levels;  // the last one not above the lowest value to the first one not below the highest
  for (const double level : all) {
    if (level <= lowest * (1 + rounding)) levels.clear();
    if (levels.empty() || levels.back() < highest * (1 - rounding)) levels.push_back(level);
  }
  if (levels.size() == 1) levels.push_back(2 * levels.front());
  return levels;
}

void write_numbered_colours(std::ostream& script, const std::vector<double>& levels, const std::string& label) {
  write_palette(script, viridis, levels.size() - 1);
  script << "set cbrange [0:" << levels.size() - 1 << "]\nset cbtics (";
  for (std::size_t i = 0; i < levels.size(); ++i)
    script << (i == 0 ? "" : ", ") << gnuplot::quoted(short_number(levels[i])) << " " << i;
  script << ")\nset cblabel " << gnuplot::quoted(label) << "\n";
}

}  // namespace rollres
