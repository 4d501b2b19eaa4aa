#include "studies/evidence/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/estimate/grid_choice.hpp"
#include "core/model/scene_rules.hpp"
#include "studies/evidence/accuracy_reference.hpp"
#include "studies/evidence/power_law.hpp"
#include "studies/run/progress.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

AccuracyStatus status_of(const Measurement& measured) {
  if (measured.stopped) return AccuracyStatus::skipped;
  if (!measured.failure.empty()) return AccuracyStatus::failed;
  switch (measured.solution.status) {
    case Status::converged:
      return AccuracyStatus::converged;
    case Status::no_steady_state:
      return AccuracyStatus::no_steady_state;
    case Status::not_converged:
      break;
  }
  return AccuracyStatus::not_converged;
}

AccuracyPoint measured_point(const TimedScene& measured, const RollingScene& scene) {
  AccuracyPoint point{.method = scene.method,
                      .spacing = scene.spacing.value_or(RollingSolution::absent),
                      .tolerance = scene.tolerance.value_or(RollingSolution::absent)};
  const double limit = measured.options.seconds_limit;
  std::vector<double> seconds, processor_seconds;
  double total = 0;
  do {
    const Measurement found = measured.measure(scene, limit);
    if (found.stopped && !seconds.empty()) break;  // on the edge of the limit: what was measured before stands
    point.status = status_of(found);
    if (found.stopped) {
      point.reason = "took longer than the limit of " + duration_in_words(limit);
      return point;
    }
    point.reason = found.failure.empty() ? found.solution.reason : found.failure;
    point.solution = found.solution;
    if (point.status == AccuracyStatus::failed) return point;
    seconds.push_back(found.seconds);
    processor_seconds.push_back(found.processor_seconds);
    if (!(point.peak_memory >= found.peak_memory)) point.peak_memory = found.peak_memory;
    total += found.seconds;
  } while (static_cast<int>(seconds.size()) < measured.options.repeats && total < limit);
  point.seconds = median(seconds);
  point.processor_seconds = median(processor_seconds);
  point.repeats = static_cast<int>(seconds.size());
  return point;
}

std::vector<AccuracyPoint> points_of(const TimedScene& measured, Method method, const std::vector<double>& spacings) {
  const double limit = measured.options.seconds_limit;
  std::vector<AccuracyPoint> points;
  SolveCost cost(measured.dimension());
  bool too_long = false;
  for (const double spacing : spacings) {
    const double predicted = cost.predicted(spacing);
    if (too_long || predicted > limit) {
      points.push_back({.method = method, .spacing = spacing});
      points.back().reason = too_long ? "a coarser grid took longer than the limit"
                                      : "would take " + duration_in_words(predicted) + ", longer than the limit of " +
                                            duration_in_words(limit);
      continue;
    }
    measured.tell(method, readable(spacing, "m"));
    points.push_back(measured_point(measured, measured.on_grid(method, spacing)));
    too_long = points.back().status == AccuracyStatus::skipped;
    if (points.back().repeats > 0) cost.add(spacing, points.back().seconds);
  }
  return points;
}

/// Over tolerances from 1e-2 to 1e-10; one that took too long is followed by none.
std::vector<AccuracyPoint> gridless_points(const TimedScene& measured, Method method) {
  std::vector<AccuracyPoint> points;
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10}) {
    measured.tell(method, "tolerance " + short_number(tolerance, 1));
    AccuracyPoint& point = points.emplace_back(measured_point(measured, measured.without_grid(method, tolerance)));
    if (point.status == AccuracyStatus::skipped) break;
    // What a grid answered in its place is no point of this method.
    if (point.status == AccuracyStatus::converged && point.solution.method != method) {
      point.status = AccuracyStatus::not_converged;
      point.reason = "left to method " + std::string(name_of(point.solution.method));
      break;
    }
  }
  return points;
}

AccuracyTrend trend_of(Method method, const std::vector<AccuracyPoint>& points, const AccuracyReference& reference) {
  std::vector<double> spacings, errors, nodes, seconds;
  for (const AccuracyPoint& point : points) {
    if (point.method != method || point.status != AccuracyStatus::converged) continue;
    nodes.push_back(point.solution.contact_nodes);
    seconds.push_back(point.seconds);
    const double error = std::abs(point.error);
    constexpr double clear = 3;  // closer to the uncertainty, an error is half that of the reference
    if (!(error > 0) || error <= clear * reference.uncertainty) continue;
    spacings.push_back(point.spacing);
    errors.push_back(error);
  }
  constexpr std::size_t fewest = 3;
  const std::size_t coarse = nodes.size() < 2 * fewest ? 0 : nodes.size() / 2;
  for (auto* values : {&nodes, &seconds})
    values->erase(values->begin(), values->begin() + static_cast<std::ptrdiff_t>(coarse));
  const PowerLaw order = power_law(spacings, errors, fewest);
  return {method, order.slope, order.deviation, power_law(nodes, seconds, fewest).slope};
}

}  // namespace

std::vector<Method> methods_named(const std::vector<std::string>& names) {
  std::vector<Method> methods;
  for (const std::string& name : names) {
    const int found = find_name(ChoiceNames<Method>::names, name);
    if (found < 0)
      throw std::invalid_argument("--methods = \"" + name +
                                  "\": " + unknown("unknown method", ChoiceNames<Method>::names, name));
    if (static_cast<Method>(found) == Method::finite_strain)
      throw std::invalid_argument("--methods = \"" + name + "\": the methods compared here solve the linear model");
    if (static_cast<Method>(found) == Method::convolution)
      throw std::invalid_argument("--methods = \"" + name + "\": the methods compared here look for a contact");
    if (!contains(methods, static_cast<Method>(found))) methods.push_back(static_cast<Method>(found));
  }
  return methods;
}

RollingScene TimedScene::on_grid(Method method, double spacing) const {
  RollingScene gridded = scene;
  gridded.method = method;
  gridded.spacing = spacing;
  gridded.tolerance.reset();
  return gridded;
}

RollingScene TimedScene::without_grid(Method method, double tolerance) const {
  RollingScene gridless = scene;
  gridless.method = method;
  gridless.tolerance = tolerance;
  gridless.spacing.reset();
  return gridless;
}

void TimedScene::tell(Method method, const std::string& at, const char* what) const {
  if (options.report) options.report(name + what + ": " + std::string(name_of(method)) + " at " + at);
}

std::vector<double> usual_spacings(const RollingScene& scene) {
  constexpr double coarsest_nodes = 8;
  const double finest_nodes = dimension_of(scene.indenter) == 2 ? 500 : 130;
  const double length = 2 * std::min(estimate_contact(scene).half_width, scene.radius);
  const double own = scene.spacing.value_or(std::stod(short_number(length / coarsest_nodes, 3)));
  const auto steps_to = [&](double nodes) {
    return static_cast<int>(std::lround(2 * std::log2(own * nodes / length)));
  };
  std::vector<double> spacings;
  for (int step = -steps_to(coarsest_nodes); step >= -steps_to(finest_nodes); --step) {
    const double even = own * std::ldexp(1.0, static_cast<int>(std::floor(0.5 * step)));
    spacings.push_back(step % 2 == 0 ? even : std::stod(short_number(std::sqrt(2.0) * even, 4)));
  }
  return spacings;
}

AccuracyReport measure_accuracy(const std::string& name, const RollingScene& scene, const AccuracyOptions& options,
                                const Measure& measure) {
  std::vector<Method> methods = options.methods;
  if (methods.empty())
    for (std::size_t i = 0; i < ChoiceNames<Method>::names.size(); ++i)
      if (const Method method = static_cast<Method>(i);
          (on_grid(method) && method != Method::convolution) ||
          (method == Method::spectral && spectral_refusal(ContactModel(scene)).empty()))
        methods.push_back(method);
  std::vector<double> spacings = options.spacings;
  if (spacings.empty()) {
    spacings = usual_spacings(scene);
    if (options.levels) spacings.resize(std::min(spacings.size(), static_cast<std::size_t>(*options.levels)));
  }
  std::sort(spacings.rbegin(), spacings.rend());
  spacings.erase(std::unique(spacings.begin(), spacings.end()), spacings.end());
  const TimedScene measured{name, scene, options, measure};
  const auto refuse_broken = [&](const RollingScene& tried) {
    if (const auto broken = check(tried); !broken.empty()) throw std::invalid_argument(name + ": " + broken.front());
  };
  for (const double spacing : spacings) refuse_broken(measured.on_grid(Method::newton, spacing));
  constexpr double some_tolerance = 1e-6;
  for (const Method method : methods)
    if (!on_grid(method)) refuse_broken(measured.without_grid(method, some_tolerance));

  AccuracyReport report{name, scene, {}, {}, {}};
  for (const Method method : methods)
    for (AccuracyPoint& point :
         on_grid(method) ? points_of(measured, method, spacings) : gridless_points(measured, method))
      report.points.push_back(std::move(point));
  report.reference = find_reference(measured, report.points);
  for (AccuracyPoint& point : report.points) {
    if (point.status != AccuracyStatus::converged || !report.reference.found()) continue;
    constexpr double nothing = 1e-12;  // of the load
    if (std::abs(report.reference.rolling_resistance) < nothing * point.solution.load)
      throw std::invalid_argument(name + ": a scene without losses has no relative error of its rolling resistance");
    constexpr double same = 1e-6;
    if (!(point.spacing <= report.reference.spacing * (1 + same)))  // also where one of them has no grid
      point.error = point.solution.rolling_resistance / report.reference.rolling_resistance - 1;
  }
  for (const Method method : methods) report.trends.push_back(trend_of(method, report.points, report.reference));
  return report;
}

}  // namespace rollres
