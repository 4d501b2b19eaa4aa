#pragma once

/// The columns of the tables of fits and where a record holds them: what is created, written, read and told. A column
/// more needs a migration (schema.hpp).

#include <tuple>
#include <type_traits>
#include <utility>

#include "db/rows/fit_store.hpp"

namespace rollres {

/// Pairs of a name and of a member, in the order of the columns.
template <class Record>
constexpr int fit_columns = 0;
template <>
inline constexpr auto fit_columns<FitRecord> = [] {
  using R = FitRecord;
  return std::tuple(
      std::pair("name", &R::name), std::pair("kind", &R::kind), std::pair("definition", &R::definition),
      std::pair("data_digest", &R::data_digest), std::pair("status", &R::status), std::pair("reason", &R::reason),
      std::pair("warnings", &R::warnings), std::pair("model", &R::model),
      std::pair("weakest_direction", &R::weakest_direction), std::pair("second_best", &R::second_best),
      std::pair("misfit_cause", &R::misfit_cause), std::pair("stopped", &R::stopped),
      std::pair("output_unit", &R::output_unit), std::pair("scene", &R::scene),
      std::pair("deviations_known", &R::deviations_known), std::pair("interrupted", &R::interrupted),
      std::pair("degrees", &R::degrees), std::pair("starts", &R::starts), std::pair("agreeing", &R::agreeing),
      std::pair("iterations", &R::iterations), std::pair("evaluations", &R::evaluations),
      std::pair("solved", &R::solved), std::pair("recalled", &R::recalled), std::pair("failures", &R::failures),
      std::pair("chi_squared", &R::chi_squared), std::pair("reduced_chi_squared", &R::reduced_chi_squared),
      std::pair("p_value", &R::p_value), std::pair("rms", &R::rms), std::pair("relative_rms", &R::relative_rms),
      std::pair("runs_p_value", &R::runs_p_value), std::pair("trend_p_value", &R::trend_p_value),
      std::pair("condition", &R::condition), std::pair("noise", &R::noise), std::pair("seconds", &R::seconds),
      std::pair("profile_threshold", &R::profile_threshold), std::pair("x_name", &R::x_name),
      std::pair("x_unit", &R::x_unit), std::pair("y_name", &R::y_name), std::pair("y_unit", &R::y_unit),
      std::pair("x_logarithmic", &R::x_logarithmic), std::pair("y_logarithmic", &R::y_logarithmic));
}();
template <>
inline constexpr auto fit_columns<FitParameterRecord> = [] {
  using R = FitParameterRecord;
  return std::tuple(std::pair("name", &R::name), std::pair("unit", &R::unit), std::pair("fixed", &R::fixed),
                    std::pair("noise", &R::noise), std::pair("value", &R::value),
                    std::pair("standard_error", &R::standard_error), std::pair("relative_error", &R::relative_error),
                    std::pair("linear_lowest", &R::linear_lowest), std::pair("linear_highest", &R::linear_highest),
                    std::pair("linear_low", &R::linear_low), std::pair("linear_high", &R::linear_high),
                    std::pair("profile_lowest", &R::profile_lowest), std::pair("profile_highest", &R::profile_highest),
                    std::pair("profile_low", &R::profile_low), std::pair("profile_high", &R::profile_high),
                    std::pair("start", &R::start), std::pair("lowest", &R::lowest), std::pair("highest", &R::highest),
                    std::pair("scale", &R::scale), std::pair("step", &R::step),
                    std::pair("slope_doubt", &R::slope_doubt), std::pair("flag", &R::flag));
}();
template <>
inline constexpr auto fit_columns<FitCorrelationRecord> = [] {
  using R = FitCorrelationRecord;
  return std::tuple(std::pair("first", &R::first), std::pair("second", &R::second),
                    std::pair("correlation", &R::correlation));
}();
template <>
inline constexpr auto fit_columns<FitDataRecord> = [] {
  using R = FitDataRecord;
  return std::tuple(std::pair("place", &R::place), std::pair("curve", &R::curve), std::pair("x", &R::x),
                    std::pair("measured", &R::measured), std::pair("deviation", &R::deviation),
                    std::pair("predicted", &R::predicted), std::pair("residual", &R::residual),
                    std::pair("band", &R::band));
}();
template <>
inline constexpr auto fit_columns<FitProfileRecord> = [] {
  using R = FitProfileRecord;
  return std::tuple(std::pair("parameter", &R::parameter), std::pair("value", &R::value), std::pair("rise", &R::rise));
}();
template <>
inline constexpr auto fit_columns<FitInputRecord> = [] {
  using R = FitInputRecord;
  return std::tuple(std::pair("datum", &R::datum), std::pair("name", &R::name), std::pair("unit", &R::unit),
                    std::pair("value", &R::value));
}();
template <>
inline constexpr auto fit_columns<FitCurveRecord> = [] {
  using R = FitCurveRecord;
  return std::tuple(std::pair("curve", &R::curve), std::pair("label", &R::label), std::pair("x", &R::x),
                    std::pair("value", &R::value), std::pair("band", &R::band));
}();
template <>
inline constexpr auto fit_columns<FitFailureRecord> = [] {
  using R = FitFailureRecord;
  return std::tuple(std::pair("reason", &R::reason), std::pair("count", &R::count),
                    std::pair("first_place", &R::first_place));
}();

/// Calls `visit(name, value)` for each column of a record.
template <class Record, class Visit>
void visit_columns(Record& record, Visit&& visit) {
  std::apply([&](const auto&... column) { (visit(column.first, record.*column.second), ...); },
             fit_columns<std::remove_const_t<Record>>);
}

}  // namespace rollres
