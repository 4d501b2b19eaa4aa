#pragma once

/// A design problem: inputs of a scene to be chosen so that a formula of its results is least or greatest, and what a
/// choice of them is worth.
///
/// With several scenes (a duty cycle) the value of a goal is the weighted sum of its formula over them, their weighted
/// mean, or the largest or least value that it has in one of them, whatever the weights. A constraint holds in each
/// scene, or for such a number of its left side.
///
/// Where inputs scatter, each scene stands at the same fixed points of them at every design (common random numbers:
/// Asmussen and Glynn, 2007, "Stochastic Simulation", section V.6), so that what is made of the scatter
/// (ScatterMeasure) is as smooth in the variables as the answers are. The numbers over the scenes come first: the
/// scatter is that of a thing that goes through all of them.
///
/// A search sees the problem in DesignScale's terms: variables in the unit box, least values, constraints c <= 0. Along
/// each side of the box the scaled variable (the logarithm, or the value) runs evenly from one bound to the other.
/// Values that are positive are taken in their logarithm, for rolling resistances and pressures follow power laws
/// nearly: in these terms both the goal and the constraints are almost linear, all slopes are of the order of 1, and so
/// are the multipliers of the constraints, whatever the units.

#include "core/derivatives/objective.hpp"
#include "studies/scatter/scatter_measure.hpp"
#include "studies/scene_io/formula.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/study/uncertain.hpp"

namespace rollres {

/// Algorithms of NLopt by name (design_algorithm.hpp).
enum class Algorithm { bobyqa, cobyla, nelder_mead, subplex, direct_l, crs2, slsqp, mma, ccsaq, lbfgs };
template <>
struct ChoiceNames<Algorithm> {
  static constexpr std::array<std::string_view, 10> names{"bobyqa", "cobyla", "nelder_mead", "subplex", "direct_l",
                                                          "crs2",   "slsqp",  "mma",         "ccsaq",   "lbfgs"};
};

/// How the values of several scenes become one.
enum class OverScenes { sum, mean, max, min };
template <>
struct ChoiceNames<OverScenes> {
  static constexpr std::array<std::string_view, 4> names{"sum", "mean", "max", "min"};
};

/// A formula to be made small or large.
struct Goal {
  Formula formula;
  bool maximise = false;
  OverScenes over = OverScenes::sum;
  ScatterMeasure scatter = {};

  /// Whether value `a` is better than value `b`.
  bool better(double a, double b) const { return maximise ? a > b : a < b; }
};

/// A condition on each scene, or on a number of its left side over all of them.
struct DesignConstraint : Condition {
  using Condition::Condition;
  std::optional<OverScenes> over = {};  ///< none: in each scene
  ScatterMeasure scatter = {};          ///< of the left side
};

/// A bound of a second goal's value, as a constraint: its largest allowed value, or its least if it is maximised.
struct GoalBound {
  Goal goal;
  double limit;  ///< [SI]
};

struct DutyScene {
  RollingScene scene;
  double weight = 1;
};

/// When a search ends.
struct DesignStop {
  int evaluations = 0;      ///< scenes asked for, recalled ones included; 0: 200 for each variable, 500 if global
  double tolerance = 1e-4;  ///< of each variable, as a fraction of its range in the scaled variable
};

/// A front between the first goal and this one.
struct ParetoWish {
  Goal goal;
  int points = 0;
};

/// A value of a variable that is a list.
struct ChosenValue {
  std::string key;  ///< of an input, or "variant"
  InputValue value;
};

struct DesignProblem {
  std::string name;
  std::vector<DutyScene> scenes;  ///< at least one; the variables hold their start
  std::vector<Variable> variables;
  std::vector<double> start;  ///< [SI]
  Goal goal;
  std::vector<DesignConstraint> constraints = {};
  std::optional<GoalBound> bound = {};
  std::optional<Algorithm> algorithm = {};
  bool global = false;  ///< look for the best of several optima
  DesignStop stop = {};
  std::optional<ParetoWish> pareto = {};
  std::vector<ChosenValue> chosen = {};  ///< what this problem takes from the lists of its file
  UncertainInputs uncertain = {};
  std::vector<std::vector<double>> uncertain_points = {};  ///< of these, as uncertain_points() has them

  std::string variant() const;  ///< of `chosen`; empty if there is none
  std::string in_words(const ChosenValue& value) const;
  /// Points at which each scene stands: 1 where nothing scatters.
  std::size_t scatter_points() const { return uncertain_points.empty() ? 1 : uncertain_points.front().size(); }
  std::size_t scenes_of_a_design() const { return scenes.size() * scatter_points(); }
  Body body() const { return body_of(scenes.front().scene); }
  /// Of a value, or of a formula's, in the scenes.
  std::string_view unit(const Quantity& quantity) const { return quantity.unit_for(body()); }
  std::string unit(const Formula& formula) const { return unit_of(formula, body()); }
};

/// Both sides of a constraint at a design [unit of the left side]; NaN if one is absent.
struct ConstraintSides {
  double left = RollingSolution::absent, right = RollingSolution::absent;
  bool at_most = true;  ///< left <= right, or left >= right
  bool holds = false;
};

/// What a design is worth.
struct Design {
  std::vector<double> point;                      ///< values of the variables [SI]
  double value = RollingSolution::absent;         ///< of the goal [SI]
  double second = RollingSolution::absent;        ///< of the goal of a front [SI]
  double error = RollingSolution::absent;         ///< of the value, by the errors of all rolling resistances [SI]
  std::vector<ConstraintSides> constraints = {};  ///< as constraint_places, and last the bound
  std::string reason = {};                        ///< why there is no value; empty if there is one
  std::vector<std::string> keys = {};             ///< of the evaluations, one for each scene
  std::vector<std::string> warnings = {};         ///< of the answers, each once
  double model_error = RollingSolution::absent;   ///< of the answers, the largest [1]

  bool found() const { return reason.empty(); }
  bool feasible() const;  ///< has a value, and all constraints hold
};

/// The scenes of a design: those of the duty cycle, each at all points of what scatters before the next.
std::vector<RollingScene> scenes_at(const DesignProblem& problem, std::span<const double> point);

/// Evaluates a design. A scene without a converged answer and a formula without a finite value are failures with a
/// reason; exceptions of `evaluate` are left to the caller.
/// @param evaluate  called by several threads at once if `jobs` is not 1
/// @param jobs      scenes side by side; 0: one for each core
Design evaluate_design(const DesignProblem& problem, std::span<const double> point, const Evaluate& evaluate,
                       int jobs = 1);

/// A constraint in one scene, or over all.
struct ConstraintPlace {
  std::size_t constraint;
  std::optional<std::size_t> scene = {};
};

/// Those that hold in each scene, scene by scene, then those over all.
std::vector<ConstraintPlace> constraint_places(const DesignProblem& problem);

/// How the values in the scenes and at the points become one: ", weighted sum over 2 scenes, mean + 2 sd of 64 points".
std::string measure_in_words(const DesignProblem& problem, const Goal& goal);

/// Text of a constraint as messages name it: "peak_pressure <= 2 MPa", with ", scene 2" where there are several, and
/// what of the scatter it holds for.
std::string constraint_name(const DesignProblem& problem, std::size_t constraint);

/// The values of the variables at a place in the unit box [SI]; places outside are moved to its sides.
std::vector<double> point_in_box(const DesignProblem& problem, std::span<const double> place);

class DesignScale {
 public:
  /// @param reference  a design with a value: it tells which quantities are positive, and the size of the others
  DesignScale(const DesignProblem& problem, const Design& reference);

  std::size_t size() const { return problem_.variables.size(); }
  std::vector<double> to_box(std::span<const double> point) const;
  std::vector<double> from_box(std::span<const double> place) const { return point_in_box(problem_, place); }
  /// d value / d place of one variable [SI].
  double slope(std::size_t variable, double value) const;

  /// To be minimised [1]: +-ln(value / reference), or +-value / |reference|.
  double value(const Design& design) const;
  /// At most 0 where they hold [1]: +-ln(left / right), or +-(left - right) over their size.
  std::vector<double> constraints(const Design& design) const;

 private:
  struct Side {
    bool logarithmic;
    double size;  // [unit of the left side]
  };

  const DesignProblem& problem_;
  Side value_side_;
  std::vector<Side> constraint_sides_;
};

}  // namespace rollres
