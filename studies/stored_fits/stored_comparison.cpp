#include "studies/stored_fits/stored_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fitting/errors/information_criteria.hpp"
#include "studies/stored_fits/stored_fit.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

double deviations_between(const FitParameterRecord& a, const FitParameterRecord& b) {
  if (is_logarithmic(a) && is_logarithmic(b))
    return std::abs(std::log(a.value / b.value)) / std::hypot(a.relative_error, b.relative_error);
  return std::abs(a.value - b.value) / std::hypot(a.standard_error, b.standard_error);
}

bool is_estimated(const FitParameterRecord& one) { return !one.fixed || std::isfinite(one.standard_error); }

/// Terms of the noise stand among the parameters, fixed and with an error.
bool has_fitted_noise(const FitRecord& fit) {
  return any_of(fit.parameters, [](const auto& one) { return one.fixed && is_estimated(one); });
}

bool same_data(const FitRecord& a, const FitRecord& b) {
  const auto close = [](double x, double y) { return std::abs(x - y) <= 1e-12 * std::abs(x); };
  if (has_fitted_noise(a) != has_fitted_noise(b)) return false;
  const bool noise = has_fitted_noise(a);
  return a.deviations_known == b.deviations_known &&
         std::equal(a.data.begin(), a.data.end(), b.data.begin(), b.data.end(),
                    [&](const FitDataRecord& one, const FitDataRecord& other) {
                      return close(one.measured, other.measured) && (noise || close(one.deviation, other.deviation));
                    });
}

/// By the chi squared alone, unless the noise is fitted.
InformationCriteria criteria_of(const FitRecord& fit) {
  const auto parameters = count_if(fit.parameters, is_estimated);
  const bool noise = has_fitted_noise(fit);
  double log_variances = 0;
  for (const FitDataRecord& one : fit.data)
    if (noise) log_variances += 2 * std::log(one.deviation);
  return information_criteria(fit.chi_squared, fit.data.size(), static_cast<int>(parameters),
                              fit.deviations_known || noise, log_variances);
}

/// The profile's interval where it has two ends, else the linear one.
std::pair<double, double> interval_of(const FitParameterRecord& one) {
  const bool profile = std::isfinite(one.profile_lowest) && std::isfinite(one.profile_highest);
  return profile ? std::pair(one.profile_lowest, one.profile_highest)
                 : std::pair(one.linear_lowest, one.linear_highest);
}

std::string with_interval(const FitParameterRecord& one) {
  const auto [lowest, highest] = interval_of(one);
  const auto end = [&](double value) { return std::isfinite(value) ? readable(value, one.unit) : std::string("open"); };
  if (std::isnan(lowest) && std::isnan(highest)) return readable(one.value, one.unit);
  return readable(one.value, one.unit) + " [" + end(lowest) + " .. " + end(highest) + "]";
}

std::string digits_of(double value, int digits = 5) { return std::isfinite(value) ? short_number(value, digits) : "-"; }

Json side(const FitRecord& fit) {
  const InformationCriteria criteria = criteria_of(fit);
  return json_object("fit", fit.name, "kind", fit.kind, "status", fit.status, "values", fit.data.size(), "degrees",
                     fit.degrees, "chi_squared", fit.chi_squared, "reduced_chi_squared", fit.reduced_chi_squared,
                     "p_value", fit.p_value, "aicc", criteria.aicc, "bic", criteria.bic);
}

Json parameter_json(const FitParameterRecord& one) {
  const auto [lowest, highest] = interval_of(one);
  return json_object("value", one.value, "standard_error", one.standard_error, "interval",
                     Json::array({finite_or_null(lowest), finite_or_null(highest)}));
}

}  // namespace

bool StoredComparison::agree() const {
  return !parameters.empty() && all_of(parameters, [](const auto& one) { return one.agree(); });
}

bool StoredComparison::within(double relative) const {
  return !parameters.empty() && all_of(parameters, [&](const auto& one) { return one.relative <= relative; });
}

StoredComparison compare_fits(const FitRecord& first, const FitRecord& second) {
  StoredComparison answer{first, second, {}, {}, {}, same_data(first, second)};
  const auto find = [](const FitRecord& fit, const std::string& name) {
    return find_if(fit.parameters, [&](const auto& one) { return is_estimated(one) && one.name == name; });
  };
  for (const FitParameterRecord& one : first.parameters) {
    if (!is_estimated(one)) continue;
    const auto other = find(second, one.name);
    if (other == second.parameters.end())
      answer.only_first.push_back(one.name);
    else
      answer.parameters.push_back(
          {one, *other, deviations_between(one, *other), std::abs(one.value - other->value) / std::abs(one.value)});
  }
  for (const FitParameterRecord& one : second.parameters)
    if (is_estimated(one) && find(first, one.name) == first.parameters.end()) answer.only_second.push_back(one.name);
  return answer;
}

std::string stored_comparison_summary(const StoredComparison& comparison) {
  const FitRecord &a = comparison.first, &b = comparison.second;
  std::ostringstream text;
  Table fits{{"fit", "status", "values", "parameters", "chi squared", "reduced", "p", "AICc", "BIC"}, {}};
  for (const FitRecord* const fit : {&a, &b}) {
    const InformationCriteria criteria = criteria_of(*fit);
    const auto parameters = count_if(fit->parameters, is_estimated);
    fits.rows.push_back({fit->name, fit->status, static_cast<std::int64_t>(fit->data.size()),
                         static_cast<std::int64_t>(parameters), digits_of(fit->chi_squared),
                         digits_of(fit->reduced_chi_squared), digits_of(fit->p_value, 3), digits_of(criteria.aicc),
                         digits_of(criteria.bic)});
  }
  write_aligned(text, fits);
  const double above = criteria_of(b).aicc - criteria_of(a).aicc;
  if (!comparison.same_data)
    text << "of other data, or other deviations of them: AICc and BIC say nothing here\n";
  else if (std::isfinite(above) && std::abs(above) > 1e-6)
    text << "the same data: AICc of " << (above < 0 ? b.name : a.name) << " is lower by " << digits_of(std::abs(above))
         << "; errors of one set of data are not independent, and parameters differ by less than by chance\n";
  text << '\n';
  if (comparison.parameters.empty()) text << "no fitted parameter in common\n";
  Table table{{"parameter", a.name, b.name, "difference", "deviations", "agree"}, {}};
  for (const ComparedParameter& one : comparison.parameters)
    table.rows.push_back({one.first.name, with_interval(one.first), with_interval(one.second), percent(one.relative),
                          digits_of(one.deviations, 3),
                          std::isnan(one.deviations) ? "-"
                          : one.agree()              ? std::string("yes")
                                                     : std::string("no")});
  if (!table.rows.empty()) write_aligned(text, table);
  for (const auto& [fit, names] : {std::pair(&a, &comparison.only_first), std::pair(&b, &comparison.only_second)})
    if (!names->empty()) text << "only in " << fit->name << ": " << joined(*names) << '\n';
  return text.str();
}

Json json_of(const StoredComparison& comparison) {
  Json object = json_object("first", side(comparison.first), "second", side(comparison.second), "same_data",
                            comparison.same_data, "agree", comparison.agree(), "parameters", Json::array(),
                            "only_first", comparison.only_first, "only_second", comparison.only_second);
  for (const ComparedParameter& one : comparison.parameters)
    object["parameters"].push_back(
        json_object("name", one.first.name, "unit", one.first.unit, "first", parameter_json(one.first), "second",
                    parameter_json(one.second), "relative_difference", one.relative, "deviations", one.deviations,
                    "agree", std::isnan(one.deviations) ? Json(nullptr) : Json(one.agree())));
  return object;
}

}  // namespace rollres
