#pragma once

/// Which axes of a study a picture of its report varies: the others stand at their middle values.

#include <string>
#include <vector>

#include "studies/report/report_sections.hpp"

namespace rollres {

struct FixedAxes {
  std::vector<Filter> filters;
  std::string words;  ///< " at load = 10 kN/m"
};

/// The axes that vary: the wished one first, then numbers, those with the most values first.
std::vector<const QuantityColumn*> longest_first(const ReportSource& source, const std::string& wish);

/// All varied axes but the first few, which are numbers and have the most values, at their middle values.
FixedAxes all_but_longest(const ReportSource& source, const ReportOptions& options, std::size_t free);

/// All varied axes but one and its family at their middle values. The family is the wished one, else that with the
/// most values that colours still tell apart.
FixedAxes slice_along(const ReportSource& source, const ReportOptions& options, const QuantityColumn& along);

}  // namespace rollres
