#pragma once

/// Perceptually uniform colours for the values of a field, as lines of a gnuplot script.

#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rollres {

/// The colour of the n-th of several curves in an order: from dark violet to green (viridis without its light end), so
/// that the order is seen in grey too; each has a contrast of 2.5 to white at least.
std::string ordered_colour(std::size_t place, std::size_t count);

/// A colour for letters on white: as given, or darkened until its contrast to white is 4.5 (WCAG 2.1, 1.4.3).
std::string letter_colour(std::string_view colour);

/// Even levels of a field, and the colours of the bands between them.
struct ColourBands {
  std::vector<double> levels;  ///< rising, the lowest and the highest enclose the field
  bool diverging = false;      ///< zero is in the middle

  /// About ten to twenty bands for values from `lowest` to `highest`; symmetric about zero where both signs matter.
  ColourBands(double lowest, double highest);

  /// About five to ten bands; zero is among them only where the values come near it.
  static ColourBands between(double lowest, double highest);

  double step() const { return levels[1] - levels[0]; }
  /// A value inside the band above or below a level.
  double inside(double level, bool above) const { return level + (above ? 0.5 : -0.5) * step(); }
};

/// Sets palette, colour range and colour bar. One sign: viridis (van der Walt and Smith 2015), from dark to light with
/// the magnitude falling; both signs: blue to red through grey (Moreland 2009), safe for colour-blind readers.
/// @param label in gnuplot's markup
void write_colours(std::ostream& script, const ColourBands& bands, const std::string& label);

/// Levels 1, 2, 5, 10, ... (over many decades 1, 3, 10, ... or 1, 10, ...) that enclose positive values.
std::vector<double> logarithmic_levels(double lowest, double highest);

/// The same for bands between any levels, the first band having the colour 0.5, the next 1.5, ...
void write_numbered_colours(std::ostream& script, const std::vector<double>& levels, const std::string& label);

}  // namespace rollres
