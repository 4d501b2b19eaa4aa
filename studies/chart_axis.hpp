#pragma once

/// Axes and lines of text as gnuplot wants them, common to all pictures.

#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>

#include "studies/chart_layout.hpp"

namespace rollres {

/// Letters, not bytes, of a UTF-8 text.
std::size_t letters(std::string_view text);

/// The gnuplot string for a text set smaller, down to two thirds, where it is longer than `room` letters, and cut where
/// that is not enough.
/// @param markup the same text in gnuplot's markup
std::string fitted(std::string text, const std::string& markup, std::size_t room);

/// The gnuplot string "name symbol [unit]".
std::string axis_label(const ChartAxis& axis, std::size_t room);

/// Range, scale and numbers of the axis `name` ('x' or 'y').
void write_axis(std::ostream& script, char name, const Span& span);

}  // namespace rollres
