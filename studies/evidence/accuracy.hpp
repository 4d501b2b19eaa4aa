#pragma once

/// Error against time: each method on one scene, on a grid over a range of spacings, without one over a range of
/// tolerances.
///
/// The error is that of the rolling resistance R_r relative to a reference: for a cylinder the spectral method's where
/// that answers, else the Newton method's on a grid at least twice as fine as any shown. Between grids R_r jumps
/// whenever a node enters or leaves the contact, so that it is extrapolated to no spacing only where four grids in the
/// ratio of two show one and the same order. What the last halving of the spacing changed is the uncertainty of the
/// reference; smaller errors mean nothing.

#include "db/queries/table.hpp"
#include "studies/drawing/chart.hpp"
#include "studies/run/measured_solve.hpp"

namespace rollres {

struct AccuracyOptions {
  std::vector<Method> methods = {};   ///< empty: every method that solves the scene's body
  std::vector<double> spacings = {};  ///< [m]; empty: see usual_spacings
  std::optional<int> levels = {};     ///< of the usual spacings, how many, the coarsest first
  int repeats = 5;                    ///< for the median; fewer once they take longer than the limit together
  double seconds_limit = 30;          ///< a solution that would take longer, or does, is left out [s]
  std::function<void(const std::string&)> report = {};  ///< told what is at work
};

enum class AccuracyStatus { converged, no_steady_state, not_converged, failed, skipped };
template <>
struct ChoiceNames<AccuracyStatus> {
  static constexpr std::array<std::string_view, 5> names{"converged", "no_steady_state", "not_converged", "failed",
                                                         "skipped"};
};

/// One method at one spacing or, without a grid, one tolerance.
struct AccuracyPoint {
  Method method = Method::newton;
  double spacing = RollingSolution::absent;    // [m]
  double tolerance = RollingSolution::absent;  // [1]
  AccuracyStatus status = AccuracyStatus::skipped;
  std::string reason = {};        ///< why it did not converge, failed or was skipped
  RollingSolution solution = {};  ///< without its fields
  double seconds = RollingSolution::absent, processor_seconds = RollingSolution::absent;  // medians [s]
  double peak_memory = RollingSolution::absent;                                           // [B]
  int repeats = 0;
  double error = RollingSolution::absent;  ///< R_r over that of the reference, minus one [1]
};

struct AccuracyReference {
  double rolling_resistance = RollingSolution::absent;
  double uncertainty = RollingSolution::absent;  ///< relative
  Method method = Method::newton;
  double spacing = RollingSolution::absent;  // [m]; absent without a grid
  int contact_nodes = 0;
  bool extrapolated = false;  ///< from four grids, of which `spacing` is the finest

  bool found() const { return std::isfinite(rolling_resistance); }
};

/// Exponents of power laws fitted to the points of one method by least squares; NaN with fewer than three points.
struct AccuracyTrend {
  Method method = Method::newton;
  double order = RollingSolution::absent;            ///< error ~ spacing^order, errors above thrice the uncertainty
  double order_deviation = RollingSolution::absent;  ///< standard error of `order`
  double growth = RollingSolution::absent;           ///< seconds ~ contact nodes^growth, the finer half of the points
};

struct AccuracyReport {
  std::string name;  ///< of the scene
  RollingScene scene;
  AccuracyReference reference;
  std::vector<AccuracyPoint> points;  ///< method by method, from coarse to fine
  std::vector<AccuracyTrend> trends;
};

/// Methods by their names, each once. @throws std::invalid_argument "--methods = ..." naming the nearest known one
std::vector<Method> methods_named(const std::vector<std::string>& names);

/// Spacings from 8 to about 500 nodes along a cylinder's contact, to about 130 along a sphere's, each 1/sqrt(2) of the
/// last; the scene's own spacing is among them if it has one and it lies in the range.
std::vector<double> usual_spacings(const RollingScene& scene);

/// Measures a scene.
/// @param name of the scene, for the report
/// @throws std::invalid_argument if the scene breaks a rule at one of the spacings
AccuracyReport measure_accuracy(const std::string& name, const RollingScene& scene, const AccuracyOptions& options,
                                const Measure& measure);

/// One row for each scene, method and spacing, all of it in SI; what is absent is empty.
Table accuracy_rows(const std::vector<AccuracyReport>& reports);

/// A heading, one row for each spacing (and each tolerance) with the error, seconds and memory of each method, what the
/// reference was, the observed orders, and why answers are missing; to be read as it is, or as Markdown.
std::string accuracy_text(const AccuracyReport& report, bool markdown);

/// Error against seconds, both logarithmic, one curve for each method. On a single grid an error may be small by luck,
/// so that a point shows the largest one at its spacing or a finer one, and no less than the uncertainty of the
/// reference: what can be relied on. Without curves if there is no error.
ChartRequest accuracy_chart(const AccuracyReport& report);

}  // namespace rollres
