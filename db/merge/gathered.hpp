#pragma once

/// Several databases read as one.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "db/file/temporary_folder.hpp"

namespace rollres {

/// One database, or several brought together in a temporary copy as `merge` does, which lives as long as this.
class GatheredDatabases {
 public:
  /// @param files  at least one
  /// @throws as merge
  explicit GatheredDatabases(std::span<const std::string> files);

  const std::filesystem::path& file() const { return file_; }
  /// Studies of one name that are defined otherwise: the file, the name there, and the name here.
  struct Renamed {
    std::string file, name, here;
  };
  const std::vector<Renamed>& renamed() const { return renamed_; }
  /// Likewise, a line of each.
  std::string renamed_in_words() const;

 private:
  std::optional<TemporaryFolder> folder_;
  std::filesystem::path file_;
  std::vector<Renamed> renamed_;
};

}  // namespace rollres
