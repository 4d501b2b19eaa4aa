#include "studies/text/files.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace rollres {

namespace {

/// What the system would take for another name, up to the NUL.
void require_name(const std::filesystem::path& path) {
  if (path.empty()) throw std::invalid_argument("the file name is empty");
  const std::string& name = path.native();
  if (const std::size_t nul = name.find('\0'); nul != std::string::npos)
    throw std::invalid_argument(name.substr(0, nul) + "...: the file name has a NUL character");
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what, const std::string& why) {
  throw std::runtime_error(path.string() + ": " + what + ": " + why);
}

std::string last_error() { return std::generic_category().message(errno != 0 ? errno : EIO); }

}  // namespace

std::string whole_file(const std::filesystem::path& file, std::size_t largest) {
  require_name(file);
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  constexpr std::size_t part = 1 << 16;
  std::string text;
  while (stream && text.size() <= largest) {
    const std::size_t before = text.size();
    text.resize(before + part);
    stream.read(text.data() + before, static_cast<std::streamsize>(part));
    text.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  if (!stream.eof() && !stream.good()) fail(file, "cannot be read", last_error());
  if (text.size() > largest)
    fail(file, "cannot be read", "it is larger than " + std::to_string(largest / 1'000'000) + " MB");
  return text;
}

void write_file(const std::filesystem::path& file, std::string_view content) {
  require_name(file);
  std::filesystem::path part = file;
  part += "." + std::to_string(::getpid()) + ".part";
  errno = 0;
  std::ofstream stream(part, std::ios::binary | std::ios::trunc);
  if (!stream) fail(file, "cannot be written", last_error());
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  stream.close();
  std::error_code error;
  if (!stream) {
    const std::string why = last_error();
    std::filesystem::remove(part, error);
    fail(file, "cannot be written", why);
  }
  std::filesystem::rename(part, file, error);
  if (error) {
    const std::string why = error.message();
    std::filesystem::remove(part, error);
    fail(file, "cannot be written", why);
  }
}

void make_directory(const std::filesystem::path& directory) {
  require_name(directory);
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (!error && !std::filesystem::is_directory(directory)) error = std::make_error_code(std::errc::not_a_directory);
  if (error) fail(directory, "cannot be made a directory", error.message());
}

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
