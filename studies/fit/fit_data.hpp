#pragma once

/// The data of a fit file: which tables it names, and what is read from them. For sources only: it needs
/// nlohmann_json.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "studies/fit/fit_file.hpp"
#include "studies/scene_io/scene_entries.hpp"
#include "studies/text/measured_table.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// One data set as it was given.
struct GivenSet {
  std::string name;
  std::string file;  // beside the fit's file
  std::vector<SceneEntry> set = {};
  std::optional<Json> sigma = {};
  std::string place;
  std::string output = {};                // empty: the fit's
  std::vector<std::string> ignored = {};  // columns
  std::optional<ListedModuli> listed_moduli = {};
};

/// The data sets that a fit names. @throws std::invalid_argument naming file, key, value and rule
std::vector<GivenSet> given_sets(const Json& fit, const std::filesystem::path& file, const std::string& place);

/// Reads all data sets into the fit; a table that several sets read may have a column for each of their outputs.
/// @param keep_spacing  the fit's own set has a spacing   @return the text of all tables
/// @throws std::invalid_argument naming table, line, column and rule
std::string read_data(FitFile& fit, const std::vector<GivenSet>& sets, const std::vector<SceneEntry>& base,
                      bool keep_spacing);

/// A cell of a column that is an input, as an entry of a scene.
/// @throws std::invalid_argument naming table, line, column, cell and rule
SceneEntry column_entry(const MeasuredTable& table, const MeasuredColumn& column, std::size_t row);

/// Whether the scene has smooth answers without its spacing.
bool smooth_without_spacing(const RollingScene& scene);

/// Warns of rows that the tables have twice.
void warn_of_repeated_rows(FitFile& fit);

/// Warns of values of very different sizes that count alike, as neither a sigma nor a noise weighs them.
void warn_of_equal_weights(FitFile& fit);

}  // namespace rollres
