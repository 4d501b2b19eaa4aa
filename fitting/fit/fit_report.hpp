#pragma once

/// What a fit found, and how much of it can be trusted.

#include <string>
#include <vector>

#include "fitting/errors/fit_errors.hpp"
#include "fitting/errors/profile_likelihood.hpp"

namespace rollres {

/// In the order in which they are tested, from the worst: the first that holds is the status.
enum class FitStatus {
  not_converged,  ///< no start had a prediction; or the slopes are noise (an estimated error of half their size or
                  ///< more, that the data would feel), or leave a parameter uncertain by three standard errors; or the
                  ///< least misfit is thought to be farther away than a tenth of a standard error and than the noise of
                  ///< the model explains
  did_not_move,   ///< every descent that led here ended where it began, which is no proof of a least misfit
  misfit,  ///< the residuals are far larger than the deviations explain (p < 1e-3 and a reduced chi squared above
           ///< 4), or without deviations a third of the values, or a fifth and with a system: errors mean little
  not_identified,  ///< the data do not bound a parameter: an interval is open, or along the weakest direction the
                   ///< parameters change by a factor of e or more within one standard deviation
  usable_with_warnings,
  good  ///< a least misfit that the parameters are bound to, that the deviations explain, and nothing to warn of
};
template <>
struct ChoiceNames<FitStatus> {
  static constexpr std::array<std::string_view, 6> names{"NOT CONVERGED",  "DID NOT MOVE",         "MISFIT",
                                                         "NOT IDENTIFIED", "USABLE WITH WARNINGS", "GOOD"};
};

/// What is known of one parameter.
struct FittedParameter {
  FitParameter parameter;
  double value;               ///< [SI]
  double standard_error;      ///< [SI] linear; NaN at a bound
  double relative_error;      ///< of the scaled variable: of a positive quantity relative, else over its size
  ConfidenceInterval linear;  ///< 95 %: symmetric in the scaled variable; open where that is not bounded
  Profile profile;            ///< 95 %; without points if profiles were not wanted
  double step;                ///< of the differences, scaled
  double slope_doubt;         ///< estimated error of the slopes over the slopes
  AtBound at_bound;
  std::string flag;  ///< "at its lower bound", "not bounded above", ...; empty: nothing to mind
};

/// One measured value and what the fit makes of it.
struct FittedValue {
  MeasuredValue measured;
  double predicted;  ///< [SI]
  double residual;   ///< (predicted - measured) / deviation
  double band;       ///< standard error of the prediction by the errors of the parameters [SI]
};

/// A term of the noise of measured values, where that is fitted (noise_fit.hpp).
struct LikelyNoise {
  std::string name;
  bool relative;  ///< a part of what is predicted [1]; else a level [SI]
  double value;   ///< 0: it explains nothing
  double standard_error;
  double highest = RollingSolution::absent;  ///< end of its 95 % interval by likelihood; NaN of the term that tells most
};

struct FitReport {
  FitStatus status = FitStatus::not_converged;
  std::string reason;                 ///< of the status, in words; empty if usable
  std::vector<std::string> warnings;  ///< each one line

  std::vector<FittedParameter> parameters;
  std::vector<FittedValue> values;
  bool deviations_known = false;
  int degrees = 0;                               ///< of freedom
  double chi_squared = RollingSolution::absent;  ///< sum of the losses; without known deviations in their unit [1]
  double reduced_chi_squared = RollingSolution::absent;
  double p_value = RollingSolution::absent;  ///< that chi squared is as large by chance; NaN without known deviations
  double rms = RollingSolution::absent;      ///< root mean square of prediction - measurement [SI]
  double relative_rms = RollingSolution::absent;   ///< of the same over the measured values
  double runs_p_value = RollingSolution::absent;   ///< runs test of the residuals in the order of the data
  double trend_p_value = RollingSolution::absent;  ///< the same in the order of the predicted values
  std::size_t largest_residual = 0;                ///< its place in `values`
  double noise = RollingSolution::absent;  ///< of the model: largest standard deviation over the predicted value

  FitErrors errors;
  std::string weakest_direction;  ///< in words
  int starts = 0, agreeing = 0;   ///< descents, and those that led to the same least misfit
  std::string second_best;        ///< another least misfit that the data do not tell from the best, in words
  bool moved = false;             ///< one of these began elsewhere
  int iterations = 0;             ///< of the best descent
  std::string stopped;            ///< Ceres's words on it
  bool interrupted = false;       ///< by a wish from outside or a limit: the best so far
  std::string ended;              ///< which of them
  std::size_t enough = 0;         ///< solutions with which profiles were left out; 0: none was
  std::string misfit_cause;       ///< what most likely makes a MISFIT, in words; empty: nothing stands out
  std::size_t evaluations = 0, failures = 0;
  std::vector<EvaluationLog::Failure> failure_reasons;
  Slopes slopes;                              ///< at the fit
  std::vector<LikelyNoise> noise_terms = {};  ///< where the noise is fitted

  FitPoint point() const;
};

/// The pair of parameters with the largest correlation; the first two if none is known.
struct ParameterPair {
  std::size_t first, second;
};
ParameterPair worst_pair(const FitReport& report);

/// "static_shear_modulus x 1.35 with creep_time x 0.74 raises chi squared by 1".
std::string weakest_direction_in_words(const FitProblem& problem, const FitErrors& errors);

/// The combinations of parameters that are known, and how well: "creep_time x stiffening^0.34 to 0.6 %"; empty if none
/// is.
std::string known_combinations(const FitProblem& problem, const FitErrors& errors);

/// The parameters that share the weakest direction: "static_shear_modulus and creep_time".
std::string weakest_parameters(const FitProblem& problem, const FitErrors& errors);

}  // namespace rollres
