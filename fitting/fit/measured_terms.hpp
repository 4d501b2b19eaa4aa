#pragma once

/// What stands between a model and measured values: an offset (the friction of bearings), a scale (a gauge that is
/// off),
///
///     measured = scale * model + offset,
///
/// and what was known of parameters before the measurement (priors), which counts as another datum.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fitting/descent/fit_problem.hpp"

namespace rollres {

inline constexpr std::string_view offset_key = "offset", scale_key = "scale";
inline bool is_measured_term(std::string_view key) { return key == offset_key || key == scale_key; }

/// What was known of a parameter: its mean and standard deviation, or for a lognormal prior the median and the standard
/// deviation of the logarithm.
struct Prior {
  bool lognormal = false;
  double mean;       ///< [SI]
  double deviation;  ///< [SI], or [1]
};

/// Where an offset or a scale stands among the parameters, and the data that it acts on.
struct MeasuredTerm {
  std::string_view key;
  std::size_t parameter;
  std::vector<bool> acts;  ///< on each datum
};

/// The variable of such a term. @param unit  of the measured values   @param size  of an offset [SI]
Variable term_variable(std::string_view key, const Quantity& measured, double size);

/// The problem whose predictions pass these terms. The model is not asked again for points that differ in them only.
FitProblem with_terms(const FitProblem& model, std::vector<MeasuredTerm> terms);

/// What was known of parameters beside one another: the logarithm of `parameter` differs from that of `before` by zero,
/// with this standard deviation.
struct SmoothStep {
  std::size_t before, parameter;
  double deviation;  ///< [1]
};

/// The problem with a datum more for each parameter that has a prior, and for each step.
/// @param priors  one for each parameter
FitProblem with_priors(const FitProblem& problem, const std::vector<std::optional<Prior>>& priors,
                       const std::vector<SmoothStep>& steps = {});

}  // namespace rollres
