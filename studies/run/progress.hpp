#pragma once

/// One line that tells how far a sweep is, for people who wait in front of a terminal.

#include <iosfwd>
#include <string>

#include "studies/run/sweep.hpp"

namespace rollres {

/// "[######------]  57 of 180, 12.3/s, 0:10 left, 2 failed", at most `width` columns.
std::string progress_line(const SweepProgress& progress, std::size_t width);

/// A duration as people say it: "0.21 s", "41 s", "3:05", "2:10:00".
std::string duration_in_words(double seconds);

/// Columns of the terminal behind `stream`, or 0 if it is none.
std::size_t terminal_width(const std::ostream& stream);

}  // namespace rollres
