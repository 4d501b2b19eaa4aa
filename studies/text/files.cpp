#include "studies/text/files.hpp"

#include <fcntl.h>
#include <iconv.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <optional>
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

/// Where links lead to, also if nothing is there.
std::filesystem::path end_of_links(std::filesystem::path file) {
  constexpr int most = 40;  // as the system follows
  std::error_code error;
  for (int link = 0; link < most && std::filesystem::is_symlink(file, error); ++link)
    file = file.parent_path() / std::filesystem::read_symlink(file, error);
  return file;
}

/// UTF-8 of a text in UTF-16 with its byte order mark; nothing where some of it is no letter.
std::optional<std::string> from_utf16(std::string text) {
  const iconv_t converter = ::iconv_open("UTF-8", "UTF-16");
  if (converter == reinterpret_cast<iconv_t>(-1)) return {};
  std::string plain(2 * text.size(), '\0');  // three bytes at most for two
  char *from = text.data(), *to = plain.data();
  std::size_t left = text.size(), room = plain.size();
  const bool all = ::iconv(converter, &from, &left, &to, &room) != static_cast<std::size_t>(-1) && left == 0;
  ::iconv_close(converter);
  plain.resize(plain.size() - room);
  return all ? std::optional(plain) : std::nullopt;
}

/// Opens `file` and writes it whole. @return why that failed; empty if it did not
std::string written(const std::filesystem::path& file, int flags, std::string_view content) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666);
  if (descriptor < 0) return last_error();
  std::string why;
  while (!content.empty() && why.empty()) {
    const ssize_t some = ::write(descriptor, content.data(), content.size());
    if (some >= 0)
      content.remove_prefix(static_cast<std::size_t>(some));
    else if (errno != EINTR)
      why = last_error();
  }
  if (::close(descriptor) != 0 && why.empty()) why = last_error();
  return why;
}

}  // namespace

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream && !stream.eof()) throw std::runtime_error(file.string() + ": cannot be read");
  return text;
}

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
  if (!text.starts_with("\xff\xfe") && !text.starts_with("\xfe\xff")) return text;
  const auto plain = from_utf16(std::move(text));
  if (!plain) fail(file, "cannot be read", "it is UTF-16, but some of it is no letter; save it as UTF-8");
  return *plain;
}

void write_file(const std::filesystem::path& file, std::string_view content) {
  require_name(file);
  std::error_code error;
  const auto kind = std::filesystem::status(file, error).type();  // of what a link leads to
  if (kind != std::filesystem::file_type::regular && kind != std::filesystem::file_type::not_found) {
    if (const std::string why = written(file, 0, content); !why.empty()) fail(file, "cannot be written", why);
    return;
  }
  const std::filesystem::path place = end_of_links(file);
  std::filesystem::path part = place;
  part += "." + std::to_string(::getpid()) + ".part";
  std::filesystem::remove(part, error);  // whatever stands there: it is never written through
  std::string why = written(part, O_CREAT | O_EXCL, content);
  if (why.empty()) {
    std::filesystem::rename(part, place, error);
    if (error) why = error.message();
  }
  if (why.empty()) return;
  std::filesystem::remove(part, error);
  fail(file, "cannot be written", why);
}

void refuse_other_kind(const std::filesystem::path& file, std::initializer_list<std::string_view> possible) {
  constexpr std::array<std::string_view, 20> kinds{".svg",  ".png", ".gif",  ".pdf",  ".ps",   ".eps", ".jpg",
                                                   ".jpeg", ".tif", ".tiff", ".bmp",  ".webp", ".emf", ".wmf",
                                                   ".html", ".htm", ".doc",  ".docx", ".xls",  ".xlsx"};
  std::string ending = file.extension().string();
  for (char& letter : ending) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  if (std::find(kinds.begin(), kinds.end(), ending) == kinds.end()) return;
  std::string list;
  for (const std::string_view one : possible) {
    if (ending == one) return;
    list += (list.empty() ? "" : ", ") + std::string(one);
  }
  throw std::invalid_argument(file.string() + ": " + ending + " cannot be written; possible: " + list);
}

void make_directory(const std::filesystem::path& directory) {
  require_name(directory);
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (!error && !std::filesystem::is_directory(directory)) error = std::make_error_code(std::errc::not_a_directory);
  if (error) fail(directory, "cannot be made a directory", error.message());
}

}  // namespace rollres
