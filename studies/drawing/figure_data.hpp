#pragma once

/// The data file of a figure: named blocks of columns, as gnuplot's `index` finds them.

#include <string>
#include <string_view>
#include <vector>

#include "studies/drawing/contour_loops.hpp"

namespace rollres {

/// A row of numbers; an empty row is a blank line, which ends a line of a surface.
using DataRow = std::vector<double>;

class FigureData {
 public:
  explicit FigureData(std::string_view title);

  /// Adds a block; returns how a script refers to it: "data index 2".
  /// @param columns what stands in them: "x [mm], u [mm]"
  std::string add(std::string_view name, std::string_view columns, const std::vector<DataRow>& rows);
  /// Loops as one block, closed and apart from each other by blank lines.
  std::string add(std::string_view name, std::string_view columns, const std::vector<ContourLoop>& loops);

  int blocks() const { return blocks_; }
  const std::string& text() const { return text_; }

 private:
  int blocks_ = 0;
  std::string text_;
};

/// The points of a loop, the first one again at the end.
std::vector<DataRow> closed(const ContourLoop& loop);

}  // namespace rollres
