#pragma once

/// Questions to stored fits as people ask them, and their answers as people read them.

#include "db/queries/fit_query.hpp"
#include "studies/stored/shown_table.hpp"

namespace rollres {

/// Reads "status=MISFIT", "creep_time<2 ms", "static_shear_modulus_error=none" for run_fit_query: numbers become SI.
/// @throws std::invalid_argument naming the value whose unit does not fit, or the word that is no status
Filter read_fit_filter(const Database& database, const std::string& text);

/// The answer for people, each column in one unit with a prefix. Without columns in the question: name, status,
/// measured values, reduced chi squared, what the question names, and the parameters that the fits have, with their
/// errors.
/// @param droppable  gets the columns that may be left out for want of room, the least needed last; empty where the
///        question chose
struct ShownFits {
  Table table;
  std::vector<std::string> droppable;
};
ShownFits shown_fits(const Database& database, Query query, ShownUnits units);

}  // namespace rollres
