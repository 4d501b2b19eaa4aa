#include "studies/evidence/power_law.hpp"

#include <algorithm>
#include <cmath>

namespace rollres {

double quantile(std::vector<double> values, double part) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double place = std::ceil(part * static_cast<double>(values.size())) - 1;
  return values[static_cast<std::size_t>(std::max(0.0, place))];
}

PowerLaw power_law(const std::vector<double>& x, const std::vector<double>& y, std::size_t fewest) {
  PowerLaw law;
  const std::size_t count = x.size();
  if (count < fewest) return law;
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < count; ++i) {
    mean_x += std::log(x[i]) / static_cast<double>(count);
    mean_y += std::log(y[i]) / static_cast<double>(count);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double dx = std::log(x[i]) - mean_x, dy = std::log(y[i]) - mean_y;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  if (xx == 0) return law;
  law.slope = xy / xx;
  if (count > 2) law.deviation = std::sqrt(std::max(0.0, yy - xy * xy / xx) / static_cast<double>(count - 2) / xx);
  return law;
}

void SolveCost::add(double spacing, double seconds) {
  constexpr double shortest = 1e-9;  // what a clock may call nothing
  spacings_.push_back(spacing);
  seconds_.push_back(std::max(seconds, shortest));
}

double SolveCost::predicted(double spacing) const {
  if (spacings_.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto last = static_cast<std::ptrdiff_t>(std::min<std::size_t>(3, spacings_.size()));
  const PowerLaw law = power_law({spacings_.end() - last, spacings_.end()}, {seconds_.end() - last, seconds_.end()}, 2);
  const double growth = std::isnan(law.slope) ? dimension_ : std::clamp(-law.slope, dimension_, 3 * dimension_);
  return seconds_.back() * std::pow(spacings_.back() / spacing, growth);
}

}  // namespace rollres
