#pragma once

/// The numbers that a study derives from others by formulas ("compute" of its file), as columns. They are computed when
/// they are read, from what is stored, so that there is one truth, and a formula may be changed at no cost.

#include <span>
#include <string>
#include <vector>

#include "db/queries/query.hpp"
#include "db/rows/schema.hpp"
#include "studies/scene_io/formula.hpp"

namespace rollres {

/// What questions compute.
std::vector<ComputedColumn> computed_columns(const FormulaDefinitions& formulas);

/// How a derived number is shown: its name, its unit, its formula as the meaning. It lives as long as the program.
/// @param formula  one that was understood
const QuantityColumn& derived_column(const std::string& name, const std::string& formula);

/// A value with a unit in a filter becomes a number in SI; whether it is per metre is kept beside it.
/// @throws std::invalid_argument naming the value whose unit does not fit
void convert_to_si(Filter& filter, const Quantity& quantity);
/// The same of what somebody wrote: a bare number that looks as if it were in another unit is refused.
void convert_written(Filter& filter, const Quantity& quantity);
/// convert_to_si for filters of derived numbers.
void convert_to_si(std::vector<Filter>& filters, const FormulaDefinitions& formulas);

/// Adds the derived numbers that a question names to it, from the studies that its filters choose. Returns their
/// formulas, and those of the goals that it names.
/// @throws std::invalid_argument if two of the studies compute one differently
/// @throws std::runtime_error naming the file if the database fails
FormulaDefinitions add_derived(const Database& database, Query& query);
FormulaDefinitions add_derived(const Database& database, GroupQuery& query);

}  // namespace rollres
