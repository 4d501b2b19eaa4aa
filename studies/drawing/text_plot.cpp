#include "studies/drawing/text_plot.hpp"

#include <algorithm>
#include <cmath>

#include "studies/drawing/chart_frame.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

struct PlotSpan : Span {
  double scaled(double value) const { return logarithmic ? std::log(value) : value; }
  /// One of so many places along the axis.
  std::size_t place(double value, std::size_t places) const {
    const double length = scaled(highest) - scaled(lowest);
    const double part = length > 0 ? (scaled(value) - scaled(lowest)) / length : 0.5;
    return static_cast<std::size_t>(std::lround(part * static_cast<double>(places - 1)));
  }
};

char letter_of(std::size_t curve, std::size_t curves) {
  return curves == 1 ? 'o' : static_cast<char>('a' + static_cast<char>(curve % 26));
}

}  // namespace

std::string text_plot(const TextPlotAxis& x, const TextPlotAxis& y, const std::vector<TextPlotCurve>& curves,
                      std::size_t width, std::size_t height) {
  PlotSpan across{{.logarithmic = x.logarithmic}}, up{{.logarithmic = y.logarithmic}};
  const auto is_shown = [&](const std::pair<double, double>& point) {
    return std::isfinite(point.first) && std::isfinite(point.second) && (!x.logarithmic || point.first > 0) &&
           (!y.logarithmic || point.second > 0);
  };
  for (const TextPlotCurve& curve : curves)
    for (const auto& point : curve.points)
      if (is_shown(point)) {
        across.include(point.first);
        up.include(point.second);
      }
  constexpr std::size_t digits = 4, narrowest = 30;
  if (across.lowest > across.highest || width < narrowest || height < 2) return {};
  const std::string top = short_number(up.highest, digits), bottom = short_number(up.lowest, digits);
  const std::size_t margin = std::max(top.size(), bottom.size()) + 2, columns = width - margin;
  std::vector<std::string> lines(height, std::string(columns, ' '));
  for (std::size_t i = 0; i < curves.size(); ++i)
    for (const auto& point : curves[i].points)
      if (is_shown(point))
        lines[height - 1 - up.place(point.second, height)][across.place(point.first, columns)] =
            letter_of(i, curves.size());

  std::string text = y.name + '\n';
  for (std::size_t i = 0; i < height; ++i) {
    const std::string number = i == 0 ? top : i + 1 == height ? bottom : "";
    std::string line = std::string(margin - 2 - number.size(), ' ') + number + " |" + lines[i];
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  const std::string left = short_number(across.lowest, digits), right = short_number(across.highest, digits);
  const std::size_t taken = left.size() + right.size();
  text += std::string(margin - 1, ' ') + '+' + std::string(columns, '-') + '\n' + std::string(margin, ' ') + left;
  if (taken + 1 < columns) {
    std::string between(columns - taken, ' ');
    if (rollres::width(x.name) + 2 <= between.size())
      between.replace((between.size() - rollres::width(x.name)) / 2, rollres::width(x.name), x.name);
    text += between + right;
  }
  text += '\n';
  std::string labels;
  for (std::size_t i = 0; curves.size() > 1 && i < curves.size(); ++i) {
    const std::string label = std::string(1, letter_of(i, curves.size())) + ' ' + curves[i].label;
    if (rollres::width(labels + label) + 2 > width) break;
    labels += (labels.empty() ? "" : "  ") + label;
  }
  return text + labels + (labels.empty() ? "" : "\n");
}

}  // namespace rollres
