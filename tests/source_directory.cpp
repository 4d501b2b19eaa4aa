#include "tests/source_directory.hpp"

#include <algorithm>
#include <cstdlib>

const std::filesystem::path& source_directory() {
  static const std::filesystem::path top = ROLLRES_SOURCE_DIR;
  return top;
}

const std::string& rollres_program() {
  static const std::string program =
      (std::filesystem::canonical("/proc/self/exe").parent_path().parent_path() / "rollres").string();
  return program;
}

bool address_sanitizer() {
#ifdef __SANITIZE_ADDRESS__
  return true;
#else
  return false;
#endif
}

int thinned(int amount) { return std::getenv("ROLLRES_THIN") ? std::max(1, amount / 10) : amount; }

double patience(double seconds) { return std::getenv("ROLLRES_THIN") ? 20 * seconds : seconds; }

std::string example(const std::string& name) { return (source_directory() / "studies/examples" / name).string(); }
