#pragma once

/// The tables of a database, and the columns that follow from the lists of quantities.
///
///     evaluation    one row for each scene that was solved: a column for each input and each output. What is absent
///                   (NaN, not given, not applicable) is NULL; an infinite layer_thickness is SQLite's Inf.
///     fields        the fields on the surface, where they were asked for, by the key of their evaluation: compressed
///                   (fields_table.hpp)
///     provenance    what computed an evaluation
///     study         a name, its axes, the text of its file, and a note
///     study_point   the points of a study, in order, by the key of their evaluation: one that has no evaluation yet is
///                   missing, and an evaluation serves every study that has its key; and by the name of their variant,
///                   which is the study's word for some inputs and so no part of the evaluation; for an optimisation
///                   the design that a point is of (the position of its first row), and in this row what the design
///                   is worth: goal, second_goal, whether it is feasible (1 or 0), its place on the front
///     result        a view ready to plot: study, position and so on, and all columns of evaluation
///     converged     the same, only rows with an answer
///     resistance    of these the few columns that are plotted most
///
/// One index, evaluation_summary, holds the columns that are filtered and sorted by most: a question about them reads
/// a tenth of the file, and one sorted by rolling resistance stops as soon as its first page is full.
///
/// load, approach, driving_torque, rotation_ratio, spacing and method are inputs and outputs. The column with the plain
/// key holds the answer's: what the scene asked for if it did, but for the spacing and the method used, or what was
/// found. What the scene asked for stands in given_load, given_approach and so on, too, NULL where it left it open.

#include <array>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/quantity.hpp"
#include "db/file/database.hpp"
#include "db/file/sql_text.hpp"

namespace rollres {

/// Column of an input: its key, or "given_" and its key where an output has the same one.
std::string input_column(std::string_view key);

struct Column {
  std::string name;
  std::string type;             ///< "REAL", "INTEGER" or "TEXT"
  std::string expression = {};  ///< SQL of its value; empty: the name, quoted

  std::string sql() const { return expression.empty() ? quoted_name(name) : expression; }
};

struct QuantityColumn : Column {
  Quantity quantity;
  bool is_input = false;
};

/// Columns of evaluation that hold quantities, inputs first, in the order of the lists.
const std::vector<QuantityColumn>& quantity_columns();

/// Column of study_point and of result: the variant of a study that a point is of.
inline constexpr std::string_view variant_key = "variant";
/// Column of result: the study that a point is of.
inline constexpr std::string_view study_key = "study";
/// Columns of result that tell what a point is in its study, beside those of evaluation.
inline constexpr std::array<std::string_view, 8> point_columns{"study", "position",    "variant",  "design",
                                                               "goal",  "second_goal", "feasible", "front"};

/// What stands in a column, or nullptr if it is none of these. An input of a further layer counts as one: what
/// "coating_layers[0].layer_thickness" names is computed from the list in coating_layers. So do the variant and the
/// study.
const QuantityColumn* find_quantity_column(std::string_view name);

/// Columns of the index evaluation_summary. Changing them needs a migration.
inline constexpr std::array<std::string_view, 8> summary_columns{
    "rolling_resistance", "status", "indenter", "speed", "load", "friction_coefficient", "radius", "layer_thickness"};

/// The index of study_point, by which an evaluation knows its studies.
inline constexpr const char* study_point_index = "CREATE INDEX study_point_key ON study_point(key)";

/// Columns that table or view has in this file, and their names.
std::vector<Column> columns_of(SQLite::Database& connection, const std::string& table);
std::set<std::string> column_names(SQLite::Database& connection, const std::string& table);

/// From an empty file to the present schema, one step for each version.
std::span<const Migration> schema_migrations();

/// Opens a database of this version's schema.
/// @throws as Database
Database open_database(const std::filesystem::path& file, Access access);

/// Gives evaluation the columns of quantities that this version knows and the file does not; its rows hold NULL there.
void add_missing_columns(SQLite::Database& connection);

}  // namespace rollres
