#pragma once

/// Databases of older schemas, read as if they were of this one.

#include <filesystem>
#include <optional>

#include "db/file/database.hpp"

namespace rollres {

/// Makes a folder for temporary files. @throws std::runtime_error if that fails
std::filesystem::path temporary_folder();

/// A database of this version's schema that holds what `file` does, which is not written to: the file itself, or if it
/// is of an older schema a temporary copy.
class ReadableSource {
 public:
  /// @throws std::runtime_error as Database
  explicit ReadableSource(const std::filesystem::path& file);
  ~ReadableSource();

  const Database& database() const { return *database_; }

 private:
  std::filesystem::path copy_;  ///< folder; empty if there is none
  std::optional<Database> database_;
};

}  // namespace rollres
