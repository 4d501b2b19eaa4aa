#pragma once

/// What designs are worth, as the store keeps it beside their points.

#include <span>
#include <vector>

#include "db/rows/result_store.hpp"
#include "studies/optimise/optimise.hpp"

namespace rollres {

/// All designs with a value that the searches saw, in the order in which they came. Feasible is what meets the
/// constraints of the file; the bounds by which a front is found do not count.
/// @param problems  of the reports, one for each; an interruption leaves the last without
std::vector<DesignRecord> design_records(std::span<const DesignProblem> problems,
                                         std::span<const OptimiseReport> reports);

/// The same of a front, with the places on it of those that no other dominates.
/// @param problems  that the points choose from
std::vector<DesignRecord> design_records(std::span<const DesignProblem> problems, const ParetoReport& front);

}  // namespace rollres
