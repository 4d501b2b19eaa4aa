#include "studies/stored_fits/fit_chart.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numbers>

#include "fitting/fit/fit.hpp"
#include "studies/drawing/chart_frame.hpp"
#include "studies/stored_fits/stored_fit.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double far_off = 3;  // deviations from which on a measurement is marked

/// An axis in a readable unit for these values [SI].
struct FitAxis {
  ChartAxis axis;
  ScaledUnit unit;

  FitAxis(ChartAxis wanted, const std::vector<double>& values) : axis(std::move(wanted)) {
    Span size{.highest = 0};
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      axis.logarithmic &= value > 0;
      size.include(std::abs(value));
    }
    if (axis.unit == "K" && is_temperature(axis.name))
      unit = celsius(), axis.logarithmic = false;
    else
      unit = axis.logarithmic ? scaled_unit_logarithmic(axis.unit, size.lowest, size.highest)
                              : scaled_unit(axis.unit, size.highest);
    axis.unit = typeset_unit(unit.name);
    axis.margin = 0.03;
  }

  double at(double value) const { return unit.number(value); }
};

bool has_curves(const FitRecord& fit) { return !fit.x_name.empty(); }

bool outlies(const FitRecord& fit, const FitDataRecord& one) {
  return std::abs(one.residual) > far_off * scatter_of(fit);
}

/// From the least to the most of what is finite.
Span finite_span(const std::vector<double>& values) {
  Span span;
  for (const double value : values)
    if (std::isfinite(value)) span.include(value);
  return span;
}

/// What residuals are drawn against: a value for each measurement, NaN where it has none.
struct ResidualAxis {
  ChartAxis axis;
  std::vector<double> values;

  /// Whether there are two different values.
  bool varies() const {
    const Span span = finite_span(values);
    return span.highest > span.lowest;
  }
};

/// Where the measurements lie on the axis of the curves.
ResidualAxis place_axis(const FitRecord& fit) {
  ResidualAxis along{{.name = fit.x_name, .unit = fit.x_unit, .logarithmic = fit.x_logarithmic}, {}};
  for (const FitDataRecord& one : fit.data) along.values.push_back(one.x);
  return along;
}

bool is_wide(const std::vector<double>& values) {
  const Span span = finite_span(values);
  constexpr double wide = 20;
  return span.lowest > 0 && span.highest > wide * span.lowest;
}

ResidualAxis prediction_axis(const FitRecord& fit) {
  ResidualAxis along{{.name = "what the fit says", .unit = fit.y_unit}, {}};
  for (const FitDataRecord& one : fit.data)
    along.values.push_back(has_curves(fit) && one.curve < 0 ? nothing : one.predicted);
  along.axis.logarithmic = is_wide(along.values);
  return along;
}

/// Each input that varies between measurements, by its name, but the one of the curves.
std::vector<std::pair<std::string, ResidualAxis>> input_axes(const FitRecord& fit) {
  std::vector<std::pair<std::string, ResidualAxis>> axes;
  for (const FitInputRecord& input : fit.inputs) {
    if (input.datum < 1 || input.datum > std::ssize(fit.data)) continue;
    auto axis = find_if(axes, [&](const auto& known) { return known.first == input.name; });
    if (axis == axes.end()) {
      axes.push_back({input.name, {{.name = in_words(input.name), .unit = input.unit}, {}}});
      axis = std::prev(axes.end());
      axis->second.values.assign(fit.data.size(), nothing);
    }
    axis->second.values[static_cast<std::size_t>(input.datum - 1)] = input.value;
  }
  std::erase_if(axes, [&](const auto& one) { return !one.second.varies() || one.second.axis.name == fit.x_name; });
  for (auto& [name, along] : axes) along.axis.logarithmic = is_wide(along.values);
  return axes;
}

/// The labels of the curves, by their numbers.
std::vector<std::string> labels_of(const FitRecord& fit) {
  std::vector<std::string> labels;
  const auto room = [&](std::int64_t curve) -> std::string& {
    if (static_cast<std::size_t>(curve) >= labels.size()) labels.resize(static_cast<std::size_t>(curve) + 1);
    return labels[static_cast<std::size_t>(curve)];
  };
  for (const FitDataRecord& one : fit.data)
    if (one.curve >= 0) room(one.curve);
  for (const FitCurveRecord& point : fit.curves) room(point.curve) = point.label;
  return labels;
}

std::string off_in_words() { return "more than " + short_number(far_off) + " deviations off"; }

void add_alone(ChartCurve& curve, ChartPoint point) {
  curve.points.push_back(point);
  curve.points.push_back({nothing, nothing});
}

/// Measurements with their deviations, the fitted curves with their bands, and what lies far off them.
ChartRequest data_and_fit(const FitRecord& fit) {
  std::vector<double> values;
  for (const FitDataRecord& one : fit.data) values.push_back(one.measured);
  for (const FitCurveRecord& point : fit.curves) values.push_back(point.value);
  const ResidualAxis along = place_axis(fit);
  const FitAxis x(along.axis, along.values),
      y({.name = fit.y_name, .unit = fit.y_unit, .logarithmic = fit.y_logarithmic}, values);
  ChartRequest request{
      .title = fit.name + ": data and fit", .x = x.axis, .y = y.axis, .curves = {}, .mark_peaks = false};
  request.areas = "deviation, 95 % band";
  const std::vector<std::string> labels = labels_of(fit);
  for (const std::string& label : labels) request.curves.push_back({label.empty() ? "measured" : label, {}});
  ChartCurve far{.label = off_in_words(), .points = {}};
  for (const FitDataRecord& one : fit.data) {
    if (one.curve < 0) continue;
    const double at = x.at(one.x), value = y.at(one.measured),
                 deviation = scatter_of(fit) * one.deviation / y.unit.factor;
    add_alone(outlies(fit, one) ? far : request.curves[static_cast<std::size_t>(one.curve)],
              {at, value, true, value - deviation, value + deviation});
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    ChartCurve line{.label = labels[i].empty() ? "the fit" : labels[i], .points = {}, .like = i, .marks = false};
    for (const FitCurveRecord& point : fit.curves)
      if (static_cast<std::size_t>(point.curve) == i)
        line.points.push_back(
            {x.at(point.x), y.at(point.value), true, y.at(point.value - point.band), y.at(point.value + point.band)});
    request.curves.push_back(std::move(line));
  }
  if (!far.points.empty()) request.curves.push_back(std::move(far));
  return request;
}

/// Residuals over their deviations, between the two of most, against what is asked for.
ChartRequest residuals(const FitRecord& fit, const ResidualAxis& along) {
  const FitAxis x(along.axis, along.values);
  ChartRequest request{.title = fit.name + ": residuals",
                       .x = x.axis,
                       .y = {.name = "(fit - measured)/deviation"},
                       .curves = {},
                       .mark_peaks = false};
  const std::vector<std::string> labels = labels_of(fit);
  for (const std::string& label : labels) request.curves.push_back({label.empty() ? "residuals" : label, {}});
  ChartCurve others{.label = labels.empty() ? "residuals" : "of other values", .points = {}},
      far{.label = off_in_words(), .points = {}};
  Span shown;
  for (std::size_t i = 0; i < fit.data.size(); ++i) {
    const double at = x.at(along.values[i]), residual = fit.data[i].residual / scatter_of(fit);
    if (!std::isfinite(at) || !std::isfinite(residual)) continue;
    shown.include(at);
    const std::int64_t curve = fit.data[i].curve;
    add_alone(outlies(fit, fit.data[i]) ? far
              : curve < 0               ? others
                                        : request.curves[static_cast<std::size_t>(curve)],
              {at, residual});
  }
  if (!(shown.highest > shown.lowest)) shown.lowest -= 0.5, shown.highest += 0.5;
  request.curves.push_back({"0 and ±2 deviations", {}, {}, false});
  for (const double level : {-2.0, 0.0, 2.0})
    for (const ChartPoint& point : {ChartPoint{shown.lowest, level}, {shown.highest, level}, {nothing, nothing}})
      request.curves.back().points.push_back(point);
  for (ChartCurve* const curve : {&others, &far})
    if (!curve->points.empty()) request.curves.push_back(std::move(*curve));
  std::erase_if(request.curves, [](const ChartCurve& curve) { return curve.points.empty(); });
  return request;
}

/// Residuals in their order against what a normal distribution would have (Blom 1958: (i - 3/8)/(n + 1/4)).
ChartRequest normal_quantiles(const FitRecord& fit) {
  std::vector<double> sorted;
  for (const FitDataRecord& one : fit.data)
    if (std::isfinite(one.residual)) sorted.push_back(one.residual / scatter_of(fit));
  std::sort(sorted.begin(), sorted.end());
  ChartRequest request{.title = fit.name + ": quantiles of the residuals",
                       .x = {.name = "quantile of a normal distribution", .margin = 0.03},
                       .y = {.name = "(fit - measured)/deviation"},
                       .curves = {{"residuals", {}}, {"as normal residuals lie", {}, {}, false}},
                       .mark_peaks = false};
  const boost::math::normal normal;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double share = (static_cast<double>(i) + 0.625) / (static_cast<double>(sorted.size()) + 0.25);
    const double quantile = boost::math::quantile(normal, share);
    add_alone(request.curves[0], {quantile, sorted[i]});
    if (i == 0 || i + 1 == sorted.size()) request.curves[1].points.push_back({quantile, quantile});
  }
  return request;
}

/// The value so many standard errors away.
double moved(const FitParameterRecord& one, double errors) {
  return is_logarithmic(one) ? one.value * std::exp(errors * one.relative_error)
                             : one.value + errors * one.standard_error;
}

ChartRequest profile(const FitRecord& fit, const FitParameterRecord& parameter,
                     const std::vector<FitProfileRecord>& known) {
  const double level = fit.profile_threshold;
  std::vector<double> values;
  for (const FitProfileRecord& point : known) values.push_back(point.value);
  const FitAxis x({.name = in_words(parameter.name), .unit = parameter.unit}, values);
  ChartRequest request{
      .title = fit.name + ": profile of " + in_words(parameter.name),
      .subtitle = {},
      .x = x.axis,
      .y = {.name = "rise of the misfit"},
      .curves = {{"refitted", {}}, {"", {}, 0, false}, {"by the slopes", {}, {}, false}, {"95 %", {}, {}, false}},
      .mark_peaks = false};
  request.x.margin = 0;
  const auto root = [&](const FitProfileRecord& point) {  // all but straight between the points
    return std::copysign(std::sqrt(std::max(point.rise, 0.0)), point.value - parameter.value);
  };
  const auto seen = [&](double rise) { return rise < 2.5 * level; };
  constexpr int pieces = 12;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (seen(known[i].rise)) add_alone(request.curves[0], {x.at(known[i].value), known[i].rise});
    for (int piece = 0; i + 1 < known.size() && piece <= pieces; ++piece) {
      const double part = static_cast<double>(piece) / pieces;
      const double rise = std::pow(root(known[i]) + part * (root(known[i + 1]) - root(known[i])), 2);
      const double value = known[i].value + part * (known[i + 1].value - known[i].value);
      if (seen(rise)) request.curves[1].points.push_back({x.at(value), rise});
    }
  }
  if (std::isfinite(parameter.relative_error))
    for (int piece = -4 * pieces; piece <= 4 * pieces; ++piece) {
      const double errors = 1.2 * std::sqrt(level) * piece / (4 * pieces);
      request.curves[2].points.push_back({x.at(moved(parameter, errors)), errors * errors});
    }
  Span shown;
  for (const ChartCurve& curve : request.curves)
    for (const ChartPoint& point : curve.points)
      if (point.drawn()) shown.include(point.x);
  request.curves[3].points = {{shown.lowest, level}, {shown.highest, level}};
  return request;
}

/// A value, moved to the limits of the parameter where it lies beyond them, as its intervals are.
double within_limits(const FitParameterRecord& one, double value) {
  if (value < one.lowest) return one.lowest;
  return value > one.highest ? one.highest : value;
}

/// Where both parameters together lie in 95 % of all cases: chi squared of two degrees of freedom.
ChartRequest ellipse(const FitRecord& fit, const FitParameterRecord& first, const FitParameterRecord& second,
                     double correlation) {
  const double reach = std::sqrt(-2 * std::log(1 - confidence));
  constexpr int pieces = 90;
  std::vector<double> xs, ys;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = 2 * std::numbers::pi * i / pieces, u = std::cos(angle);
    const double v = correlation * u + std::sqrt(1 - correlation * correlation) * std::sin(angle);
    xs.push_back(within_limits(first, moved(first, reach * u)));
    ys.push_back(within_limits(second, moved(second, reach * v)));
  }
  const FitAxis x({.name = in_words(first.name), .unit = first.unit}, xs),
      y({.name = in_words(second.name), .unit = second.unit}, ys);
  ChartRequest request{.title = fit.name + ": 95 % ellipse",
                       .subtitle = "correlation " + short_number(correlation, 3),
                       .x = x.axis,
                       .y = y.axis,
                       .curves = {{"95 %", {}, {}, false}, {"the fit", {{x.at(first.value), y.at(second.value)}}}},
                       .mark_peaks = false};
  for (std::size_t i = 0; i < xs.size(); ++i) request.curves[0].points.push_back({x.at(xs[i]), y.at(ys[i])});
  return request;
}

/// A name as part of a file's.
std::string file_word(std::string name) {
  std::replace_if(
      name.begin(), name.end(),
      [](char letter) { return std::string_view(" /()").find(letter) != std::string_view::npos; }, '_');
  return name;
}

void add_profiles(const FitRecord& fit, std::vector<FitChart>& charts) {
  for (const FitParameterRecord& parameter : fit.parameters) {
    std::vector<FitProfileRecord> known;
    for (const FitProfileRecord& point : fit.profiles)
      if (point.parameter == parameter.name) known.push_back(point);
    if (known.size() > 2)
      charts.push_back({"profile_" + file_word(parameter.name),
                        "how the misfit grows as " + in_words(parameter.name) +
                            " is held elsewhere; its interval is below the line of 95 %",
                        profile(fit, parameter, known)});
  }
}

/// The strongest pair, and others that are far from independent.
void add_ellipses(const FitRecord& fit, std::vector<FitChart>& charts) {
  constexpr double slight = 0.5;
  constexpr std::size_t most = 4;
  std::vector<FitCorrelationRecord> pairs = fit.correlations;
  stable_sort(pairs, [](const auto& one, const auto& other) {
    return std::abs(one.correlation) > std::abs(other.correlation);
  });
  if (pairs.size() > most) pairs.resize(most);
  const auto find = [&](const std::string& name) {
    return find_if(fit.parameters, [&](const auto& one) { return one.name == name; });
  };
  bool any = false;
  for (const FitCorrelationRecord& pair : pairs) {
    const auto first = find(pair.first), second = find(pair.second);
    if (first == fit.parameters.end() || second == fit.parameters.end()) continue;
    if (!std::isfinite(first->relative_error) || !std::isfinite(second->relative_error)) continue;
    if (any && std::abs(pair.correlation) < slight) continue;
    charts.push_back({any ? "ellipse_" + file_word(pair.first) + "_" + file_word(pair.second) : "ellipse",
                      in_words(pair.first) + " and " + in_words(pair.second) + " together",
                      ellipse(fit, *first, *second, std::clamp(pair.correlation, -1.0, 1.0))});
    any = true;
  }
}

}  // namespace

std::vector<FitChart> fit_charts(const FitRecord& fit) {
  if (fit.data.empty()) return {};
  std::vector<FitChart> charts;
  const std::string over = "residuals of the fit over the deviations, against ";
  if (has_curves(fit)) {
    charts.push_back(
        {"data", "measurements with their deviations, and the fitted curves with their bands", data_and_fit(fit)});
    charts.push_back({"residuals", over + fit.x_name, residuals(fit, place_axis(fit))});
  }
  for (const auto& [name, along] : input_axes(fit))
    charts.push_back({"residuals_" + file_word(name), over + along.axis.name, residuals(fit, along)});
  charts.push_back({has_curves(fit) ? "residuals_fit" : "residuals", over + "what the fit says",
                    residuals(fit, prediction_axis(fit))});
  charts.push_back(
      {"quantiles", "residuals in their order, against those of a normal distribution", normal_quantiles(fit)});
  add_profiles(fit, charts);
  add_ellipses(fit, charts);
  return charts;
}

std::vector<std::filesystem::path> draw_fit(const FitRecord& fit, const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> drawn;
  for (const FitChart& chart : fit_charts(fit))
    drawn.push_back(draw_chart(chart.request, folder / (fit.name + "_" + chart.name + ".svg")).svg);
  return drawn;
}

}  // namespace rollres
