#pragma once

#include <filesystem>

namespace rollres {

/// A folder of its own among the temporary files, removed with all that is in it.
class ScratchFolder {
 public:
  /// @throws std::runtime_error naming the path if it cannot be made
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace rollres
