#include <SQLiteCpp/SQLiteCpp.h>
#include <zlib.h>

#include <cmath>
#include <cstring>

#include "db/rows/fields_table.hpp"
#include "db/rows/result_store.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers fields_table, too.

using namespace rollres;

namespace {

/// Numbers that a careless format loses, at 3 x 2 nodes.
SurfaceFields odd_fields() {
  SurfaceFields fields;
  fields.grid = {.spacing_x = 0.1,
                 .spacing_y = 1.0 / 3,
                 .origin_x = -0.0,
                 .origin_y = 5e-324,
                 .first_column = -7,
                 .first_row = 2,
                 .columns = 3,
                 .rows = 2};
  double next = 0.1;
  for (auto* values : {&fields.u, &fields.w, &fields.pressure, &fields.shear_x, &fields.slip_x})
    for (int i = 0; i < 6; ++i) values->push_back(next *= -1.7);
  fields.u[2] = std::nan("");
  fields.w[0] = std::numeric_limits<double>::infinity();
  fields.zone = {Zone::free, Zone::stick, Zone::slip, Zone::slip, Zone::free, Zone::stick};
  return fields;
}

bool same_bits(const std::vector<double>& one, const std::vector<double>& other) {
  return one.size() == other.size() && (one.empty() || std::memcmp(one.data(), other.data(), 8 * one.size()) == 0);
}

bool same(const SurfaceGrid& a, const SurfaceGrid& b) {
  const auto lengths = [](const SurfaceGrid& grid) {
    return std::vector<double>{grid.spacing_x, grid.spacing_y, grid.origin_x, grid.origin_y};
  };
  return same_bits(lengths(a), lengths(b)) && a.first_column == b.first_column && a.first_row == b.first_row &&
         a.columns == b.columns && a.rows == b.rows && a.folded == b.folded;
}

bool same(const SurfaceFields& a, const SurfaceFields& b) {
  return same(a.grid, b.grid) && same_bits(a.u, b.u) && same_bits(a.v, b.v) && same_bits(a.w, b.w) &&
         same_bits(a.pressure, b.pressure) && same_bits(a.shear_x, b.shear_x) && same_bits(a.shear_y, b.shear_y) &&
         same_bits(a.slip_x, b.slip_x) && same_bits(a.slip_y, b.slip_y) && a.zone == b.zone;
}

Evaluation evaluation(double speed, bool with_fields, Status status = Status::converged) {
  const RollingScene scene = plain_scene(speed);
  Evaluation one{evaluation_key(scene), scene, closed_form(scene)};
  one.solution.status = status;
  if (with_fields) one.solution.fields = odd_fields();
  return one;
}

}  // namespace

TEST_CASE("every bit of the fields returns from the store", "[db][fields]") {
  const TemporaryDirectory folder;
  const std::vector<Evaluation> both{evaluation(1, true), evaluation(2, false)};
  REQUIRE(ResultStore(folder / "a.db").save(both) == 2);
  ResultStore reader(folder / "a.db", Access::read);
  const auto found = reader.find_fields(both[0].key);
  REQUIRE(found);
  CHECK(same(*found, both[0].solution.fields));
  CHECK(reader.find_answer(both[0].key)->has_fields);
  CHECK_FALSE(reader.find_fields(both[1].key));
  CHECK_FALSE(reader.find_answer(both[1].key)->has_fields);
  CHECK_FALSE(reader.find_fields("unknown"));
}

TEST_CASE("the bytes of stored fields are as documented, for programs that read them without this one",
          "[db][fields]") {
  const SurfaceFields fields = odd_fields();
  const std::string bytes = packed(fields);
  std::string content(1000, '\0');
  uLongf length = content.size();
  REQUIRE(uncompress(reinterpret_cast<Bytef*>(content.data()), &length, reinterpret_cast<const Bytef*>(bytes.data()),
                     bytes.size()) == Z_OK);
  CHECK(length == 4 * 8 + 5 * 4 + 5 * 6 * 8 + 6);
  auto number = [&](std::size_t offset) {
    double value = 0;
    std::memcpy(&value, content.data() + offset, sizeof value);
    return value;
  };
  CHECK(number(8) == fields.grid.spacing_y);
  const std::string integers("\xf9\xff\xff\xff\2\0\0\0\3\0\0\0\2\0\0\0\x5d\0\0\0",
                             20);  // u, w, pressure, shear_x, slip_x
  CHECK(content.substr(32, 20) == integers);
  CHECK(number(52 + 8 * (6 + 1)) == fields.w[1]);
  CHECK(content[length - 4] == 2);
}

TEST_CASE("damaged or unknown fields are refused, naming file and evaluation", "[db][fields]") {
  const std::string bytes = packed(odd_fields());
  for (std::size_t kept = 0; kept < bytes.size(); ++kept)
    CHECK(message_of([&] { unpacked_fields(fields_format, std::string_view(bytes).substr(0, kept)); }) ==
          "the stored fields are damaged");
  for (std::size_t place = 0; place < bytes.size(); ++place) {
    std::string wrong = bytes;
    wrong[place] = static_cast<char>(wrong[place] ^ 0x55);
    CHECK(message_of([&] { unpacked_fields(fields_format, wrong); }) == "the stored fields are damaged");
  }
  const TemporaryDirectory folder;
  const Evaluation one = evaluation(1, true);
  ResultStore store(folder / "a.db");
  store.save({&one, 1});
  store.database().connection().exec("UPDATE fields SET format = 99");
  CHECK(message_of([&] { store.find_fields(one.key); }) ==
        (folder / "a.db").string() + ": " + one.key + ": fields of format 99: not known to this version of rollres");
}

TEST_CASE("fields go with their answer: kept with it, added where they are missing, replaced with it", "[db][fields]") {
  const TemporaryDirectory folder;
  ResultStore store(folder / "a.db");
  auto save = [&](const Evaluation& one, Existing existing = Existing::kept) {
    return store.save({&one, 1}, existing);
  };
  const Evaluation plain = evaluation(1, false), full = evaluation(1, true);
  const Evaluation failed = evaluation(1, true, Status::not_converged);
  const std::string& key = plain.key;
  CHECK(save(plain) == 1);
  CHECK(save(failed) == 0);  // fields of another outcome
  CHECK_FALSE(store.find_fields(key));
  CHECK(save(full) == 1);
  CHECK(store.find_fields(key));
  CHECK(save(full) == 0);
  CHECK(save(failed, Existing::replaced) == 0);
  CHECK(store.find_fields(key));
  CHECK(save(plain, Existing::replaced) == 1);
  CHECK_FALSE(store.find_fields(key));
  CHECK(save(full) == 1);
  store.database().connection().exec("DELETE FROM evaluation");
  CHECK_FALSE(store.find_fields(key));
}

TEST_CASE("a failed answer gives way to any, a converged one only to a converged one, under the same number and key",
          "[db][result_store]") {
  const TemporaryDirectory folder;
  ResultStore store(folder / "a.db");
  auto stored = [&](Status status, double resistance, Existing existing) {
    Evaluation one = evaluation(1, false, status);
    one.solution.rolling_resistance = resistance;
    store.save({&one, 1}, existing);
    const auto found = store.find(one.key);
    REQUIRE(found);
    CHECK(found->id == 1);
    return found->solution.rolling_resistance;
  };
  CHECK(stored(Status::not_converged, 1, Existing::kept) == 1);
  CHECK(stored(Status::converged, 2, Existing::kept) == 1);
  CHECK(stored(Status::no_steady_state, 3, Existing::replaced) == 3);
  CHECK(stored(Status::converged, 4, Existing::replaced) == 4);
  CHECK(stored(Status::not_converged, 5, Existing::replaced) == 4);
  CHECK(stored(Status::converged, 6, Existing::replaced) == 6);
}

TEST_CASE("bytes that would grow beyond what fields are made of are refused before they do", "[db][fields]") {
  // A stream that holds the beginning of fields and then zeros, a thousand of them in a byte.
  std::string bytes;
  z_stream stream{};
  REQUIRE(deflateInit(&stream, 1) == Z_OK);
  std::string zeros(1 << 20, '\0'), part(1 << 20, '\0');
  constexpr int megabytes = 32;
  for (int i = 0; i <= megabytes; ++i) {
    stream.next_in = reinterpret_cast<Bytef*>(zeros.data());
    stream.avail_in = static_cast<uInt>(i < megabytes ? zeros.size() : 0);
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    deflate(&stream, i < megabytes ? Z_NO_FLUSH : Z_FINISH);
    bytes.append(part.data(), part.size() - stream.avail_out);
  }
  deflateEnd(&stream);
  CHECK(bytes.size() < 200'000);
  CHECK_THROWS_WITH(unpacked_fields(fields_format, bytes), "the stored fields are damaged");

  // Fields as regular as that are stored as they are, and return.
  SurfaceFields still;
  still.grid = {.spacing_x = 1, .spacing_y = 1, .columns = 1500, .rows = 1500};
  still.w.assign(1500 * 1500, 0.0);
  still.zone.assign(1500 * 1500, Zone::free);
  const std::string stored = packed(still);
  CHECK(same(unpacked_fields(fields_format, stored), still));
}
