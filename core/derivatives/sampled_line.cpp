#include "core/derivatives/sampled_line.hpp"

namespace rollres {

std::optional<SampledLine::Sample> SampledLine::at(double offset) {
  if (offset == 0) return Sample{0, centre_};
  std::vector<double> point = point_;
  double& input = point[input_];
  input = variable().value(variable().scaled(centre_input()) + offset);
  ++evaluations_;
  const ObjectiveValue answer = value_at(objective_, point);
  if (answer.found()) return Sample{variable().scaled_step(centre_input(), input), answer.value};
  failures_.push_back({input, answer.status, answer.reason});
  return std::nullopt;
}

}  // namespace rollres
