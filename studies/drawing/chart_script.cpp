#include <algorithm>
#include <cmath>
#include <sstream>

#include "studies/drawing/chart_frame.hpp"
#include "studies/drawing/colour_map.hpp"
#include "studies/drawing/gnuplot.hpp"
#include "studies/drawing/peak_values.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

using Layout = ChartSpans;

constexpr std::string_view shaded = "fc rgb '#7f7f7f' fs transparent solid 0.2 noborder";
constexpr double end_label_height = 17;  // of a curve's label at its end [px]

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
  if (request.range) {
    x.include(request.range->from);
    x.include(request.range->to);
  }
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
  return any_of(request.curves, [&](const ChartCurve& curve) {
    return any_of(curve.points, [&](const ChartPoint& point) {
      return point.joined() && point.area() && place(point.high) - place(point.low) > narrowest;
    });
  });
}

/// Whether the curves bear their labels, and the values of their peaks, at their ends: many curves in an order.
bool labels_at_ends(const ChartRequest& request) {
  constexpr std::size_t most_in_legend = 5;
  return request.ordered && request.end_labels && request.lines && request.curves.size() > most_in_legend;
}

bool joined(const ChartRequest& request, const ChartCurve& curve) { return request.lines && curve.line; }

/// Look of the n-th curve. The periods 7, 6 and 5 of colours, marks and dashes have no common factor, so 210 curves
/// differ.
struct Look {
  std::string colour;
  int filled, hollow;  // gnuplot's point types
  std::string_view dash;
};
constexpr std::string_view extrapolated_dash = "(10,6)";

bool extrapolates(const ChartRequest& request) {
  return any_of(request.curves, [](const auto& curve) { return curve.extrapolated; });
}

Look look(const ChartRequest& request, std::size_t curve) {
  const bool dashed = request.curves[curve].extrapolated, solid = !dashed && extrapolates(request);
  curve = request.curves[curve].like.value_or(curve);
  const std::size_t count = request.curves.size();
  constexpr std::array<int, 6> filled{7, 5, 9, 13, 11, 15}, hollow{6, 4, 8, 12, 10, 14};
  constexpr std::array<std::string_view, 5> dashes{"1", "(10,4)", "(3,3)", "(10,3,2,3)", "(6,2)"};
  if (!request.families.empty()) {
    const auto [first, second] = request.curves[curve].place;
    return {ordered_colour(first, request.families.front().labels.size()), filled[second % filled.size()],
            hollow[second % hollow.size()], dashes[second % dashes.size()]};
  }
  if (labels_at_ends(request)) return {ordered_colour(curve, count), 7, 6, "1"};
  const bool ordered = request.ordered && count > 2;
  return {ordered ? ordered_colour(curve, count) : std::string(curve_colour(curve)), filled[curve % filled.size()],
          hollow[curve % hollow.size()], dashed ? extrapolated_dash : dashes[solid ? 0 : curve % dashes.size()]};
}

void write_peak_values(std::ostream& script, const ChartRequest& request, const Layout& layout) {
  for (const PeakValue& value : peak_values(request, layout)) {
    const std::string colour = letter_colour(look(request, value.curve).colour);
    const LabelBox& box = value.box;
    script << "set label " << gnuplot::quoted(value.text) << " at graph " << short_number(box.x, 4) << ", graph "
           << short_number(box.y, 4) << " center tc rgb '" << colour << "' front\n";
    const double x = layout.x.fraction(value.point.x), y = layout.y.fraction(value.point.y);
    const double across = std::max(std::abs(x - box.x) - box.half_width, 0.0),
                 up = std::max(std::abs(y - box.y) - box.half_height, 0.0);
    constexpr double near = 0.06;
    if (std::hypot(across, up) < near) continue;
    script << "set arrow from first " << short_number(value.point.x, 15) << ", first "
           << short_number(value.point.y, 15) << " to graph "
           << short_number(std::clamp(x, box.x - box.half_width, box.x + box.half_width), 4) << ", graph "
           << short_number(std::clamp(y, box.y - 0.6 * box.half_height, box.y + 0.6 * box.half_height), 4)
           << " nohead lw 0.8 lc rgb '" << colour << "' front\n";
  }
}

void write_peak_rings(std::ostream& script, const ChartRequest& request, const Layout& layout) {
  if (!request.lines || !request.mark_peaks) return;
  for (std::size_t i = 0; i < request.curves.size(); ++i)
    if (const auto top = curve_peak(request.curves[i], layout))
      script << "set label '' at first " << short_number(top->x, 15) << ", first " << short_number(top->y, 15)
             << " point pt 6 ps 1.3 lw 1.5 lc rgb '" << look(request, i).colour << "' front\n";
}

/// Labels of the curves at the right of the plot, in the order of the curves' ends, with a line to each of them.
void write_end_labels(std::ostream& script, const ChartRequest& request, const Layout& layout, double from_top) {
  struct End {
    std::size_t curve;
    ChartPoint point;
    double at;  // height of the label, as a fraction of the plot
  };
  std::vector<End> ends;
  for (std::size_t i = 0; i < request.curves.size(); ++i) {
    const auto& points = request.curves[i].points;
    const auto last = std::find_if(points.rbegin(), points.rend(), [](const auto& point) { return point.joined(); });
    if (last != points.rend()) ends.push_back({i, *last, layout.y.fraction(last->y)});
  }
  stable_sort(ends, [](const End& a, const End& b) { return a.at < b.at; });
  // As low as they may stand, then down from the top where they came too high.
  const double step = end_label_height / from_top;
  for (std::size_t i = 0; i < ends.size(); ++i) ends[i].at = std::max(ends[i].at, i == 0 ? 0.0 : ends[i - 1].at + step);
  double limit = 1.0;
  for (auto end = ends.rbegin(); end != ends.rend(); ++end, limit -= step) end->at = std::min(end->at, limit);
  const bool peaks =
      any_of(ends, [&](const End& end) { return request.mark_peaks && peak(request.curves[end.curve]); });
  const std::string symbol =
      request.family.symbol.empty() ? gnuplot::plain(request.family.name) : gnuplot::symbol(request.family.symbol);
  script << "set label " << gnuplot::quoted(symbol + (peaks ? ": peak" : "") + kept_blanks)
         << " at graph 1.06, graph 1.06 left font ',14'\n";
  for (const End& end : ends) {
    const ChartCurve& curve = request.curves[end.curve];
    const std::string colour = look(request, end.curve).colour;
    std::string text = gnuplot::plain(curve.label);
    if (const auto top = request.mark_peaks ? curve_peak(curve, layout) : std::nullopt)
      text += ": " + peak_text(*top, layout);
    script << "set label " << gnuplot::quoted(text + kept_blanks) << " at graph 1.06, graph " << short_number(end.at, 4)
           << " left font ',14' tc rgb '" << letter_colour(colour) << "'\n"
           << "set arrow from first " << short_number(end.point.x, 15) << ", first " << short_number(end.point.y, 15)
           << " to graph 1.05, graph " << short_number(end.at, 4) << " nohead lw 1 lc rgb '" << colour << "'\n";
  }
}

/// Room for them, right of the plot [px].
double end_labels_width(const ChartRequest& request) {
  constexpr double letter = 7.6, lead = 40;
  std::size_t longest = 0;
  for (const ChartCurve& curve : request.curves)
    longest = std::max(longest, width(curve.label) + (request.mark_peaks && peak(curve) ? 7 : 0));
  return lead + letter * static_cast<double>(longest);
}

/// Crosses on the lower edge for points that have no value, each curve on its own level.
bool write_crosses(std::ostream& script, const ChartRequest& request) {
  bool any = false;
  for (std::size_t i = 0; i < request.curves.size(); ++i)
    for (const ChartPoint& point : request.curves[i].points) {
      if (point.converged || std::isfinite(point.y) || !std::isfinite(point.x)) continue;
      script << "set label '' at first " << short_number(point.x, 15) << ", graph "
             << short_number(0.025 + 0.03 * static_cast<double>(i % 6)) << " point pt 2 ps 0.7 lw 1.5 lc rgb '"
             << look(request, i).colour << "' front\n";
      any = true;
    }
  return any;
}

/// "H = 5 mm"; a number without a symbol and without a unit bears its name.
LegendEntry value_entry(const std::string& sample, const ChartAxis& family, bool number, const std::string& label) {
  const bool named = family.symbol.empty() && number && family.unit.empty() && !family.name.empty();
  const std::string before = named ? family.name : family.symbol;
  const std::string markup = named ? gnuplot::plain(before) : gnuplot::symbol(before);
  return {sample, (before.empty() ? "" : markup + " = ") + gnuplot::plain(label) + kept_blanks,
          width(label) + (before.empty() ? 0 : width(before) + 3)};
}

/// The values of two families: colours without marks, then marks without colour.
std::vector<LegendEntry> legend_of_families(const ChartRequest& request) {
  std::vector<LegendEntry> entries;
  for (std::size_t family = 0; family < request.families.size(); ++family) {
    const auto& [axis, labels] = request.families[family];
    for (std::size_t value = 0; value < labels.size(); ++value) {
      const auto curve = find_if(request.curves, [&](const ChartCurve& one) { return one.place[family] == value; });
      if (curve == request.curves.end()) continue;
      const Look like = look(request, static_cast<std::size_t>(curve - request.curves.begin()));
      const std::string sample = family == 0 ? "lines lw 5 dt 1 lc rgb '" + like.colour + "'"
                                             : "linespoints lw 2 dt " + std::string(like.dash) + " pt " +
                                                   std::to_string(like.filled) + " ps 0.7 lc rgb '#444444'";
      entries.push_back(value_entry(sample, axis, true, labels[value]));
      entries.back().new_row = value == 0;
    }
  }
  return entries;
}

std::vector<LegendEntry> legend(const ChartRequest& request, bool crosses, bool areas) {
  std::vector<LegendEntry> entries = legend_of_families(request);
  bool hollow = false;
  for (std::size_t i = 0; i < request.curves.size(); ++i) {
    const ChartCurve& curve = request.curves[i];
    hollow |= any_of(curve.points, [](const auto& p) { return p.drawn() && !p.converged; });
    if (curve.label.empty() || curve.like || labels_at_ends(request) || !request.families.empty()) continue;
    const char* const sample = !joined(request, curve)        ? "points linetype "
                               : request.marks && curve.marks ? "linespoints linetype "
                                                              : "lines linetype ";
    entries.push_back(value_entry(sample + std::to_string(i + 1), request.family, request.ordered, curve.label));
  }
  const std::size_t curves = entries.size();
  const std::string grey = " lw 1.5 lc rgb '#444444'";
  if (extrapolates(request))
    entries.push_back({"lines dt " + std::string(extrapolated_dash) + grey, "extrapolated", 12});
  if (hollow) entries.push_back({"points pt 6 ps 0.7" + grey, gnuplot::plain(request.hollow), width(request.hollow)});
  if (areas && !request.areas.empty())
    entries.push_back({"boxes fc rgb '#444444' fs transparent solid 0.2 noborder", gnuplot::plain(request.areas),
                       width(request.areas)});
  if (request.range)
    entries.push_back(
        {"boxes " + std::string(shaded), gnuplot::plain(request.range->meaning), width(request.range->meaning)});
  if (crosses) entries.push_back({"points pt 2 ps 0.7" + grey, "no answer", 9});
  if (entries.size() > curves) entries[curves].new_row = true;
  return entries;
}

/// The areas of the curves: bands, parts of a stack, or error bars where no line joins the points.
std::vector<std::string> area_plots(const ChartRequest& request) {
  std::vector<std::string> parts;
  const std::string depth = request.areas.empty() ? "0.45" : "0.2";
  for (std::size_t i = 0; i < request.curves.size(); ++i) {
    const std::string data = "data index " + std::to_string(i), colour = "'" + look(request, i).colour + "'";
    const auto& points = request.curves[i].points;
    const bool in_a_row = std::adjacent_find(points.begin(), points.end(), [](const auto& a, const auto& b) {
                            return a.joined() && b.joined();
                          }) != points.end();
    if (joined(request, request.curves[i]) && in_a_row)
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
    if (any_of(points, [](const auto& point) { return point.joined(); })) {
      const bool line = joined(request, request.curves[i]);
      if (line) parts.push_back(data + "1 ? $2 : NaN) with lines " + type);
      if (!line || request.marks) parts.push_back(data + "1 && $4 == 1 ? $2 : NaN) with points " + type);
    }
    if (any_of(points, [](const auto& p) { return p.drawn() && !p.converged; }))
      parts.push_back(data + "0 ? $2 : NaN) with points pt " + std::to_string(look(request, i).hollow) +
                      " ps 0.7 lw 1.5 lc rgb '" + look(request, i).colour + "' notitle");
  }
  return parts;
}

}  // namespace

ChartSpans chart_spans(const ChartRequest& request) { return lay_out(request); }

std::string curve_colour(const ChartRequest& request, std::size_t curve) { return look(request, curve).colour; }

std::string chart_script(const ChartRequest& request, const ChartFiles& files) {
  constexpr double around = 95;  // of the plot: its axis below, its gap above [px]
  const Layout layout = lay_out(request);
  const bool at_ends = labels_at_ends(request);
  std::ostringstream script;
  write_axes(script, files, request.x, layout.x, request.y, layout.y);
  for (std::size_t i = 0; i < request.curves.size(); ++i)
    script << "set linetype " << i + 1 << " lc rgb '" << look(request, i).colour << "' lw 2 dt "
           << look(request, i).dash << " pt " << look(request, i).filled << " ps " << (at_ends ? "0.4" : "0.7") << "\n";
  if (request.range)
    script << "set object 1 rectangle from first " << short_number(request.range->from, 15) << ", graph 0 to first "
           << short_number(request.range->to, 15) << ", graph 1 behind " << shaded << "\n";
  script << "\n";
  PictureShape shape{.subtitle = request.subtitle};
  if (at_ends) {
    const double plot_height =
        std::max(shape.height - around, end_label_height * static_cast<double>(request.curves.size()));
    shape.height = plot_height + around;
    shape.gap = 26;  // for the head of the labels
    shape.right -= end_labels_width(request);
    write_end_labels(script, request, layout, plot_height);
  } else if (request.lines && request.mark_peaks) {
    write_peak_values(script, request, layout);
  }
  write_peak_rings(script, request, layout);
  const bool areas = areas_are_seen(request, layout);
  const std::vector<LegendEntry> entries = legend(request, write_crosses(script, request), areas);
  write_pictures(script, files, request.title, plots(request, areas), entries, shape);
  return script.str();
}

}  // namespace rollres
