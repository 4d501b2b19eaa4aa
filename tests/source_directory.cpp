#include "tests/source_directory.hpp"

const std::filesystem::path& source_directory() {
  static const std::filesystem::path top = ROLLRES_SOURCE_DIR;
  return top;
}
