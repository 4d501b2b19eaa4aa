#include "studies/evidence/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <utility>

#include "core/derivatives/objective.hpp"
#include "studies/scene_io/cells.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

namespace {

std::string scientific(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*e", digits, value);
  return text;
}

std::string three_digits(double value, const std::string& otherwise) {
  return std::isfinite(value) ? short_number(value, 3) : otherwise;
}

std::vector<Method> methods_of(const AccuracyReport& report) {
  std::vector<Method> methods;
  for (const AccuracyTrend& trend : report.trends) methods.push_back(trend.method);
  return methods;
}

std::string error_in_words(const AccuracyPoint& point, const AccuracyReference& reference) {
  if (point.status == AccuracyStatus::no_steady_state) return "no steady state";
  if (point.status == AccuracyStatus::not_converged) return "not converged";
  if (point.status != AccuracyStatus::converged) return std::string(name_of(point.status));
  if (std::isnan(point.error)) return reference.found() ? "reference" : "?";
  if (std::abs(point.error) <= reference.uncertainty) return "< " + scientific(reference.uncertainty, 1);
  return scientific(std::abs(point.error), 1);
}

/// One row for each spacing, or each tolerance, that some of the methods were tried at.
/// @param key which of the two   @param name of the first column   @param text of its entries
std::string table_of(const AccuracyReport& report, const std::vector<Method>& methods, double AccuracyPoint::*key,
                     const std::string& name, const std::function<std::string(double)>& text, bool markdown) {
  Table table{{name, "nodes"}, {}};
  for (const Method method : methods)
    for (const std::string& head : {std::string(name_of(method)) + ": error", std::string("s"), std::string("MB")})
      table.columns.push_back(head);
  std::vector<double> values;
  for (const AccuracyPoint& point : report.points)
    if (std::isfinite(point.*key)) values.push_back(point.*key);
  std::sort(values.rbegin(), values.rend());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  for (const double value : values) {
    int nodes = 0;
    std::vector<Cell> cells;
    for (const Method method : methods) {
      const auto point = find_if(report.points, [&](const AccuracyPoint& candidate) {
        return candidate.method == method && candidate.*key == value;
      });
      if (point == report.points.end()) continue;
      if (nodes == 0 && point->status == AccuracyStatus::converged) nodes = point->solution.contact_nodes;
      constexpr double megabyte = 1e6;
      cells.push_back(error_in_words(*point, report.reference));
      cells.push_back(three_digits(point->seconds, "-"));
      cells.push_back(std::isfinite(point->peak_memory) ? short_number(point->peak_memory / megabyte, 2)
                                                        : std::string("-"));
    }
    cells.insert(cells.begin(), {text(value), nodes > 0 ? std::to_string(nodes) : std::string("-")});
    table.rows.push_back(std::move(cells));
  }
  std::ostringstream out;
  (markdown ? write_markdown(out, table) : write_aligned(out, table));
  out << '\n';
  return out.str();
}

std::string tables_text(const AccuracyReport& report, bool markdown) {
  std::vector<Method> gridded, gridless;
  for (const Method method : methods_of(report)) (on_grid(method) ? gridded : gridless).push_back(method);
  std::string tables;
  if (!gridded.empty())
    tables += table_of(
        report, gridded, &AccuracyPoint::spacing, "spacing", [](double spacing) { return readable(spacing, "m"); },
        markdown);
  if (!gridless.empty())
    tables += table_of(
        report, gridless, &AccuracyPoint::tolerance, "tolerance",
        [](double tolerance) { return scientific(tolerance, 0); }, markdown);
  return tables;
}

/// Where a point or a reference stands.
std::string place_in_words(double spacing, double tolerance) {
  return std::isfinite(spacing) ? readable(spacing, "m") : "tolerance " + scientific(tolerance, 0);
}

std::string reference_in_words(const AccuracyReport& report) {
  const AccuracyReference& reference = report.reference;
  if (!reference.found()) return "no reference: no answer can be trusted, so that no error is known";
  const std::string unit(real_output("rolling_resistance").unit_for(body_of(report.scene)));
  const double certain = std::isfinite(reference.uncertainty) ? reference.uncertainty : 1e-7;
  const int digits = std::clamp(static_cast<int>(std::ceil(1 - std::log10(std::max(certain, 1e-12)))), 4, 13);
  std::string text = "reference: R_r = " + short_number(reference.rolling_resistance, digits) + " " + unit + ", " +
                     (reference.extrapolated ? "extrapolated from four grids of " : "of ") +
                     std::string(name_of(reference.method));
  if (std::isfinite(reference.spacing))
    text += (reference.extrapolated ? std::string(", the finest") : std::string()) + " at " +
            readable(reference.spacing, "m") + " with " + std::to_string(reference.contact_nodes) + " nodes in contact";
  else
    text += " with " + std::to_string(reference.contact_nodes) + " coefficients of the pressure";
  text += std::isfinite(reference.uncertainty) ? "; certain to about " + scientific(reference.uncertainty, 1)
                                               : std::string("; nothing tells how certain it is");
  return text;
}

/// Trends, and what is missing and why, each reason once.
std::vector<std::string> notes(const AccuracyReport& report) {
  std::vector<std::string> lines;
  for (const AccuracyTrend& trend : report.trends) {
    std::string text;
    if (std::isfinite(trend.order))
      text += "error ~ spacing^" + short_number(std::round(100 * trend.order) / 100, 4) + " (± " +
              short_number(trend.order_deviation, 1) + ")";
    if (std::isfinite(trend.growth))
      text += (text.empty() ? "" : ", ") + std::string("seconds ~ nodes^") + short_number(trend.growth, 3);
    if (!text.empty()) lines.push_back(std::string(name_of(trend.method)) + ": " + text);
  }
  for (const AccuracyPoint& point : report.points) {
    if (point.reason.empty()) continue;
    const auto same = [&](const AccuracyPoint& other) {
      return other.method == point.method && other.status == point.status &&
             (other.spacing > point.spacing || other.tolerance > point.tolerance);
    };
    if (any_of(report.points, same)) continue;
    lines.push_back(std::string(name_of(point.method)) + " at " + place_in_words(point.spacing, point.tolerance) +
                    ": " + std::string(name_of(point.status)) + ": " + point.reason);
  }
  return lines;
}

}  // namespace

Table accuracy_rows(const std::vector<AccuracyReport>& reports) {
  Table table;
  for (const AccuracyReport& report : reports) {
    const AccuracyReference& reference = report.reference;
    const Table rows = table_of(report.points, [&](const AccuracyPoint& point) {
      const RollingSolution& solution = point.solution;
      const bool solved = point.repeats > 0;
      return NamedCells{{"scene", cell_of(report.name)},
                        {"method", cell_of(point.method)},
                        {"spacing", cell_of(point.spacing)},
                        {"tolerance", cell_of(point.tolerance)},
                        {"contact_nodes", solved ? cell_of(solution.contact_nodes) : Cell()},
                        {"rolling_resistance", cell_of(solution.rolling_resistance)},
                        {"relative_error", cell_of(point.error)},
                        {"seconds", cell_of(point.seconds)},
                        {"processor_seconds", cell_of(point.processor_seconds)},
                        {"repeats", cell_of(point.repeats)},
                        {"peak_memory", cell_of(point.peak_memory)},
                        {"iterations", solved ? cell_of(solution.iterations) : Cell()},
                        {"law_violation", cell_of(solution.law_violation)},
                        {"status", cell_of(point.status)},
                        {"reason", cell_of(point.reason)},
                        {"reference", cell_of(reference.rolling_resistance)},
                        {"reference_method", reference.found() ? cell_of(reference.method) : Cell()},
                        {"reference_spacing", cell_of(reference.spacing)},
                        {"reference_extrapolated", cell_of(reference.extrapolated ? 1 : 0)},
                        {"reference_uncertainty", cell_of(reference.uncertainty)}};
    });
    table.columns = rows.columns;
    table.rows.insert(table.rows.end(), rows.rows.begin(), rows.rows.end());
  }
  return table;
}

std::string accuracy_text(const AccuracyReport& report, bool markdown) {
  std::string text = (markdown ? "### " : "") + report.name + "\n\n" + tables_text(report, markdown);
  text += (markdown ? "- " : "") + reference_in_words(report) + "\n";
  for (const std::string& line : notes(report)) text += (markdown ? "- " : "") + line + "\n";
  return text;
}

ChartRequest accuracy_chart(const AccuracyReport& report) {
  ChartRequest request;
  request.title = report.name + ": error against time";
  request.x = {.name = "time of a solution", .unit = "s", .logarithmic = true, .margin = 0.05};
  request.y = {.name = "relative error of", .symbol = "R_r", .logarithmic = true};
  request.family = {.name = "method"};
  request.mark_peaks = false;
  request.comment =
      reference_in_words(report) +
      "\neach point: the largest error at its spacing (or tolerance) or a finer one, no less than the uncertainty";
  for (const Method method : methods_of(report)) {
    ChartCurve curve{std::string(name_of(method)), {}};
    double largest = std::isfinite(report.reference.uncertainty) ? report.reference.uncertainty : 0;
    for (auto point = report.points.rbegin(); point != report.points.rend(); ++point) {
      if (point->method != method || !std::isfinite(point->error)) continue;
      largest = std::max(largest, std::abs(point->error));
      if (largest > 0) curve.points.push_back({point->seconds, largest});
    }
    std::reverse(curve.points.begin(), curve.points.end());
    if (!curve.points.empty()) request.curves.push_back(std::move(curve));
  }
  return request;
}

}  // namespace rollres
