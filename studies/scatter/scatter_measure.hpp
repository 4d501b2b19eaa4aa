#pragma once

/// One number that stands for what scatters, as a goal or a limit of a design takes it:
///
///     "mean"  "mean + 2 sd"  "mean - 1.5 sd"  "sd"  "P90"
///
/// sd is the standard deviation. A quantile is that of Harrell and Davis (smooth_quantile), which has no kink where two
/// values change places: at fixed points it is as smooth in a design as the values are.

#include <string>
#include <string_view>
#include <vector>

namespace rollres {

class ScatterMeasure {
 public:
  ScatterMeasure() = default;  ///< mean
  /// @throws std::invalid_argument "text: must be ..." unless it is one of the above
  explicit ScatterMeasure(std::string_view text);

  double operator()(const std::vector<double>& values) const;
  const std::string& text() const { return text_; }

 private:
  std::string text_ = "mean";
  double mean_ = 1, deviation_ = 0, probability_ = 0;  // factors of mean and deviation; a probability > 0: a quantile
};

}  // namespace rollres
