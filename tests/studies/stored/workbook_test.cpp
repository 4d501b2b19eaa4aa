#include "studies/stored/workbook.hpp"

#include <zlib.h>

#include <cstring>
#include <limits>

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

/// A file in a zip archive, by its central directory (PKWARE's APPNOTE, 4.3.12); empty if it is not there.
std::string unpacked(const std::string& archive, const std::string& name) {
  const auto number = [&](std::size_t place, std::size_t bytes) {
    std::size_t value = 0;
    for (std::size_t i = bytes; i-- > 0;) value = value << 8 | static_cast<unsigned char>(archive.at(place + i));
    return value;
  };
  for (std::size_t at = archive.find("PK\1\2"); at != std::string::npos; at = archive.find("PK\1\2", at + 4)) {
    if (archive.substr(at + 46, number(at + 28, 2)) != name) continue;
    const std::size_t local = number(at + 42, 4);
    const std::size_t begin = local + 30 + number(local + 26, 2) + number(local + 28, 2);
    std::string packed = archive.substr(begin, number(at + 20, 4)), text(number(at + 24, 4), '\0');
    z_stream stream{};
    inflateInit2(&stream, -MAX_WBITS);
    stream.next_in = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(text.data());
    stream.avail_out = static_cast<uInt>(text.size());
    CHECK(inflate(&stream, Z_FINISH) == Z_STREAM_END);
    inflateEnd(&stream);
    return text;
  }
  return {};
}

constexpr const char* sheet_name = "xl/worksheets/sheet1.xml";

}  // namespace

TEST_CASE("a workbook has numbers as numbers with all digits, and no text is a formula", "[studies][workbook]") {
  const TemporaryDirectory folder;
  const double infinite = std::numeric_limits<double>::infinity();
  write_workbook(folder / "a.xlsx", {{"one", "two [mm]"},
                                     {{Cell("=1+1"), Cell(0.1234567890123456)},
                                      {Cell(std::int64_t{7}), Cell(infinite)},
                                      {Cell(), Cell(std::nan(""))},
                                      {Cell("a < b & \"c\""), Cell(-2.5)}}});
  const std::string archive = file_text(folder / "a.xlsx");
  const std::string sheet = unpacked(archive, sheet_name), texts = unpacked(archive, "xl/sharedStrings.xml");
  CHECK_THAT(sheet, Contains(R"(<c r="B2"><v>0.1234567890123456</v>)") && Contains(R"(<c r="A3"><v>7</v>)") &&
                        Contains(R"(<c r="B5"><v>-2.5</v>)"));
  CHECK_THAT(sheet, !Contains("<f>") && !Contains("r=\"A4\"") && !Contains("r=\"B4\""));
  CHECK_THAT(sheet, Contains("state=\"frozen\"") && Contains("<autoFilter ref=\"A1:B5\""));
  CHECK_THAT(texts, Contains("<t>=1+1</t>") && Contains("<t>infinite</t>") && Contains("a &lt; b &amp;"));

  CHECK_THAT(message_of([&] {
               write_workbook(folder / "b.xlsx", {{"long"}, {{Cell(std::string(40000, 'x'))}}});
             }),
             Contains("40000 bytes"));
  CHECK_FALSE(std::filesystem::exists(folder / "b.xlsx"));
}

TEST_CASE("a query is written as a workbook, with the study's columns, units and degrees Celsius",
          "[studies][workbook]") {
  const TemporaryDirectory folder;
  const std::string db = folder / "a.db", out = folder / "rows.xlsx";
  const auto run = [](const std::vector<std::string>& words) { return run_rollres(words, closed_form); };
  const auto study = folder.write("s.json", R"({"study": "s", "scene": {"radius": 0.02, "layer_thickness": 0.005,
    "static_shear_modulus": 1e6, "stiffening": 1, "creep_time": 0.5, "load": 2e4, "wlf_c1": 9, "wlf_c2": 50,
    "reference_temperature": 293.15}, "axes": {"speed": [0.002, 0.003], "temperature": [283.15, 303.15]},
    "compute": ["rolling_resistance", {"power": "rolling_resistance * speed"}]})");
  REQUIRE(run({"sweep", study.string(), "--db", db}).status == 0);
  const ProgramRun told = run({"query", "--db", db, "study=s", "--format", "xlsx", "--out", out});
  CHECK(told.status == 0);
  CHECK_THAT(told.out, Contains("rows.xlsx: 4 rows"));
  const std::string archive = file_text(out), texts = unpacked(archive, "xl/sharedStrings.xml");
  CHECK_THAT(texts, Contains("speed [mm/s]") && Contains("temperature [°C]") && Contains("power ["));
  CHECK_THAT(unpacked(archive, sheet_name), Contains("<v>10</v>") && Contains("<v>30</v>"));

  const ProgramRun printed = run({"query", "--db", db, "study=s", "--format", "xlsx"});
  CHECK(printed.status == 2);
  CHECK_THAT(printed.err, Contains("--format = xlsx: needs --out FILE"));
  CHECK(run({"query", "--db", db, "study=s", "--format", "csv", "--out", folder / "rows.csv"}).out.empty());
  CHECK_THAT(file_text(folder / "rows.csv"), Contains("speed") && Contains("0.002"));
}
