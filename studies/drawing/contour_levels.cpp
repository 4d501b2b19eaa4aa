#include "studies/drawing/contour_levels.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "studies/drawing/gnuplot.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

void write_contour_levels(std::ostream& script, const std::vector<ContourLoop>& loops, const Span& x, const Span& y,
                          const std::vector<std::array<double, 2>>& taken,
                          const std::function<bool(const std::array<double, 2>&)>& shown) {
  constexpr double apart = 0.105, smallest = 0.12;  // of the map
  const auto fraction = [&](const std::array<double, 2>& point) {
    return std::array<double, 2>{x.fraction(point[0]), y.fraction(point[1])};
  };
  std::vector<std::array<double, 2>> full;
  for (const auto& point : taken) full.push_back(fraction(point));
  script << "set style textbox opaque noborder fillcolor rgb 'white' margins 0.3,0.2\n";
  for (std::size_t number = 0; number < loops.size(); ++number) {
    const ContourLoop& loop = loops[number];
    const auto [lowest, highest] = std::minmax_element(
        loop.points.begin(), loop.points.end(), [](const auto& one, const auto& other) { return one[1] < other[1]; });
    if (fraction(*highest)[1] - fraction(*lowest)[1] < smallest) continue;
    const std::size_t size = loop.points.size();
    for (std::size_t step = 0; step < size; ++step) {
      const auto& point = loop.points[(number * size / 5 + step) % size];  // not all on one side
      const std::array<double, 2> at = fraction(point);
      if (at[0] < 0.06 || at[0] > 0.94 || at[1] < 0.05 || at[1] > 0.95 || (shown && !shown(point))) continue;
      if (any_of(full, [&](const auto& other) {
            return std::abs(other[0] - at[0]) < 1.4 * apart && std::abs(other[1] - at[1]) < 0.7 * apart;
          }))
        continue;
      full.push_back(at);
      script << "set label " << gnuplot::quoted(short_number(loop.level, 3)) << " at first " << short_number(point[0])
             << ", first " << short_number(point[1]) << " center boxed front font ',14'\n";
      break;
    }
  }
}

}  // namespace rollres
