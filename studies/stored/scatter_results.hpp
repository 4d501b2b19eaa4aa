#pragma once

/// The answers of a study whose inputs scatter, as numbers at each combination of its other axes.

#include <map>
#include <string>
#include <vector>

#include "db/queries/table.hpp"
#include "db/rows/result_store.hpp"
#include "studies/scatter/scatter_statistics.hpp"
#include "studies/study/study.hpp"

namespace rollres {

/// One combination of the axes that do not scatter.
struct ScatterPlace {
  std::vector<Cell> at;                ///< values of these axes [SI], or names
  std::vector<ScatterBatches> values;  ///< of each formula
  std::vector<ScatterBatches> holds;   ///< of each condition: 1 where it holds, 0 where it does not
  std::size_t points = 0;
  std::size_t failed = 0;   ///< answered, but not converged
  std::size_t missing = 0;  ///< not answered
};

struct ScatterResults {
  std::vector<std::string> axes;  ///< keys of these axes
  std::vector<ScatterPlace> places;
  std::map<std::string, std::size_t> reasons;  ///< why points failed, and how many

  std::size_t points() const;
  std::size_t failed() const;
  std::size_t missing() const;
};

/// Reads the answer of every point of the plan, whichever study stored it.
/// @throws std::runtime_error naming the file if the database fails
ScatterResults scatter_results(const Study& study, const StudyPlan& plan, ResultStore& store,
                               const std::vector<Formula>& formulas, const std::vector<Condition>& conditions);

/// How probable it is that a condition holds. Where it holds at all points or at none, the error is 3 / points (the
/// rule of three: Hanley and Lippman-Hand, 1983, JAMA 249, 1743).
ScatterEstimate probability(const ScatterBatches& holds);

}  // namespace rollres
