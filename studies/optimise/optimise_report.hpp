#pragma once

/// What an optimisation found, as text, JSON, tables and charts. For sources only: it needs nlohmann_json.

#include <string>

#include "db/queries/table.hpp"
#include "studies/drawing/chart.hpp"
#include "studies/optimise/optimise.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// "minimise rolling_resistance".
std::string goal_in_words(const Goal& goal);

/// The variables at the best design: value, range, active bound, elasticity of the goal.
Table variables_table(const DesignProblem& problem, const OptimiseReport& report);

/// The constraints there: sides, slack, multiplier, elasticities by each variable.
Table constraints_table(const DesignProblem& problem, const OptimiseReport& report);

/// The designs on a front: both goals, variables, status.
Table front_table(const DesignProblem& problem, const ParetoReport& front);

/// "cobyla (31 evaluations), then slsqp (8)".
std::string searches_in_words(const OptimiseReport& report);

Json json_of(const DesignProblem& problem, const OptimiseReport& report);
Json json_of(const DesignProblem& problem, const ParetoReport& front);

/// The course of the search: the value of the best feasible design against the number of designs.
ChartRequest course_chart(const DesignProblem& problem, const OptimiseReport& report);

/// The front, first goal against second; dominated designs and what is no optimum stay off its line.
ChartRequest front_chart(const DesignProblem& problem, const ParetoReport& front);

}  // namespace rollres
