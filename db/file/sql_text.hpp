#pragma once

/// Names and texts as they stand in SQL. Whatever a file or a user named is written through these.

#include <string>
#include <string_view>

namespace rollres {

/// The name of a table or a column: in double quotes, its own ones doubled. "speed" -> "\"speed\""
std::string quoted_name(std::string_view name);

/// A text: in single quotes, its own ones doubled.
std::string quoted_text(std::string_view text);

}  // namespace rollres
