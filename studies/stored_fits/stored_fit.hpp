#pragma once

/// A fit of the database as text, as JSON, and as a folder that stands alone. For sources only: it needs nlohmann_json.

#include <filesystem>
#include <string>

#include "db/queries/table.hpp"
#include "db/rows/fit_store.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// Whether the parameter's linear interval is even about its logarithm rather than about itself.
bool is_logarithmic(const FitParameterRecord& one);

/// Status, parameters and tests: for people.
std::string fit_record_summary(const FitRecord& fit);

/// All that is stored, with parameters and data.
Json json_of(const FitRecord& fit);

/// Fits as rows of a table: name, kind, status, parameters, measured values, chi squared, time.
Table fit_table(const std::vector<FitSummary>& fits);

/// Writes fit.json (the fit file), parameters.csv, data.csv, profiles.csv, curves.csv, report.json and, where it is
/// known, scene.json (what was fitted, with all digits) into a folder. @return the names of the files
/// @throws std::runtime_error naming the file or folder that failed
std::vector<std::string> export_fit(const FitRecord& fit, const std::filesystem::path& folder);

}  // namespace rollres
