#include <algorithm>
#include <cmath>
#include <sstream>

#include "studies/drawing/chart_frame.hpp"
#include "studies/drawing/gnuplot.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

struct Layout {
  Span x, y;
};

/// A rectangle of the plot, in fractions of its sides.
struct Box {
  double x, y, half_width, half_height;

  bool holds(double at_x, double at_y) const {
    return std::abs(at_x - x) < half_width && std::abs(at_y - y) < half_height;
  }
  bool meets(const Box& other) const {
    return std::abs(other.x - x) < half_width + other.half_width &&
           std::abs(other.y - y) < half_height + other.half_height;
  }
  /// Whether the line or a point of a curve runs through.
  bool meets(const ChartCurve& curve, const Layout& layout) const {
    constexpr int parts = 8;
    const auto& points = curve.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!points[i].drawn()) continue;
      const double x0 = layout.x.fraction(points[i].x), y0 = layout.y.fraction(points[i].y);
      if (holds(x0, y0)) return true;
      if (i + 1 == points.size() || !points[i].joined() || !points[i + 1].joined()) continue;
      const double x1 = layout.x.fraction(points[i + 1].x), y1 = layout.y.fraction(points[i + 1].y);
      for (int part = 1; part < parts; ++part)
        if (const double t = static_cast<double>(part) / parts; holds(x0 + t * (x1 - x0), y0 + t * (y1 - y0)))
          return true;
    }
    return false;
  }
};

/// Axes that hold all points with a value, with room above the highest; a linear y starts at zero where no value is
/// negative and the smallest is at most half the largest.
Layout lay_out(const ChartRequest& request) {
  Layout layout;
  for (const ChartCurve& curve : request.curves)
    for (const ChartPoint& point : curve.points) {
      if (std::isfinite(point.x)) layout.x.include(point.x);
      if (point.drawn()) layout.y.include(point.y);
    }
  auto& [x, y] = layout;
  x.logarithmic = request.x.logarithmic && x.lowest > 0;
  y.logarithmic = request.y.logarithmic && y.lowest > 0;
  for (const ChartCurve& curve : request.curves)
    for (const ChartPoint& point : curve.points)
      if (!y.logarithmic && point.joined() && point.area()) {
        y.include(std::max(point.low, point.y - std::abs(point.y)));
        y.include(std::min(point.high, point.y + std::abs(point.y)));
      }
  x.widen(request.x.margin, request.x.margin);
  const bool from_zero = !y.logarithmic && y.lowest >= 0 && y.lowest <= 0.5 * y.highest && y.highest > 0;
  y.widen(0.06, request.mark_peaks ? 0.14 : 0.06);  // above: room for the value of a peak
  if (from_zero) y.lowest = 0;
  return layout;
}

/// Whether any area is wide enough to be drawn.
bool areas_are_seen(const ChartRequest& request, const Layout& layout) {
  constexpr double narrowest = 0.008;
  const auto place = [&](double y) { return layout.y.fraction(std::max(y, layout.y.lowest)); };
  return std::any_of(request.curves.begin(), request.curves.end(), [&](const ChartCurve& curve) {
    return std::any_of(curve.points.begin(), curve.points.end(), [&](const ChartPoint& point) {
      return point.joined() && point.area() && place(point.high) - place(point.low) > narrowest;
    });
  });
}

/// The value of a peak, to be written above or below it.
struct PeakValue {
  std::size_t curve;
  ChartPoint point;
  std::string text;  ///< three significant digits, more where the axis spans little of the value
  bool above;
};

/// The values of those peaks (the highest first) that have room for it: no curve, no other peak and no other value is
/// covered.
std::vector<PeakValue> peak_values(const ChartRequest& request, const Layout& layout) {
  struct Top {
    std::size_t curve;
    ChartPoint point;
  };
  std::vector<Top> tops;
  for (std::size_t i = 0; i < request.curves.size(); ++i)
    if (const auto place = peak(request.curves[i])) tops.push_back({i, request.curves[i].points[*place]});
  std::stable_sort(tops.begin(), tops.end(), [](const Top& a, const Top& b) { return a.point.y > b.point.y; });

  std::vector<Box> taken;  // first by the rings
  for (const Top& top : tops)
    taken.push_back({layout.x.fraction(top.point.x), layout.y.fraction(top.point.y), 0.014, 0.02});
  std::vector<PeakValue> values;
  for (const auto& [i, top] : tops) {
    const double fineness = layout.y.logarithmic ? 1 : std::abs(top.y) / (layout.y.highest - layout.y.lowest);
    const std::string value = short_number(top.y, 3 + static_cast<int>(std::log10(std::max(1.0, fineness))));
    const double x = layout.x.fraction(top.x), y = layout.y.fraction(top.y);
    for (const int side : {1, -1}) {
      const Box box{x, y + 0.075 * side, 0.012 * static_cast<double>(value.size()) + 0.005, 0.04};
      const bool inside = box.y - box.half_height > 0 && box.y + box.half_height < 1.02 &&
                          box.x - box.half_width > -0.02 && box.x + box.half_width < 1.02;
      if (!inside || std::any_of(taken.begin(), taken.end(), [&](const Box& other) { return box.meets(other); }) ||
          std::any_of(request.curves.begin(), request.curves.end(),
                      [&](const ChartCurve& curve) { return box.meets(curve, layout); }))
        continue;
      values.push_back({i, top, value, side > 0});
      taken.push_back(box);
      break;
    }
  }
  return values;
}

/// Look of the n-th curve. The periods 7, 6 and 5 of colours, marks and dashes have no common factor, so 210 curves
/// differ.
struct Look {
  std::string_view colour;
  int filled, hollow;  // gnuplot's point types
  std::string_view dash;
};
Look look(std::size_t curve) {
  constexpr std::array<int, 6> filled{7, 5, 9, 13, 11, 15}, hollow{6, 4, 8, 12, 10, 14};
  constexpr std::array<std::string_view, 5> dashes{"1", "(10,4)", "(3,3)", "(10,3,2,3)", "(6,2)"};
  return {curve_colour(curve), filled[curve % filled.size()], hollow[curve % hollow.size()],
          dashes[curve % dashes.size()]};
}

void write_peak_values(std::ostream& script, const ChartRequest& request, const Layout& layout) {
  for (const PeakValue& value : peak_values(request, layout))
    script << "set label " << gnuplot::quoted(value.text) << " at first " << short_number(value.point.x, 15)
           << ", first " << short_number(value.point.y, 15) << " center offset 0," << (value.above ? "0.9" : "-0.9")
           << " tc rgb '" << look(value.curve).colour << "' front\n";
}

/// Crosses on the lower edge for points that have no value, each curve on its own level.
bool write_crosses(std::ostream& script, const ChartRequest& request) {
  bool any = false;
  for (std::size_t i = 0; i < request.curves.size(); ++i)
    for (const ChartPoint& point : request.curves[i].points) {
      if (point.converged || std::isfinite(point.y) || !std::isfinite(point.x)) continue;
      script << "set label '' at first " << short_number(point.x, 15) << ", graph "
             << short_number(0.025 + 0.03 * static_cast<double>(i % 6)) << " point pt 2 ps 0.7 lw 1.5 lc rgb '"
             << look(i).colour << "' front\n";
      any = true;
    }
  return any;
}

std::vector<LegendEntry> legend(const ChartRequest& request, bool crosses, bool areas) {
  std::vector<LegendEntry> entries;
  bool hollow = false;
  for (std::size_t i = 0; i < request.curves.size(); ++i) {
    const auto& [label, points] = request.curves[i];
    hollow |= std::any_of(points.begin(), points.end(), [](const auto& p) { return p.drawn() && !p.converged; });
    if (label.empty()) continue;
    const std::string& symbol = request.family.symbol;
    const std::string equals = symbol.empty() ? "" : gnuplot::symbol(symbol) + " = ";
    entries.push_back({(!request.lines  ? "points linetype "
                        : request.marks ? "linespoints linetype "
                                        : "lines linetype ") +
                           std::to_string(i + 1),
                       equals + gnuplot::plain(label) + kept_blanks,
                       width(label) + (symbol.empty() ? 0 : width(symbol) + 3)});
  }
  const std::string grey = " lw 1.5 lc rgb '#444444'";
  if (hollow) entries.push_back({"points pt 6 ps 0.7" + grey, "not converged", 13});
  if (areas && !request.areas.empty())
    entries.push_back({"boxes fc rgb '#444444' fs transparent solid 0.2 noborder", gnuplot::plain(request.areas),
                       width(request.areas)});
  if (crosses) entries.push_back({"points pt 2 ps 0.7" + grey, "no answer", 9});
  return entries;
}

/// The areas of the curves: bands, parts of a stack, or error bars where no line joins the points.
std::vector<std::string> area_plots(const ChartRequest& request) {
  std::vector<std::string> parts;
  const std::string depth = request.areas.empty() ? "0.45" : "0.2";
  for (std::size_t i = 0; i < request.curves.size(); ++i) {
    const std::string data = "data index " + std::to_string(i), colour = "'" + std::string(look(i).colour) + "'";
    if (request.lines)
      parts.push_back(data + " using 1:5:6 with filledcurves fc rgb " + colour + " fs transparent solid " + depth +
                      " noborder notitle");
    else
      parts.push_back(data + " using 1:2:5:6 with yerrorbars pt 0 lw 1.2 lc rgb " + colour + " notitle");
  }
  return parts;
}

/// What is plotted, without the legend.
std::vector<std::string> plots(const ChartRequest& request, bool areas) {
  std::vector<std::string> parts;
  if (areas) parts = area_plots(request);
  for (std::size_t i = 0; i < request.curves.size(); ++i) {
    const auto& points = request.curves[i].points;
    const std::string data = "data index " + std::to_string(i) + " using 1:($3 == ";
    const std::string type = "linetype " + std::to_string(i + 1) + " notitle";
    if (std::any_of(points.begin(), points.end(), [](const auto& point) { return point.joined(); })) {
      if (request.lines) parts.push_back(data + "1 ? $2 : NaN) with lines " + type);
      if (!request.lines || request.marks) parts.push_back(data + "1 && $4 == 1 ? $2 : NaN) with points " + type);
    }
    if (std::any_of(points.begin(), points.end(), [](const auto& p) { return p.drawn() && !p.converged; }))
      parts.push_back(data + "0 ? $2 : NaN) with points pt " + std::to_string(look(i).hollow) +
                      " ps 0.7 lw 1.5 lc rgb '" + std::string(look(i).colour) + "' notitle");
  }
  if (request.lines && request.mark_peaks)
    for (std::size_t i = 0; i < request.curves.size(); ++i)
      if (const auto top = peak(request.curves[i])) {
        const std::string row = std::to_string(*top);
        parts.push_back("data index " + std::to_string(i) + " every ::" + row + "::" + row +
                        " using 1:2 with points pt 6 ps 1.3 lw 1.5 lc rgb '" + std::string(look(i).colour) +
                        "' notitle");
      }
  return parts;
}

}  // namespace

std::string chart_script(const ChartRequest& request, const ChartFiles& files) {
  const Layout layout = lay_out(request);
  std::ostringstream script;
  write_axes(script, files, request.x, layout.x, request.y, layout.y);
  for (std::size_t i = 0; i < request.curves.size(); ++i)
    script << "set linetype " << i + 1 << " lc rgb '" << look(i).colour << "' lw 2 dt " << look(i).dash << " pt "
           << look(i).filled << " ps 0.7\n";
  script << "\n";
  if (request.lines && request.mark_peaks) write_peak_values(script, request, layout);
  const bool areas = areas_are_seen(request, layout);
  const std::vector<LegendEntry> entries = legend(request, write_crosses(script, request), areas);
  write_pictures(script, files, request.title, plots(request, areas), entries);
  return script.str();
}

}  // namespace rollres
