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

/// What was known before the measurement, as another datum: a sum of parameters or of their logarithms.
struct KnownBefore {
  struct Part {
    std::size_t parameter;
    bool logarithm;
    double weight = 1;
  };
  std::vector<Part> parts;
  double mean = 0, deviation = 1;
  std::string of;  ///< for messages: "creep_time"
};

/// A parameter of a former fit: its value there, and the standard error of the value or of its logarithm.
struct FormerParameter {
  std::size_t parameter;
  bool logarithm;
  double value, deviation;
  std::string name;
};

KnownBefore known_before(const Prior& prior, std::size_t parameter, const std::string& name);
/// That the logarithm of a parameter differs from that of another by zero, with this standard deviation.
KnownBefore smooth_step(std::size_t before, std::size_t parameter, double deviation, const std::string& name);
/// What a former fit said of several parameters together: as many independent sums. @param correlation  symmetric
/// @throws std::invalid_argument if the correlations contradict one another
std::vector<KnownBefore> known_before(const std::vector<FormerParameter>& former, const Eigen::MatrixXd& correlation);

/// The problem with a datum more for each.
FitProblem with_priors(const FitProblem& problem, const std::vector<KnownBefore>& known);

}  // namespace rollres
