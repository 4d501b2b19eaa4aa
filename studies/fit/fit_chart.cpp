#include "studies/fit/fit_chart.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "fitting/errors/statistics.hpp"
#include "fitting/fit/fit.hpp"
#include "studies/drawing/chart_frame.hpp"
#include "studies/drawing/gnuplot.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

/// An axis with a readable unit, and what it spans in that unit.
struct ScaledAxis {
  ChartAxis axis;
  Span span;
  double factor;

  double in_unit(double si) const { return si / factor; }
};

ScaledAxis scaled_axis(ChartAxis axis, const std::vector<double>& values) {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  bool positive = true;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    positive &= value > 0;
    smallest = std::min(smallest, std::abs(value));
    largest = std::max(largest, std::abs(value));
  }
  axis.logarithmic &= positive;
  const ScaledUnit unit =
      axis.logarithmic ? scaled_unit_logarithmic(axis.unit, smallest, largest) : scaled_unit(axis.unit, largest);
  axis.unit = typeset_unit(unit.name);
  ScaledAxis scaled{axis, {}, unit.factor};
  scaled.span.logarithmic = axis.logarithmic;
  for (const double value : values)
    if (std::isfinite(value)) scaled.span.include(value / unit.factor);
  scaled.span.widen(0.04, 0.06);
  return scaled;
}

class Picture {
 public:
  Picture(const std::filesystem::path& folder, const std::string& name, std::string title, ScaledAxis x, ScaledAxis y)
      : files_(chart_files(folder / name)), title_(std::move(title)), x_(std::move(x)), y_(std::move(y)) {
    write_axes(script_, files_, x_.axis, x_.span, y_.axis, y_.span);
  }

  /// Starts a block of data; returns "data index N".
  std::string block() {
    if (blocks_ > 0) data_ << "\n\n";
    return "data index " + std::to_string(blocks_++);
  }
  /// A line of the block: x and y values [SI].
  void add(double x, std::initializer_list<double> ys) {
    data_ << short_number(x_.in_unit(x), 12);
    for (const double y : ys) data_ << ' ' << (std::isfinite(y) ? short_number(y_.in_unit(y), 12) : "NaN");
    data_ << '\n';
  }
  void plot(const std::string& words) { plots_.push_back(words); }
  void legend(const std::string& sample, const std::string& words) {
    entries_.push_back({sample, gnuplot::plain(words) + kept_blanks, width(words)});
  }
  std::ostream& script() { return script_; }
  const ScaledAxis& x() const { return x_; }
  const ScaledAxis& y() const { return y_; }

  std::filesystem::path draw() {
    write_pictures(script_, files_, title_, plots_, entries_);
    draw_pictures(files_, data_.str(), script_.str(), {title_, y_.axis.name + " against " + x_.axis.name});
    return files_.svg;
  }

 private:
  ChartFiles files_;
  std::string title_;
  ScaledAxis x_, y_;
  std::ostringstream script_, data_;
  int blocks_ = 0;
  std::vector<std::string> plots_;
  std::vector<LegendEntry> entries_;
};

std::string colour(std::size_t curve) { return " lc rgb '" + std::string(curve_colour(curve)) + "'"; }

std::string marks(std::size_t curve) {
  constexpr int types[] = {7, 5, 9, 13, 11, 15};
  return " pt " + std::to_string(types[curve % std::size(types)]) + " ps 0.6";
}

std::vector<double> all_x(const FitCurves& curves) {
  std::vector<double> values;
  for (const FitCurve& curve : curves.curves) {
    values.insert(values.end(), curve.x.begin(), curve.x.end());
    values.insert(values.end(), curve.data_x.begin(), curve.data_x.end());
  }
  return values;
}

std::filesystem::path draw_data(const FitReport& report, const FitCurves& curves, const std::string& name,
                                const std::filesystem::path& folder) {
  const double scatter = std::sqrt(report.errors.scale);
  std::vector<double> ys;
  for (const FitCurve& curve : curves.curves) ys.insert(ys.end(), curve.value.begin(), curve.value.end());
  for (const FittedValue& value : report.values) {
    ys.push_back(value.measured.value);
    for (const double side : {-1.0, 1.0})
      if (const double end = value.measured.value + side * scatter * value.measured.deviation;
          end > 0 || !curves.y.logarithmic)
        ys.push_back(end);
  }
  Picture picture(folder, name + "_data", name + ": data and fit", scaled_axis(curves.x, all_x(curves)),
                  scaled_axis(curves.y, ys));
  for (std::size_t c = 0; c < curves.curves.size(); ++c) {
    const FitCurve& curve = curves.curves[c];
    const std::string line = picture.block();
    for (std::size_t i = 0; i < curve.x.size(); ++i)
      picture.add(curve.x[i], {curve.value[i], curve.value[i] - curve.band[i], curve.value[i] + curve.band[i]});
    picture.plot(line + " using 1:3:4 with filledcurves fs transparent solid 0.25 noborder" + colour(c) + " notitle");
    picture.plot(line + " using 1:2 with lines lw 1.5" + colour(c) + " notitle");
    const std::string points = picture.block();
    for (std::size_t i = 0; i < curve.data.size(); ++i) {
      const MeasuredValue& measured = report.values[curve.data[i]].measured;
      picture.add(curve.data_x[i], {measured.value, scatter * measured.deviation});
    }
    picture.plot(points + " using 1:2:3 with yerrorbars lw 1.2" + marks(c) + colour(c) + " notitle");
    picture.legend("linespoints lw 1.5" + marks(c) + colour(c), curve.label.empty() ? "fit" : curve.label);
  }
  picture.legend("boxes fs transparent solid 0.25 noborder lc rgb '#444444'", "95 % band");
  return picture.draw();
}

std::filesystem::path draw_residuals(const FitReport& report, const FitCurves& curves, const std::string& name,
                                     const std::filesystem::path& folder) {
  const double scatter = std::sqrt(report.errors.scale);
  std::vector<double> ys{-2.5, 2.5};
  for (const FittedValue& value : report.values) ys.push_back(value.residual / scatter);
  Picture picture(folder, name + "_residuals", name + ": residuals", scaled_axis(curves.x, all_x(curves)),
                  scaled_axis({.name = "(fit - data) / standard deviation"}, ys));
  for (const double level : {-2.0, 0.0, 2.0})
    picture.script() << "set arrow from graph 0, first " << level << " to graph 1, first " << level
                     << " nohead lw 1.2 dt " << (level == 0 ? "1" : "2") << " lc rgb '#888888' back\n";
  for (std::size_t c = 0; c < curves.curves.size(); ++c) {
    const FitCurve& curve = curves.curves[c];
    const std::string points = picture.block();
    for (std::size_t i = 0; i < curve.data.size(); ++i)
      picture.add(curve.data_x[i], {report.values[curve.data[i]].residual / scatter});
    picture.plot(points + " using 1:2 with points" + marks(c) + colour(c) + " notitle");
    picture.legend("points" + marks(c) + colour(c), curve.label.empty() ? "residuals" : curve.label);
  }
  return picture.draw();
}

ChartAxis parameter_axis(const FittedParameter& fitted, Indenter indenter) {
  const Quantity& quantity = fitted.parameter.variable.quantity;
  const std::string_view unit = quantity.unit_for(indenter);
  return {.name = fitted.parameter.name, .symbol = std::string(quantity.symbol), .unit = std::string(unit)};
}

std::filesystem::path draw_profile(const FitReport& report, std::size_t parameter, const std::string& name,
                                   const std::filesystem::path& folder, Indenter indenter) {
  const FittedParameter& fitted = report.parameters[parameter];
  const double quantile = two_sided_quantile(confidence, report.deviations_known ? 0 : report.degrees);
  const double threshold = quantile * quantile;
  std::vector<double> xs, ys{0, 1.4 * threshold};
  for (const ProfilePoint& point : fitted.profile.points)
    if (point.rise < 2.5 * threshold) {
      xs.push_back(point.value);
      ys.push_back(point.rise);
    }
  std::string file = fitted.parameter.name;
  std::replace_if(
      file.begin(), file.end(),
      [](char letter) { return std::string_view(" /()").find(letter) != std::string_view::npos; }, '_');
  ChartAxis x = parameter_axis(fitted, indenter);
  x.logarithmic = fitted.parameter.variable.logarithmic && xs.back() > 10 * xs.front();
  Picture picture(folder, name + "_profile_" + file, name + ": profile of " + fitted.parameter.name, scaled_axis(x, xs),
                  scaled_axis({.name = "rise of chi squared"}, ys));
  picture.script() << "set arrow from graph 0, first " << short_number(threshold) << " to graph 1, first "
                   << short_number(threshold) << " nohead lw 1.2 dt 2 lc rgb '#888888' back\n";
  const std::string line = picture.block();
  const Variable& variable = fitted.parameter.variable;
  const double centre = variable.scaled(fitted.value), deviation = fitted.relative_error;
  constexpr int pieces = 80;
  if (std::isfinite(deviation))
    for (int i = 0; i <= pieces; ++i) {
      const double offset = (2.4 * i / pieces - 1.2) * quantile;
      picture.add(variable.value(centre + offset * deviation), {offset * offset});
    }
  picture.plot(line + " using 1:2 with lines lw 1.5 dt 2 lc rgb '#888888' notitle");
  // Between the points the root of the rise is all but a straight line.
  const std::string curve = picture.block();
  const std::vector<ProfilePoint>& known = fitted.profile.points;
  const auto root = [&](const ProfilePoint& point) {
    return std::copysign(std::sqrt(std::max(point.rise, 0.0)), point.value - fitted.value);
  };
  for (std::size_t k = 0; k + 1 < known.size(); ++k)
    for (int i = 0; i <= 20; ++i) {
      const double part = i / 20.0, from = variable.scaled(known[k].value), to = variable.scaled(known[k + 1].value);
      const double rise = root(known[k]) + part * (root(known[k + 1]) - root(known[k]));
      picture.add(variable.value(from + part * (to - from)), {rise * rise});
    }
  picture.plot(curve + " using 1:2 with lines lw 1.8" + colour(0) + " notitle");
  const std::string points = picture.block();
  for (const ProfilePoint& point : known)
    if (point.rise < 2.5 * threshold) picture.add(point.value, {point.rise});
  picture.plot(points + " using 1:2 with points" + marks(0) + colour(0) + " notitle");
  picture.legend("linespoints lw 1.8" + marks(0) + colour(0), "profile likelihood");
  picture.legend("lines lw 1.5 dt 2 lc rgb '#888888'", "linear; level of 95 %");
  return picture.draw();
}

std::filesystem::path draw_ellipse(const FitReport& report, const std::string& name,
                                   const std::filesystem::path& folder, Indenter indenter) {
  const ParameterPair pair = worst_pair(report);
  const auto a = static_cast<Eigen::Index>(pair.first), b = static_cast<Eigen::Index>(pair.second);
  const FittedParameter &first = report.parameters[pair.first], &second = report.parameters[pair.second];
  const double correlation = report.errors.correlations(a, b);
  // Both together within 95 %: chi squared of two degrees of freedom.
  const double reach = std::sqrt(-2 * std::log(1 - confidence));
  std::vector<double> xs, ys;
  constexpr int pieces = 180;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = 2 * std::numbers::pi * i / pieces;
    const double u = std::cos(angle), v = correlation * u + std::sqrt(1 - correlation * correlation) * std::sin(angle);
    const auto moved = [&](const FittedParameter& fitted, double part) {
      const Variable& variable = fitted.parameter.variable;
      const double scaled = variable.scaled(fitted.value) + reach * fitted.relative_error * part;
      return variable.logarithmic ? std::exp(scaled) : scaled * variable.size;
    };
    xs.push_back(moved(first, u));
    ys.push_back(moved(second, v));
  }
  Picture picture(folder, name + "_ellipse", name + ": 95 % ellipse, correlation " + short_number(correlation, 3),
                  scaled_axis(parameter_axis(first, indenter), xs), scaled_axis(parameter_axis(second, indenter), ys));
  const std::string line = picture.block();
  for (std::size_t i = 0; i < xs.size(); ++i) picture.add(xs[i], {ys[i]});
  picture.plot(line + " using 1:2 with lines lw 1.8" + colour(0) + " notitle");
  const std::string point = picture.block();
  picture.add(first.value, {second.value});
  picture.plot(point + " using 1:2 with points pt 7 ps 1" + colour(0) + " notitle");
  return picture.draw();
}

}  // namespace

std::vector<std::filesystem::path> draw_fit(const FitReport& report, const FitCurves& curves, const std::string& name,
                                            const std::filesystem::path& folder, Indenter indenter) {
  std::vector<std::filesystem::path> drawn{draw_data(report, curves, name, folder),
                                           draw_residuals(report, curves, name, folder)};
  for (std::size_t j = 0; j < report.parameters.size(); ++j)
    if (report.parameters[j].profile.points.size() > 2)
      drawn.push_back(draw_profile(report, j, name, folder, indenter));
  if (report.parameters.size() > 1) {
    const ParameterPair pair = worst_pair(report);
    const double correlation =
        report.errors.correlations(static_cast<Eigen::Index>(pair.first), static_cast<Eigen::Index>(pair.second));
    if (std::isfinite(correlation)) drawn.push_back(draw_ellipse(report, name, folder, indenter));
  }
  return drawn;
}

}  // namespace rollres
