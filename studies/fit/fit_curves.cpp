#include "studies/fit/fit_curves.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "db/rows/result_store.hpp"
#include "fitting/errors/statistics.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

bool is_number(const std::string& key) { return find_input(key)->choices.empty() && !find_input(key)->list; }

std::string horizontal(const FitFile& file) {
  const auto& varying = file.varying;
  if (varying.empty() || contains(varying, "speed")) return "speed";
  const auto found = find_if(varying, is_number);
  return found == varying.end() ? "speed" : *found;
}

/// "P = 20 kN/m, R = 0.1 m", with the data set where there are several.
std::string label_of(const FitFile& file, const MeasuredScene& row, const std::string& x) {
  std::vector<std::string> parts;
  if (any_of(file.scenes, [&](const MeasuredScene& other) { return other.set != row.set; })) parts.push_back(row.set);
  for (const std::string& key : file.varying) {
    if (key == x || !is_number(key)) continue;
    const Quantity& quantity = find_input(key)->quantity;
    parts.push_back(std::string(quantity.symbol.empty() ? quantity.key : quantity.symbol) + " = " +
                    readable(real_input(row.scene, key), quantity.unit_for(file.body())));
  }
  return joined(parts);
}

/// Half-width of the band at x: a straight line between those at the data.
double between_data(const FitCurve& curve, const FitReport& report, double x, double quantile) {
  std::map<double, double> known;
  for (std::size_t i = 0; i < curve.data.size(); ++i) known[curve.data_x[i]] = report.values[curve.data[i]].band;
  const auto above = known.lower_bound(x);
  if (above == known.end()) return quantile * known.rbegin()->second;
  if (above == known.begin()) return quantile * above->second;
  const auto below = std::prev(above);
  const double part = (x - below->first) / (above->first - below->first);
  return quantile * (below->second + part * (above->second - below->second));
}

}  // namespace

FitCurves fit_curves(const FitFile& file, const FitReport& report, const Evaluate& evaluate, int jobs,
                     const CurveDetail& detail) {
  const std::string x = horizontal(file);
  const Quantity& quantity = find_input(x)->quantity;
  const Quantity output = real_output(file.output);
  FitCurves answer{{.name = in_words(x),
                    .symbol = std::string(symbol_beside_name(quantity)),
                    .unit = std::string(quantity.unit_for(file.body()))},
                   {.name = in_words(output.key),
                    .symbol = std::string(output.symbol),
                    .unit = std::string(output.unit_for(file.body()))},
                   {}};
  std::map<std::string, std::size_t> places;
  double lowest = std::numeric_limits<double>::infinity(), highest = 0;
  for (std::size_t i = 0; i < file.scenes.size(); ++i) {
    const MeasuredScene& row = file.scenes[i];
    if (row.output != file.output) continue;
    RollingScene same = row.scene;
    set_input(same, x, 1.0);
    const auto [place, fresh] = places.try_emplace(evaluation_key(same) + row.set, answer.curves.size());
    if (fresh) answer.curves.push_back({.label = label_of(file, row, x)});
    const double value = real_input(row.scene, x);
    answer.curves[place->second].data_x.push_back(value);
    answer.curves[place->second].data.push_back(i);
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  constexpr double wide = 20;
  answer.x.logarithmic = lowest > 0 && highest > wide * lowest;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const MeasuredScene& row : file.scenes)
    if (row.output == file.output)
      least = std::min(least, row.measured.value), most = std::max(most, row.measured.value);
  answer.y.logarithmic = least > 0 && most > wide * least;

  std::vector<FitParameter> parameters;
  for (const FittedParameter& fitted : report.parameters) parameters.push_back(fitted.parameter);
  const double quantile = two_sided_quantile(confidence, report.deviations_known ? 0 : report.degrees);
  const Eigen::MatrixXd known =
      report.errors.covariance.unaryExpr([](double entry) { return std::isfinite(entry) ? entry : 0; });
  const int pieces = detail.points - 1;
  if (answer.curves.size() > detail.most_curves) return answer;
  for (FitCurve& curve : answer.curves) {
    const auto [from, to] = minmax_element(curve.data_x);
    std::vector<MeasuredScene> scenes;
    for (int i = 0; i <= pieces && *to > *from; ++i) {
      MeasuredScene between = file.scenes[curve.data.front()];
      const double part = static_cast<double>(i) / pieces;
      const double value = answer.x.logarithmic ? *from * std::pow(*to / *from, part) : *from + part * (*to - *from);
      set_input(between.scene, x, value);
      scenes.push_back(between);
    }
    if (scenes.empty()) continue;
    const FitProblem problem =
        resistance_problem(scenes, file.inputs, parameters, evaluate, {.output = file.output, .jobs = jobs});
    const Prediction prediction = problem.predict(report.point());
    if (prediction.values.size() == 0) continue;  // interrupted
    const Slopes slopes =
        detail.slopes && prediction.found() ? problem.differentiate(report.point(), prediction) : Slopes{};
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      if (!std::isfinite(prediction.values[row])) continue;
      double variance = 0;
      if (slopes.found() && slopes.derivatives.rows() > 0 && known.size() > 0) {
        const auto slope = slopes.derivatives.row(row);
        variance = slope.dot(slope * known);
      }
      curve.x.push_back(real_input(scenes[i].scene, x));
      curve.value.push_back(prediction.values[row]);
      curve.band.push_back(detail.slopes ? quantile * std::sqrt(std::max(variance, 0.0))
                                         : between_data(curve, report, curve.x.back(), quantile));
    }
  }
  return answer;
}

}  // namespace rollres
