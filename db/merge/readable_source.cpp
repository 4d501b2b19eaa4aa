#include "db/merge/readable_source.hpp"

#include <array>
#include <fstream>

#include "db/file/sqlite.hpp"
#include "db/rows/schema.hpp"

namespace rollres {

namespace {

/// Whether the file's header names rollres and an older schema: user_version stands at byte 60, application_id at 68
/// (sqlite.org, "Database File Format", section 1.3).
bool of_older_schema(const std::filesystem::path& file) {
  std::array<unsigned char, 72> header{};
  std::ifstream in(file, std::ios::binary);
  if (!in.read(reinterpret_cast<char*>(header.data()), header.size())) return false;
  const auto number = [&](std::size_t at) {
    return header[at] << 24 | header[at + 1] << 16 | header[at + 2] << 8 | header[at + 3];
  };
  return number(68) == Database::application_id && number(60) < static_cast<int>(schema_migrations().size());
}

}  // namespace

ReadableSource::ReadableSource(const std::filesystem::path& file) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none) || !of_older_schema(file)) {  // a pipe is refused when it is opened
    database_.emplace(open_database(file, Access::read));
    return;
  }
  const std::filesystem::path copy = folder_.emplace() / "copy.db";
  naming(file.string(), [&] {
    SQLite::Database old(file.string(), SQLite::OPEN_READONLY,
                         static_cast<int>(std::chrono::milliseconds(Database::patience).count()));
    distrust(old);
    vacuum(old, copy);
  });
  database_.emplace(open_database(copy, Access::read));
}

}  // namespace rollres
