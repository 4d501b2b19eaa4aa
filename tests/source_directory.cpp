#include "tests/source_directory.hpp"

const std::filesystem::path& source_directory() {
  static const std::filesystem::path top = ROLLRES_SOURCE_DIR;
  return top;
}

std::string example(const std::string& name) { return (source_directory() / "studies/examples" / name).string(); }
