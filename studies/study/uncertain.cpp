#include "studies/study/uncertain.hpp"

#include "core/messages/message_text.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

Distribution UncertainInput::around(double value) const {
  return cut_off(relative ? times(distribution, value) : distribution, find_input(key)->quantity.range);
}

std::vector<std::vector<double>> uncertain_points(const UncertainInputs& uncertain) {
  auto uniform = batched_sample(uncertain.method, uncertain.scramblings, uncertain.points_of_each(),
                                uncertain.inputs.size(), uncertain.seed);
  correlate(uniform, correlation_factor(uncertain.inputs.size(), uncertain.correlations));
  return uniform;
}

std::vector<std::string> in_words(const UncertainInputs& uncertain, Body body) {
  std::vector<std::string> lines;
  for (const UncertainInput& input : uncertain.inputs) {
    const Quantity& quantity = find_input(input.key)->quantity;
    const std::string_view unit = quantity.unit_for(body);
    Distribution whole = input.relative ? times(input.distribution, input.about) : input.distribution;
    lines.push_back(input.key + ": " + in_words(whole, unit));
    if (input.truncated && weight_outside(whole, quantity.range) > negligible_weight)
      lines.back() += ", cut off where the input " + quantity.range.rule() + ": " +
                      short_number(100 * weight_outside(whole, quantity.range), 3) + " % of its weight";
  }
  for (const auto& [first, second, correlation] : uncertain.correlations)
    lines.push_back(uncertain.inputs[first].key + " and " + uncertain.inputs[second].key + ": correlation " +
                    short_number(correlation, 4));
  return lines;
}

}  // namespace rollres
