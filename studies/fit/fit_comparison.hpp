#pragma once

/// Fits of several models to the same data, compared.
///
/// With n values, k parameters and -2 ln L = chi squared (deviations known) or n ln(chi squared / n) (their common
/// scale is one parameter more):
///     AICc = -2 ln L + 2 k + 2 k (k + 1) / (n - k - 1),   BIC = -2 ln L + k ln n,
/// (where the noise is fitted, in any of the fits, with the logarithms of the variances, and its terms are parameters),
/// and weights exp(-ΔAICc/2) that add up to 1. Of two models one of which is a case of the other, the rise of -2 ln L
/// is distributed as chi squared of as many degrees as it has parameters less, if it is true; at a bound of the larger
/// model the probability given is up to twice too large.
/// @see Hurvich and Tsai (1989), Biometrika 76, 297; Burnham and Anderson (2002), Model Selection and Multimodel
///      Inference; Wilks (1938), Annals of Mathematical Statistics 9, 60

#include <optional>
#include <string>
#include <vector>

#include "studies/fit/fit_file.hpp"
#include "studies/fit/material_file.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// One fit; either of resistance or of a material.
struct FitCandidate {
  std::string source, name, model;  ///< model in words: "zener", "prony, 2 terms"
  FitReport report = {};
  std::optional<FitFile> resistance = {};
  std::optional<MaterialFile> file = {};
  std::optional<MaterialFit> material = {};
  ShiftLaw shift_law = ShiftLaw::none;  ///< of a fit of shift factors
};

struct ComparedFit {
  std::string name, model, status;
  bool usable = false;  ///< at least with warnings
  int parameters = 0;
  double chi_squared = 0, likelihood = 0;  ///< likelihood: -2 ln L
  double aicc = 0, bic = 0, weight = 0;    ///< aicc infinite with too few values
};

struct LikelihoodRatio {
  std::string small, large;  ///< fits; the first is a case of the second
  double rise = 0;           ///< of -2 ln L
  int degrees = 0;
  double p_value = 0;
};

/// Where the two best fits differ most, in deviations of one more measurement there and of both predictions.
struct LargestDifference {
  std::string first, second, where;  ///< fits; "loss_modulus at 120 Hz"
  std::string_view unit;
  double values[2] = {}, deviations = 0;
  std::vector<std::pair<std::string, double>> inputs = {};  ///< of a scene that is not measured yet [SI]
};

struct FitComparison {
  std::vector<ComparedFit> fits;  ///< the least AICc first
  std::vector<LikelihoodRatio> ratios;
  std::optional<LargestDifference> difference;
  std::optional<LargestDifference> next;  ///< of scenes: anywhere in the design space of the best fit
};

/// @param fits      two at least
/// @param evaluate  for scenes that are not measured, where the two best are fits of scenes; may be empty
/// @param jobs      threads; 0: one for each core
/// @throws std::invalid_argument if they are not of the same data with the same deviations (where these are not
///         fitted), or if one has a robust loss
FitComparison compare(const std::vector<FitCandidate>& fits, const Evaluate& evaluate = {}, int jobs = 0);

std::string comparison_summary(const FitComparison& comparison);
Json json_of(const FitComparison& comparison);

}  // namespace rollres
