#pragma once

/// The designs that `rollres optimise` stored, valued again without solving anything.

#include "db/rows/result_store.hpp"
#include "studies/optimise/design.hpp"
#include "studies/optimise/optimise.hpp"

namespace rollres {

struct StoredOptimum {
  DesignProblem problem;                    ///< of several, from which a choice is made, that of the best design
  std::vector<Design> designs;              ///< that have a value, feasible or not
  std::vector<DesignProblem> choices = {};  ///< all problems, from which a choice is made
  std::vector<std::size_t> choice_of = {};  ///< the place of each design's problem among them
  std::optional<Design> best;               ///< the best feasible one
  /// The search for it, gone through again; empty where it asked for what is not stored (it had other options), and
  /// for a front.
  std::optional<OptimiseReport> search = {};

  /// Place of an input among the variables, or -1.
  int variable(std::string_view key) const;
};

/// Whether a study file is that of an optimisation. @param place  for messages
/// @throws std::invalid_argument if the text is no JSON object
bool is_optimisation(const std::string& definition, const std::string& place);

/// Nothing if the study is no optimisation.
/// @throws std::invalid_argument if its file is not understood any more
/// @throws std::runtime_error naming the file if the database fails
std::optional<StoredOptimum> stored_optimum(ResultStore& store, const std::string& study);

}  // namespace rollres
