#pragma once

/// Two stored studies against each other, point by point.

#include "db/queries/table.hpp"
#include "db/rows/result_store.hpp"

namespace rollres {

struct ComparisonOptions {
  std::vector<std::string> outputs = {"rolling_resistance"};  ///< keys of numbers
  std::vector<std::string> ignored = {};                      ///< keys of inputs that may differ in matching points
};

/// An input that is one value in each study, but not the same: what the studies compare.
struct ComparedInput {
  std::string key;
  Cell first, second;  ///< absent: not given
};

/// An output at a point that both studies have.
struct PointDifference {
  std::int64_t position = 0;  ///< of the point in the first study
  std::vector<Cell> inputs;   ///< values of StudyComparison::axes
  std::string output;
  Cell first, second;
  double relative = 0;  ///< (second - first) / |first|; infinite if only one is there, or first is 0
};

struct OutputDifference {
  std::string output;
  std::size_t points = 0;
  double largest = 0, rms = 0;  ///< of the absolute values of the relative differences
};

struct StudyComparison {
  std::vector<ComparedInput> compared;
  std::vector<std::string> axes;             ///< inputs that tell the matching points apart
  std::size_t matched = 0;                   ///< points with the same inputs
  std::size_t only_first = 0;                ///< points whose inputs only the first study has
  std::size_t only_second = 0;               ///< the same of the second
  std::size_t half_answered = 0;             ///< matched, converged in one study only
  std::size_t unanswered = 0;                ///< matched, converged in neither
  std::vector<PointDifference> differences;  ///< where both converged; the largest first
  std::vector<OutputDifference> outputs;

  /// Whether there are differences, none is larger, and no point is answered in one study only.
  bool within(double relative) const;
};

/// Points match if all their inputs are the same to 12 digits, but those in `options.ignored` and those that are one
/// value in each study and differ between them. What is not computed yet is left out.
/// @throws std::invalid_argument naming an unknown study, input or output, or a study with two points that cannot be
///         told apart without the ignored inputs
/// @throws std::runtime_error if a database fails
StudyComparison compare_studies(ResultStore& first_store, const std::string& first, ResultStore& second_store,
                                const std::string& second, const ComparisonOptions& options = {});

}  // namespace rollres
