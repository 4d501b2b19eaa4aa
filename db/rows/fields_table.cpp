#include "db/rows/fields_table.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace rollres {

namespace {

bool exec(SQLite::Statement& statement, const std::string& key) {
  statement.bind(1, key);
  return statement.exec() > 0;
}

void bind_fields(SQLite::Statement& statement, int first, const SurfaceFields& fields) {
  const std::string bytes = packed(fields);
  statement.bind(first, fields_format);
  statement.bind(first + 1, bytes.data(), static_cast<int>(bytes.size()));
}

static_assert(std::endian::native == std::endian::little, "the format is that of the memory");
static_assert(sizeof(double) == 8 && sizeof(Zone) == 1);

struct Header {
  double spacing_x, spacing_y, origin_x, origin_y;
  std::int32_t first_column, first_row, columns, rows, present;
};
constexpr std::size_t header_size = 4 * sizeof(double) + 5 * sizeof(std::int32_t);
static_assert(offsetof(Header, present) + sizeof(std::int32_t) == header_size);

/// The numbers grow little when squeezed harder, but the time does: level 1.
constexpr int compression_level = 1;

template <class Fields>
auto arrays_of(Fields& fields) {
  return std::array{&fields.u,       &fields.v,       &fields.w,      &fields.pressure,
                    &fields.shear_x, &fields.shear_y, &fields.slip_x, &fields.slip_y};
}

[[noreturn]] void refuse() { throw std::runtime_error("the stored fields are damaged"); }

/// What so many bytes may hold at most: displacements are never as regular as what zlib makes a thousandth of.
std::size_t most_inflated(std::size_t bytes) {
  constexpr std::size_t always = 16'000'000, times = 64;
  return std::max(always, times * bytes);
}

/// Inflates step by step, so that no number in damaged bytes decides how much memory is taken.
std::string inflated(std::string_view bytes) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  std::string content;
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  int state = Z_OK;
  std::array<char, 65536> part;
  while (state == Z_OK && content.size() <= most_inflated(bytes.size())) {
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    state = inflate(&stream, Z_NO_FLUSH);
    content.append(part.data(), part.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (state != Z_STREAM_END) refuse();
  return content;
}

std::string deflated(const std::string& content, int level) {
  uLongf length = compressBound(content.size());
  std::string bytes(length, '\0');
  if (compress2(reinterpret_cast<Bytef*>(bytes.data()), &length, reinterpret_cast<const Bytef*>(content.data()),
                content.size(), level) != Z_OK)
    throw std::bad_alloc();
  bytes.resize(length);
  return bytes;
}

}  // namespace

bool has_fields_table(SQLite::Database& connection) { return connection.tableExists("fields"); }

void put_fields(SQLite::Database& connection, const std::string& key, const SurfaceFields& fields) {
  SQLite::Statement put(connection, "INSERT OR REPLACE INTO fields(key, format, bytes) VALUES (?, ?, ?)");
  bind_fields(put, 2, fields);
  exec(put, key);
}

bool add_fields(SQLite::Database& connection, const Evaluation& answer) {
  SQLite::Statement add(connection,
                        "INSERT INTO fields(key, format, bytes) SELECT key, ?3, ?4 FROM evaluation "
                        "WHERE key = ?1 AND status = ?2 ON CONFLICT(key) DO NOTHING");
  add.bind(2, std::string(name_of(answer.solution.status)));
  bind_fields(add, 3, answer.solution.fields);
  return exec(add, answer.key);
}

void remove_fields(SQLite::Database& connection, const std::string& key) {
  SQLite::Statement remove(connection, "DELETE FROM fields WHERE key = ?");
  exec(remove, key);
}

std::optional<PackedFields> find_packed_fields(SQLite::Database& connection, const std::string& key) {
  if (!has_fields_table(connection)) return std::nullopt;
  SQLite::Statement row = bound(connection, "SELECT format, bytes FROM fields WHERE key = ?", key);
  if (!row.executeStep()) return std::nullopt;
  const SQLite::Column bytes = row.getColumn(1);
  return PackedFields{row.getColumn(0).getInt(),
                      {static_cast<const char*>(bytes.getBlob()), static_cast<std::size_t>(bytes.getBytes())}};
}

std::string packed(const SurfaceFields& fields) {
  const SurfaceGrid& grid = fields.grid;
  const auto nodes = static_cast<std::size_t>(grid.size());
  Header header{grid.spacing_x, grid.spacing_y,    grid.origin_x,
                grid.origin_y,  grid.first_column, grid.first_row,
                grid.columns,   grid.rows,         0};
  std::string arrays;
  int bit = 0;
  for (const std::vector<double>* const values : arrays_of(fields)) {
    if (!values->empty()) {
      assert(values->size() == nodes);
      header.present |= 1 << bit;
      arrays.append(reinterpret_cast<const char*>(values->data()), nodes * sizeof(double));
    }
    ++bit;
  }
  assert(fields.zone.size() == nodes);
  arrays.append(reinterpret_cast<const char*>(fields.zone.data()), nodes);
  const std::string content = std::string(reinterpret_cast<const char*>(&header), header_size) + arrays;
  const std::string bytes = deflated(content, compression_level);
  return content.size() <= most_inflated(bytes.size()) ? bytes : deflated(content, Z_NO_COMPRESSION);
}

SurfaceFields unpacked_fields(int format, std::string_view bytes) {
  if (format != fields_format)
    throw std::runtime_error("fields of format " + std::to_string(format) + ": not known to this version of rollres");
  const std::string content = inflated(bytes);
  Header header{};
  if (content.size() < header_size) refuse();
  std::memcpy(&header, content.data(), header_size);
  SurfaceFields fields;
  fields.grid = {header.spacing_x,    header.spacing_y, header.origin_x, header.origin_y,
                 header.first_column, header.first_row, header.columns,  header.rows};
  if (header.columns < 0 || header.rows < 0 || header.present >> arrays_of(fields).size() != 0) refuse();
  const std::size_t nodes = static_cast<std::size_t>(header.columns) * static_cast<std::size_t>(header.rows);
  const auto count = static_cast<std::size_t>(std::popcount(static_cast<unsigned>(header.present)));
  if (nodes > content.size() || content.size() != header_size + nodes * (count * sizeof(double) + 1)) refuse();
  const char* next = content.data() + header_size;
  int bit = 0;
  for (std::vector<double>* const values : arrays_of(fields))
    if (header.present >> bit++ & 1) {
      values->resize(nodes);
      std::memcpy(values->data(), next, nodes * sizeof(double));
      next += nodes * sizeof(double);
    }
  fields.zone.resize(nodes);
  for (Zone& zone : fields.zone) {
    if (*next < 0 || *next >= static_cast<int>(ChoiceNames<Zone>::names.size())) refuse();
    zone = static_cast<Zone>(*next++);
  }
  return fields;
}

}  // namespace rollres
