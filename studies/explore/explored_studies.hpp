#pragma once

/// The studies of a database for a page: their charts as data, their rows a screen at a time, points as scenes,
/// reports. For sources only: it needs nlohmann_json.

#include <filesystem>
#include <map>
#include <string>

#include "studies/text/strict_json.hpp"

namespace rollres {

/// What a request says after its "?".
using Asked = std::map<std::string, std::string>;

/// All studies and fits, with their axes, charts and how far they are. @throws std::runtime_error if the database fails
Json studies_for_pages(const std::filesystem::path& database);

/// The chart of "study"; "x", "y", "family", "chart" and "where" (filters, a line each) as options of `rollres chart`;
/// "keys" has those of x and of the families.
/// @throws std::invalid_argument as stored_chart
Json study_chart_for_pages(const std::filesystem::path& database, const Asked& asked);

/// Rows of "study": "columns" and "sort" (keys separated by commas), "where", from row "offset" on so many as "limit".
/// Numbers are those of `rollres query`, for people.
/// @throws std::invalid_argument as run_query
Json rows_for_pages(const std::filesystem::path& database, const Asked& asked);

/// How many rows of "study" meet "where": it takes longer than the first of them. @throws as run_query
Json count_for_pages(const std::filesystem::path& database, const Asked& asked);

/// The scene of the row "id". @throws std::invalid_argument if there is none
Json point_for_pages(const std::filesystem::path& database, const Asked& asked);

/// The report of "study" (or fit, or optimisation) as one HTML file. @throws as study_report
std::string report_for_pages(const std::filesystem::path& database, const Asked& asked);

}  // namespace rollres
