#pragma once

/// Headings of measured tables as instruments and spreadsheets write them: "Storage Modulus (MPa)", "Frequency [Hz]",
/// "E' / MPa", "tan(delta)", "Speichermodul". Names are taken in any case, with blanks for underscores, in English,
/// German and French.

#include <string>
#include <string_view>

namespace rollres {

struct TableHeading {
  std::string name;     ///< "storage_modulus"
  std::string unit;     ///< empty if none is given, "1" of a number without one
  std::string written;  ///< the name in the file where that is another: "Storage Modulus"
};

/// Whether a name is one that instruments give to their columns: "frequency", "E'".
bool is_measured_name(std::string_view name);

/// @throws std::invalid_argument the rule that is broken
TableHeading table_heading(std::string_view text);

/// Whether a text is a unit, or a mark for none ("-").
bool is_unit(std::string_view text);

}  // namespace rollres
