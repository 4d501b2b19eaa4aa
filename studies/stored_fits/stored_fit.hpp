#pragma once

/// A fit, just made or of the database, as text, as JSON, and as a folder that stands alone. For sources only: it needs
/// nlohmann_json.

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "db/queries/table.hpp"
#include "db/rows/fit_store.hpp"
#include "db/rows/result_store.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// Whether the parameter's linear interval is even about its logarithm rather than about itself.
bool is_logarithmic(const FitParameterRecord& one);

/// The parameters as people read them: value, errors, 95 % intervals, start, and what to mind.
Table fit_parameter_table(const FitRecord& fit);

/// What the residuals of a good fit scatter by: 1, and where no deviations were given what they were found to.
double scatter_of(const FitRecord& fit);

/// The tests of a fit, its descents and its cost: pairs of a name and of what is known.
std::vector<std::pair<std::string, std::string>> fit_statistics(const FitRecord& fit);

/// Status, what to mind, parameters, tests and correlations: for people.
std::string fit_summary(const FitRecord& fit);

/// All that is known of a fit but its file, for programs; null for what is absent.
Json json_of(const FitRecord& fit);

/// Fits as rows of a table: name, kind, status, parameters, measured values, chi squared, time.
Table fit_table(const std::vector<FitSummary>& fits);

/// The fit that a name means: one that no study bears, or without a name the only one of a database without studies.
std::optional<FitRecord> meant_fit(ResultStore& store, std::string name, FitParts parts);

/// @param asked  stands before the name: "fits.db: --fit = "
/// @throws std::invalid_argument that the database has no fit of this name, with the nearest one
[[noreturn]] void refuse_fit(const Database& database, const std::string& name, const std::string& asked);

/// Writes fit.json (the fit file), parameters.csv, data.csv, profiles.csv, curves.csv, report.json and, where it is
/// known, scene.json (what was fitted, with all digits) into a folder. @return the names of the files
/// @throws std::runtime_error naming the file or folder that failed
std::vector<std::string> export_fit(const FitRecord& fit, const std::filesystem::path& folder);

}  // namespace rollres
