#pragma once

/// Databases of older schemas, read as if they were of this one.

#include <filesystem>
#include <optional>

#include "db/file/database.hpp"
#include "db/file/temporary_folder.hpp"

namespace rollres {

/// A database of this version's schema that holds what `file` does, which is not written to: the file itself, or if it
/// is of an older schema a temporary copy.
class ReadableSource {
 public:
  /// @throws std::runtime_error as Database
  explicit ReadableSource(const std::filesystem::path& file);

  const Database& database() const { return *database_; }

 private:
  std::optional<TemporaryFolder> folder_;  ///< of the copy
  std::optional<Database> database_;
};

}  // namespace rollres
