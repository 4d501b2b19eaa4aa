#pragma once

/// Questions to the fits of a store: one row for each fit, with a column for each parameter that any of them fitted.
///
///     name, kind, status, ...        the columns of the table fit; `values`: how many measured ones, `parameters`
///     PARAMETER                      its value [SI]
///     PARAMETER_error                its standard error [SI]
///     PARAMETER_lowest, _highest     the ends of its 95 % interval [SI], of its profile where there is one

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "db/queries/query.hpp"

namespace rollres {

/// What a column of a parameter holds: its value, or what ends with these.
inline constexpr std::array<std::string_view, 4> parameter_columns{"", "_error", "_lowest", "_highest"};

struct StoredParameter {
  std::string name;
  std::string unit;  ///< SI; empty where it differs from fit to fit
};

/// The parameters that were fitted, by name.
/// @throws std::runtime_error naming the file if the database fails
std::vector<StoredParameter> fitted_parameters(const Database& database);

/// What a row of fits shows where no columns are asked for: all but the texts of files and the axes of curves.
std::vector<std::string> usual_fit_columns(const Database& database);

/// As run_query, of fits; what the question computes is left out.
/// @throws as run_query
Table run_fit_query(const Database& database, const Query& query);

}  // namespace rollres
