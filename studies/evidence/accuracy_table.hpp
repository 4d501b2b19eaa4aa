#pragma once

/// What measure_accuracy found, as tables, as text and as a work-precision chart.

#include <string>
#include <vector>

#include "db/queries/table.hpp"
#include "studies/drawing/chart.hpp"
#include "studies/evidence/accuracy.hpp"

namespace rollres {

/// One row for each scene, method and spacing, all of it in SI; what is absent is empty.
Table accuracy_rows(const std::vector<AccuracyReport>& reports);

/// A heading, one row for each spacing (and each tolerance) with the error, seconds and memory of each method, what the
/// reference was, the observed orders, and why answers are missing; to be read as it is, or as Markdown.
std::string accuracy_text(const AccuracyReport& report, bool markdown);

/// Error against seconds, both logarithmic, one curve for each method. On a single grid an error may be small by luck,
/// so that a point shows the largest one at its spacing or a finer one, and no less than the uncertainty of the
/// reference: what can be relied on. Without curves if there is no error.
ChartRequest accuracy_chart(const AccuracyReport& report);

}  // namespace rollres
