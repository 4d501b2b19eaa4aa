#pragma once

/// The report of a fit as text, as JSON (null for what is absent) and as rows of the database. For sources only: it
/// needs nlohmann_json.

#include <string>

#include "db/rows/fit_store.hpp"
#include "fitting/fit/coverage.hpp"
#include "fitting/fit/fit_report.hpp"
#include "studies/fit/fit_curves.hpp"
#include "studies/fit/fit_design.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// What a report does not know of itself.
struct FitContext {
  std::string name, kind;               ///< kind: "resistance", "material", "shift" or "strain"
  std::string definition, data_digest;  ///< of the file, of the tables
  Indenter indenter = Indenter::cylinder;
  std::string_view output_unit = {};
  struct Fixed {
    std::string name, unit;
    double value;
  };
  std::vector<Fixed> fixed = {};
  std::vector<std::string> data_warnings = {};
  std::vector<std::string> notes = {};  ///< what the fit made of the scene
  std::string scene = {};               ///< what was fitted, as a scene: a JSON object
  std::size_t solved = 0, recalled = 0;
  double seconds = 0;
  FitCurves curves = {};  ///< empty: not drawn
  std::vector<FitInputRecord> inputs = {};
};

/// Status, parameters with errors and intervals, tests, and what to mind: for people.
std::string fit_summary(const FitReport& report, const FitContext& context);

/// How many intervals of the draws hold the truth.
std::string coverage_summary(const Coverage& coverage);

FitRecord fit_record(const FitReport& report, const FitContext& context);

/// The report with parameters, profiles and data.
Json json_of(const FitReport& report, const FitContext& context);

Json json_of(const FitDesign& design);

Json json_of(const Coverage& coverage);

}  // namespace rollres
