#pragma once

/// The keys of all kinds of files but scenes, as tables for people: from the lists from which the readers know them and
/// of which the JSON schemas are made.

#include <string>
#include <vector>

#include "db/queries/table.hpp"

namespace rollres {

/// The keys of one object.
struct KeySection {
  std::string title;  ///< "Study", "Study: an interval under axes"
  Table keys;         ///< key, values, default, meaning
};

std::vector<KeySection> key_sections();

}  // namespace rollres
