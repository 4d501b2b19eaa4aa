#pragma once

/// Names, notes and the end of stored studies. What a study asked for stays stored until `delete_rows_of_no_study`.
/// Every function throws std::runtime_error naming the file if the database fails.

#include <cstdint>
#include <string>

#include "db/file/database.hpp"

namespace rollres {

/// @throws std::invalid_argument if there is no such study, or one of the new name
void rename_study(const Database& database, const std::string& study, const std::string& name);

/// Forgets a study and its points, not their rows. @throws std::invalid_argument if there is no such study
void delete_study(const Database& database, const std::string& study);

/// Sets the text that `list` and `show` print with a study. @throws std::invalid_argument if there is no such study
void set_note(const Database& database, const std::string& study, const std::string& note);

/// Rows that are no point of any study: of single solutions, fits, and studies that were deleted or defined anew.
std::int64_t rows_of_no_study(const Database& database);

/// Deletes them, with their fields, and gives their room back to the disk.
void delete_rows_of_no_study(const Database& database);

}  // namespace rollres
