#pragma once

/// Fits that are kept, as plain rows: what was fitted to which data, and what came out.
///
///     fit              one row for each fit: a name with one state of its file and data; run again, it is replaced
///     fit_parameter    its parameters: value, errors, intervals
///     fit_correlation  pairs of them
///     fit_data         the measured values with what the fit makes of them
///     fit_input        what a measured value was measured at: each input that varies, by fit_data.position
///     fit_profile      the profile likelihood of each parameter, point by point
///     fit_curve        the fitted curves between the measured values, point by point
///     fit_failure      why predictions failed, each reason once
///
/// Measured values lie over an axis, the speed where that varies: `fit.x_name`, `x_unit` and `x_logarithmic` name it,
/// `fit_data.x` is where a value lies, `fit_data.curve` which curve it belongs to. Values of another output than the
/// curves' have no x, and -1 as their curve.
///
/// What is absent (NaN) is NULL; so is the end of an interval that is open.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "db/file/database.hpp"

namespace rollres {

struct FitParameterRecord {
  static constexpr double absent = std::numeric_limits<double>::quiet_NaN();

  std::string name, unit;
  bool fixed = false;  ///< not of a scene that the fit could change: given, or a term of the noise
  bool noise = false;  ///< a term of the noise, by likelihood
  double value = absent, standard_error = absent, relative_error = absent;
  double linear_lowest = absent, linear_highest = absent;
  std::string linear_low = {}, linear_high = {};  ///< "closed", "limit" or "open"; empty: fixed
  double profile_lowest = absent, profile_highest = absent;
  std::string profile_low = {}, profile_high = {};  ///< the same; empty without a profile
  double start = absent, lowest = absent, highest = absent;
  std::string scale = {};  ///< "logarithmic" or "linear"; empty: not known
  double step = absent, slope_doubt = absent;
  std::string flag = {};
};

struct FitDataRecord {
  std::string place;                                      ///< "data.csv, line 7"
  double measured, deviation, predicted, residual, band;  ///< band: standard error of what is predicted
  double x = FitParameterRecord::absent;                  ///< its place on the axis, in fit.x_unit (SI)
  std::int64_t curve = -1;                                ///< number of its curve, from 0; -1: none
};

/// An input of a measured value.
struct FitInputRecord {
  std::int64_t datum = 1;  ///< its place in FitRecord::data, from 1: fit_data.position
  std::string name, unit;
  double value = FitParameterRecord::absent;  ///< in the unit (SI)
};

/// A point of the profile of a parameter: the least misfit with the parameter held there.
struct FitProfileRecord {
  std::string parameter;
  double value;  ///< of the parameter [SI], in rising order
  /// Of the misfit above the least, over its scale [1]: the interval's ends are where it is fit.profile_threshold.
  double rise;
};

/// A point of a fitted curve, in fit.x_unit and fit.y_unit (SI).
struct FitCurveRecord {
  std::int64_t curve;  ///< its number, from 0
  std::string label;   ///< what tells it from the others: "P = 20 kN/m"; empty where there is one
  double x, value;
  double band;  ///< half-width of the 95 % band
};

struct FitCorrelationRecord {
  std::string first, second;
  double correlation;
};

/// A reason for which predictions failed.
struct FitFailureRecord {
  std::string reason;
  std::int64_t count;
  std::string first_place;  ///< the measurement, "data.csv, line 7"
};

struct FitRecord {
  static constexpr double absent = FitParameterRecord::absent;

  std::string name = {}, kind = {};                     ///< kind: "resistance", "material", "shift" or "strain"
  std::string definition = {}, data_digest = {};        ///< text of the fit's file; digest of the files of the data
  std::string status = {}, reason = {}, warnings = {};  ///< warnings: a line each
  std::string model = {};                               ///< what the fit made of the scene: a line each
  std::string weakest_direction = {};                   ///< of the parameters, in words
  std::string second_best = {};   ///< another least misfit that the data do not tell from the best, in words
  std::string misfit_cause = {};  ///< what most likely makes a MISFIT; empty: nothing stands out
  std::string stopped = {};       ///< words of the minimiser on the best descent
  std::string output_unit = {};   ///< of the measured values; empty where they are of several kinds
  std::string scene = {};         ///< the fitted scene or material, a JSON object with all digits; empty: not known
  bool deviations_known = false, interrupted = false;
  /// iterations: of the best descent; it and solved are -1 where a former version stored the fit
  std::int64_t degrees = 0, starts = 0, agreeing = 0, iterations = 0;
  std::int64_t evaluations = 0, solved = 0, recalled = 0, failures = 0;
  double chi_squared = absent, reduced_chi_squared = absent, p_value = absent, rms = absent, relative_rms = absent;
  double runs_p_value = absent,
         trend_p_value = absent;  ///< of the residuals in the order of the data, of what is predicted
  double condition = absent, noise = absent, seconds = absent;
  double profile_threshold = absent;                               ///< rise at the ends of 95 % intervals [1]
  std::string x_name = {}, x_unit = {}, y_name = {}, y_unit = {};  ///< the axes of the curves: words; empty: no curves
  bool x_logarithmic = false, y_logarithmic = false;
  std::vector<FitParameterRecord> parameters = {};
  std::vector<FitCorrelationRecord> correlations = {};  ///< the strongest first
  std::vector<FitDataRecord> data = {};
  std::vector<FitProfileRecord> profiles = {};
  std::vector<FitCurveRecord> curves = {};  ///< curve by curve, x in rising order
  std::vector<FitInputRecord> inputs = {};  ///< value by value
  std::vector<FitFailureRecord> failure_reasons = {};
};

/// The tables above: a migration (schema.hpp).
void create_fit_tables(SQLite::Database& connection);

/// Stores a fit in one transaction, in place of one of the same name, file and data.
/// @return its id
/// @throws std::runtime_error naming the file if the database fails
std::int64_t save_fit(const Database& database, const FitRecord& fit);

/// What a list of fits says of one.
struct FitSummary {
  std::int64_t id = 0;
  std::string name, kind, status, created, parameters;  ///< parameters: the names of the fitted ones
  std::int64_t values = 0;                              ///< measured
  double chi_squared = FitParameterRecord::absent;
};

/// All fits, by name and age.
std::vector<FitSummary> stored_fits(const Database& database);

/// The table fit's column of fitted scenes: a migration.
void add_fit_scenes(SQLite::Database& connection);

/// What pictures of fits need: axes, profiles and curves. A migration.
void add_fit_curves(SQLite::Database& connection);

/// The table of the inputs of measured values. A migration.
void add_fit_inputs(SQLite::Database& connection);

/// What is told of fits beside that: their model, ends of intervals, noise, failures. A migration.
void add_fit_details(SQLite::Database& connection);

enum class FitParts { without_data, with_data };  ///< data with their inputs, profiles, curves and failures

/// The newest fit of a name.
std::optional<FitRecord> find_fit(const Database& database, const std::string& name,
                                  FitParts parts = FitParts::without_data);

}  // namespace rollres
