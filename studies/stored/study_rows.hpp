#pragma once

/// A stored study: its rows, read by column; how a column is shown (words, units, scales); what computed them,
/// and how far the study is, in one or several databases.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "db/queries/query.hpp"
#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/drawing/chart.hpp"
#include "studies/study/study.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

enum class AxisScale { automatic, linear, logarithmic };
template <>
struct ChoiceNames<AxisScale> {
  static constexpr std::array<std::string_view, 3> names{"auto", "linear", "logarithmic"};
};

inline std::string key_of(const QuantityColumn& column) { return std::string(column.quantity.key); }

/// The columns of quantities of these rows: in place of each list of further layers, the inputs of as many layers as
/// the longest one has.
std::vector<const QuantityColumn*> quantity_columns_of(const Database& database, const std::vector<Filter>& filters);

class StudyRows {
 public:
  /// All rows of the study that meet the filters, in the order of its points.
  /// @throws std::invalid_argument if there is none
  /// @throws std::runtime_error naming the file if the database fails
  StudyRows(ResultStore& store, const std::string& study, const std::vector<Filter>& filters = {});
  /// Other rows of a study that is read already, with its columns.
  StudyRows(const StudyRows& like, ResultStore& store, const std::string& study, const std::vector<Filter>& filters);
  /// Those of several studies, one after the other.
  /// @throws std::invalid_argument if two of them compute one number differently
  explicit StudyRows(const std::vector<StudyRows>& studies);

  std::size_t size() const { return table_.rows; }
  /// As quantity_columns_of, then the numbers that the study derives from them.
  const std::vector<const QuantityColumn*>& columns() const { return columns_; }
  /// @throws std::invalid_argument for an input of a layer that no row has
  Cell cell(std::size_t row, const Column& column) const;
  double number(std::size_t row, const Column& column) const;  ///< NaN if absent
  double number(std::size_t row, const char* key) const;       ///< of an output
  std::string text(std::size_t row, const char* key) const;    ///< of an output; empty if absent
  bool converged(std::size_t row) const;
  bool breaks_constraint(std::size_t row) const;         ///< of an optimisation; else never
  std::vector<Cell> values(const Column& column) const;  ///< each once, in order
  /// The value that all rows share; none if they differ, or it is absent.
  std::optional<Cell> common(const Column& column) const;

 private:
  void read(ResultStore& store, const std::string& study, const std::vector<Filter>& filters,
            const FormulaDefinitions& formulas);
  const CellColumn& cells(const Column& column) const;

  ColumnTable table_;
  std::vector<const QuantityColumn*> columns_;
  std::map<std::string, std::size_t> places_;
};

/// A column of the stored rows, a derived number among them; an axis is shown as it was given, not as it was found.
/// @param option  for the message
/// @throws std::invalid_argument naming option and key, and the nearest known one
const QuantityColumn& column_of(const std::string& key, const StudyOutline& study, const StudyRows& rows,
                                const std::string& option);

/// The same for a column of numbers.
const QuantityColumn& number_column(const std::string& key, const StudyOutline& study, const StudyRows& rows,
                                    const std::string& option);

/// The unit of a column in these rows.
/// @throws std::invalid_argument if it is not the same in all, because cylinders stand beside spheres
std::string_view unit_in(const StudyRows& rows, const QuantityColumn& column);

/// The body of a row.
Body body_at(const StudyRows& rows, std::size_t row);
/// The order of values of columns: of names that of the study's points, of numbers that of their sizes.
class StudyOrder {
 public:
  StudyOrder(const StudyRows& rows, std::span<const QuantityColumn* const> columns);
  bool operator()(const Cell& a, const Cell& b) const;
  bool operator()(const std::vector<Cell>& a, const std::vector<Cell>& b) const;

 private:
  std::map<Cell, std::size_t> places_;  // of names
};

/// The first body whose numbers are per metre where those of the first row are of a whole body, or the other way round.
std::optional<Body> body_of_other_units(const StudyRows& rows);

/// A value as people read it; "none" if it is absent.
std::string value_in_words(const Cell& cell, std::string_view unit);
/// The same of a quantity, whose temperatures people read in degrees Celsius.
std::string value_in_words(const Quantity& quantity, const Cell& cell, std::string_view unit);

/// Name and symbol of a column.
ChartAxis described(const QuantityColumn& column);

/// Unit, and whether logarithmic.
struct ColumnScale {
  ScaledUnit unit;
  bool logarithmic = false;
};
/// As above, in the words for this unit: a contact's area is, per metre of a cylinder, its length.
ChartAxis described(const QuantityColumn& column, const ColumnScale& scale);

/// @param hint  the study spaced the column logarithmically
/// @param option  for the message
/// @throws std::invalid_argument if a logarithmic scale is wished for values that are not positive
ColumnScale scale_of(const StudyRows& rows, const QuantityColumn& column, AxisScale wish, bool hint,
                     const std::string& option);
/// The same for some values of a column [unit].
ColumnScale scale_of(std::span<const double> values, const QuantityColumn& column, std::string_view unit,
                     AxisScale wish, bool hint, const std::string& option);

/// An axis with its name, unit and scale.
ChartAxis scaled_axis(const QuantityColumn& column, const ColumnScale& scale);

/// What all rows have in common, line by line: "radius = 20 mm".
std::string common_inputs(const StudyRows& rows);

/// The study that a command means: the one of this name or, with no name, the only one.
/// @throws std::invalid_argument naming the file: it holds no study, several (with their names), or none of that name
///         (with the nearest one)
/// @throws std::runtime_error naming the file if the database fails
std::string stored_study_name(ResultStore& store, const std::string& name);
/// The same with what it asks for. @throws likewise
StudyOutline stored_outline(ResultStore& store, const std::string& name);
/// The same with how far it is, which takes a second of a study of 200,000 points. @throws likewise
StudySummary stored_study(ResultStore& store, const std::string& name);

/// Reads a filter as people write it, "load>=20 kN/m": as parse_filter (db/queries/query.hpp), but a value with a unit
/// becomes a number in SI.
/// @throws std::invalid_argument as parse_filter, or naming the value whose unit does not fit the column, or a bare one
/// that looks as if it were in another unit
Filter read_filter(const std::string& text);

/// A program on a machine, and what of a study it computed.
struct ComputedShare {
  Provenance program;
  std::int64_t points = 0;
  double seconds = 0;       ///< of its solutions, together
  std::string first, last;  ///< when it stored its first and its last result, UTC
};

/// In the order in which the database came to know them.
/// @throws std::runtime_error naming the file if the database fails
std::vector<ComputedShare> computed_shares(ResultStore& store, const std::string& study);

struct StudyStatus {
  std::size_t points = 0;
  std::size_t converged = 0;
  std::size_t failed = 0;   ///< answered, but without a solution
  std::size_t missing = 0;  ///< not answered
  /// Of one core, for what is missing: predicted_seconds, scaled by what stored points of the study and of the kind
  /// took (learned_cost.hpp); NaN: not predicted.
  double seconds_left = std::numeric_limits<double>::quiet_NaN();
  std::size_t unlearned = 0;          ///< missing points of whose kind too few are stored to learn from
  double seconds_unlearned = 0;       ///< of these, in seconds_left
  std::vector<int> shards_missing{};  ///< shards with a missing point, from 1
};

/// A point is what the best of the databases says it is.
/// @throws std::runtime_error naming the database that fails
StudyStatus study_status(const Study& study, std::span<const std::filesystem::path> databases, int shards);

}  // namespace rollres
