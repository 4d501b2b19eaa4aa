#pragma once

/// Folders for temporary files.

#include <filesystem>

namespace rollres {

/// A folder of its own among the temporary files (TMPDIR, /tmp where that is absent or empty), removed with all that is
/// in it.
class TemporaryFolder {
 public:
  /// @throws std::runtime_error naming the path if it cannot be made
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Removes the folders that there are, of a program that a signal ends: it may be called in a signal handler.
void remove_temporary_folders() noexcept;

}  // namespace rollres
