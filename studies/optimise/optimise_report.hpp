#pragma once

/// What an optimisation found, as text, JSON, tables and charts. For sources only: it needs nlohmann_json.

#include "studies/drawing/chart.hpp"
#include "studies/optimise/optimise.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// An axis for values of a formula up to a size [SI], and what these are divided by.
struct FormulaAxis {
  ChartAxis axis;
  double factor;
};
FormulaAxis formula_axis(const DesignProblem& problem, const Formula& formula, double size);

/// "31 evaluations (30 solved, 1 recalled, 0 failed)".
std::string in_words(const EvaluationCount& count);
/// "choice 2 of 3: 31 of at most 200, best 15.98 N/m, at most 0:40 left". A search may end sooner.
std::string in_words(const DesignProblem& problem, const OptimiseProgress& progress);

/// What a constraint limits: the formula on its left, or the goal of a bound.
const Formula& limited(const DesignProblem& problem, std::size_t constraint);

/// What holds the best design back and what that costs, in sentences: "It is held back by peak pressure ≤ 4 MPa, where
/// 1 % more room would lower it by 1.8 %. To first order no design near it is better."
std::string limits_in_words(const DesignProblem& problem, const OptimiseReport& report);

/// Status, the best design with its constraints, or the nearest one, and how it was searched.
void print_text(const DesignProblem& problem, const OptimiseReport& report, std::ostream& out);
/// The designs on the front. @param problems  that its points choose from, at least one
void print_text(std::span<const DesignProblem> problems, const ParetoReport& front, std::ostream& out);

Json json_of(const DesignProblem& problem, const OptimiseReport& report);
Json json_of(std::span<const DesignProblem> problems, const ParetoReport& front);
/// What a problem takes from the lists of its file.
Json chosen_json(const DesignProblem& problem);

/// The course of the search: the value of the best feasible design against the number of designs. Its title is the name
/// of the problem.
ChartRequest course_chart(const DesignProblem& problem, const OptimiseReport& report);

/// The front, first goal against second; dominated designs and what is no optimum stay off its line. Where things are
/// chosen from lists, a curve for each choice that has a part of it.
ChartRequest front_chart(std::span<const DesignProblem> problems, const ParetoReport& front);

}  // namespace rollres
