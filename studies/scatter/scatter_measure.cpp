#include "studies/scatter/scatter_measure.hpp"

#include <regex>
#include <stdexcept>

#include "studies/scatter/scatter_statistics.hpp"
#include "studies/text/units.hpp"

namespace rollres {

ScatterMeasure::ScatterMeasure(std::string_view given) : text_(given) {
  static const std::regex moments(R"(\s*mean\s*(?:([+-])\s*([0-9.]+)\s*(?:sd|sigma))?\s*)"), alone(R"(\s*sd\s*)"),
      quantile(R"(\s*P([0-9.]+)\s*)");
  std::smatch found;
  const std::string rule = text_ + ": must be \"mean\", \"mean + 2 sd\", \"mean - 2 sd\", \"sd\" or \"P90\"";
  const auto number = [&](const std::string& digits) {
    const auto read = plain_number(digits);
    if (!read) throw std::invalid_argument(rule);
    return *read;
  };
  if (std::regex_match(text_, found, moments)) {
    if (found[1].matched) deviation_ = (found[1] == "-" ? -1 : 1) * number(found[2]);
  } else if (std::regex_match(text_, alone)) {
    mean_ = 0;
    deviation_ = 1;
  } else if (std::regex_match(text_, found, quantile)) {
    probability_ = number(found[1]) / 100;
    if (!(probability_ > 0 && probability_ < 1)) throw std::invalid_argument(rule);
  } else {
    throw std::invalid_argument(rule);
  }
}

double ScatterMeasure::operator()(const std::vector<double>& values) const {
  if (probability_ > 0) return smooth_quantile(values, probability_);
  const ScatterStatistics statistics = scatter_statistics({values}, {});
  const double deviation = values.size() > 1 ? statistics.deviation.value : 0;
  return mean_ * statistics.mean.value + deviation_ * deviation;
}

}  // namespace rollres
