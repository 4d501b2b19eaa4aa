#pragma once

/// Designs among which some things are chosen from lists: variants, names, sizes of a catalogue. Every combination of
/// what the lists hold is a design problem of the other variables (DesignProblem::chosen tells which), each is searched
/// to its end, and the best of their optima is the answer.

#include <iosfwd>
#include <span>

#include "studies/optimise/optimise.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

struct ChoicesReport {
  std::vector<OptimiseReport> reports;   ///< of the problems, in their order; fewer after an interruption
  std::optional<std::size_t> best = {};  ///< place of the problem with the best design; none if none is feasible
  DesignStatus status = DesignStatus::no_feasible_design;  ///< optimum if every problem's search ended with its word
  std::string reason = {};                                 ///< why it is not an optimum
  EvaluationCount count = {};                              ///< of all
};

/// @param problems  of one file (read_design_problems), at least one
/// @throws std::runtime_error if the store fails
ChoicesReport optimise_choices(std::span<const DesignProblem> problems, StoredEvaluations& evaluations,
                               const OptimiseOptions& options = {});

/// "variant = soft, radius = 20 mm"
std::string chosen_in_words(const DesignProblem& problem);

/// A table of all choices, and the best one's report.
void print_text(std::span<const DesignProblem> problems, const ChoicesReport& report, std::ostream& out);

/// The best one's report with "chosen", and all under "choices".
Json json_of(std::span<const DesignProblem> problems, const ChoicesReport& report);

}  // namespace rollres
