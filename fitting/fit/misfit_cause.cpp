#include "fitting/fit/misfit_cause.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/messages/message_text.hpp"
#include "fitting/fit/fit_starts.hpp"
#include "fitting/fit/measured_terms.hpp"
#include "fitting/fit/rough_descents.hpp"

namespace rollres {

namespace {

constexpr double most = 0.75;  // of the misfit

FitPoint without_last(const FitPoint& point) { return {point.begin(), point.end() - 1}; }

/// The problem with an offset or a scale of its measured values as the last parameter.
FitProblem with_term(const FitProblem& problem, std::string_view key) {
  FitProblem more = problem;
  std::vector<double> sizes;
  for (const MeasuredValue& datum : problem.data) sizes.push_back(std::abs(datum.value));
  std::nth_element(sizes.begin(), sizes.begin() + std::ssize(sizes) / 2, sizes.end());
  const Variable variable = term_variable(key, {key, "", "", ""}, 0.1 * sizes[sizes.size() / 2]);
  more.parameters.push_back({std::string(key), variable, key == offset_key ? 0.0 : 1.0});
  for (FitPoint& suggestion : more.suggestions) suggestion.push_back(more.parameters.back().start);
  more.estimate = {};
  more.model.predict = [inner = problem.model.predict](const FitPoint& point, const DataRows& rows) {
    return inner(without_last(point), rows);
  };
  more.model.differentiate = [inner = problem.model.differentiate](const FitPoint& point,
                                                                   const Prediction& prediction) {
    Slopes slopes = inner(without_last(point), prediction);
    if (!slopes.found()) return slopes;
    const Eigen::Index columns = std::ssize(point);
    slopes.derivatives.conservativeResize(Eigen::NoChange, columns);
    slopes.errors.conservativeResize(Eigen::NoChange, columns);
    slopes.steps.conservativeResize(columns);
    slopes.derivatives.rightCols(1).setZero();
    slopes.errors.rightCols(1).setZero();
    slopes.steps.tail(1).setZero();
    return slopes;
  };
  MeasuredTerm term{key, problem.size(), {}};
  for (const MeasuredValue& datum : problem.data) term.acts.push_back(!datum.prior());
  return with_terms(more, {std::move(term)});
}

/// The parts of the misfit that data have which share a name.
std::map<std::string, double> parts(const FitReport& report, std::string (*name)(const FittedValue&, double middle)) {
  std::vector<double> places;
  double all = 0;
  for (const FittedValue& value : report.values) {
    if (!value.measured.prior()) places.push_back(value.measured.along);
    all += value.residual * value.residual;
  }
  std::nth_element(places.begin(), places.begin() + std::ssize(places) / 2, places.end());
  std::map<std::string, double> shares;
  for (const FittedValue& value : report.values)
    shares[name(value, places[places.size() / 2])] += value.residual * value.residual / all;
  return shares;
}

std::string largest_part(const std::map<std::string, double>& shares) {
  if (shares.size() < 2) return "";
  for (const auto& [name, share] : shares)
    if (share > most) return message_text<3>(100 * share, " % of it comes from ", name);
  return "";
}

}  // namespace

std::string missing_term(const FitProblem& problem, const FitReport& report, const FitOptions& options) {
  FitOptions tries = options;
  tries.starts = 3;
  tries.known.reset();
  const FitProblem small = small_problem(problem);
  std::string best;
  double left = 1 - most;
  for (const std::string_view key : {offset_key, scale_key}) {
    if (small.data.size() < problem.size() + 2) break;
    if (any_of(problem.parameters, [&](const FitParameter& one) { return one.name.starts_with(key); })) continue;
    const FitProblem wider = with_term(small, key);
    const Prediction now = small.predict(report.point());
    if (!now.found()) break;
    for (const Descent& descent : rough_descents(wider, tries)) {
      if (!descent.found() || descent.abandoned) continue;
      const double part = descent.misfit / misfit(small, residuals(small, now));
      if (!(part < left)) continue;
      left = part;
      best = message_text<3>(
          key == offset_key ? "an offset of the measured values by about " : "a scale of the measured values of about ",
          descent.end.back(), key == offset_key ? " " : "", key == offset_key ? problem.data.front().unit : "",
          " would explain ", 100 * (1 - part), " % of it: add the parameter \"", key, "\"");
    }
  }
  return best;
}

std::string place_of_misfit(const FitReport& report) {
  const std::string best = largest_part(parts(report, [](const FittedValue& value, double) {
    const std::string place = value.measured.place;
    return value.measured.prior() ? std::string("the priors") : place.substr(0, place.find(", line"));
  }));
  if (!best.empty()) return best;
  return largest_part(parts(report, [](const FittedValue& value, double middle) {
    return std::string(value.measured.along < middle ? "the slower half of the data" : "the faster half of the data");
  }));
}

}  // namespace rollres
