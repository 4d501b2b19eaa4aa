#include "studies/text/scratch_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>

namespace rollres {

ScratchFolder::ScratchFolder() {
  std::error_code error;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  if (error) {
    const char* const given = std::getenv("TMPDIR");
    throw std::runtime_error("TMPDIR = " + std::string(given ? given : "") + ": " + error.message());
  }
  std::string name = (parent / "rollres_XXXXXX").string();
  if (!::mkdtemp(name.data()))
    throw std::runtime_error(name + ": cannot be made a directory: " + std::generic_category().message(errno));
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace rollres
