#include "studies/text/measured_table.hpp"

#include "studies/scene_io/master_curve_file.hpp"
#include "studies/text/strict_json.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

/// The master curve in a file of this text, or why it is refused.
std::string curve_of(const std::string& text) {
  const TemporaryDirectory folder;
  const auto file = folder.write("dma.csv", text);
  std::string lists;
  const std::string refused = message_of([&] { lists = read_master_curve(file).dump(); });
  const std::size_t name = refused.find("dma.csv");
  return refused == "nothing" ? lists : refused.substr(name == std::string::npos ? 0 : name);
}

std::string plain() { return curve_of("frequency [Hz],E' [MPa],E'' [MPa]\n0.1,4.5,0.5\n10,7.25,1.5\n"); }

}  // namespace

TEST_CASE("a table is the same in every manner of spreadsheets and instruments", "[studies][text]") {
  REQUIRE_THAT(plain(), Contains("\"listed_moduli\":\"young\"") && Contains("[4500000.0,7250000.0]"));
  const std::string german = "frequency [Hz];E' [MPa];E'' [MPa]\n0,1;4,5;0,5\n10;7,25;1,5\n";
  CHECK(curve_of(german) == plain());
  CHECK(curve_of("\xEF\xBB\xBF" + german) == plain());
  CHECK(curve_of("sep=;\r\n" + german) == plain());
  CHECK(curve_of("Frequency (Hz),E' (MPa),E'' (MPa)\r\n0.1,4.5,0.5\r\n10,7.25,1.5\r\n") == plain());
  CHECK(curve_of("FREQUENCY [Hz]\tStorage Young Modulus [MPa]\tLoss Young Modulus [MPa]\n0,1\t4,5\t0,5\n"
                 "10\t7,25\t1,5\n") == plain());
  CHECK(curve_of("Frequency / Hz;E' / MPa;E'' / MPa\n0.1;4.5;0.5\n10;7.25;1.5\n") == plain());
  CHECK(curve_of("Frequency,E',E''\nHz,MPa,MPa\n0.1,4.5,0.5\n10,7.25,1.5\n") == plain());
  CHECK(curve_of("Frequency,E',E''\n[Hz],[MPa],[MPa]\n0.1,4.5,0.5\n10,7.25,1.5\n") == plain());
  CHECK(curve_of("frequency [Hz],E' [MPa],E'' [MPa],,\n0.1,4.5,0.5,,\n10,7.25,1.5,,\n") == plain());
  CHECK(curve_of("\"frequency [Hz]\",\"E' [MPa]\",\"E'' [MPa]\"\n\"0,1\",\"4,5\",\"0,5\"\n10,\"7,25\",\"1,5\"\n") ==
        plain());
  CHECK(curve_of("frequency [Hz];E' [MPa];E\" [MPa]\n0.1;4.5;0.5\n10;7.25;1.5\n") == plain());
  CHECK(curve_of("Frequency,E',E\"\nHz,MPa,MPa\n0.1,4.5,0.5\n10,7.25,1.5\n") == plain());
  CHECK(curve_of("Frequency (Hz),E\x92 (MPa),E\x92\x92 (MPa)\n0.1,4.5,0.5\n10,7.25,1.5\n") == plain());
  CHECK(curve_of("frequency [Hz],E' [MPa],E'' [MPa]\r0.1,4.5,0.5\r10,7.25,1.5\r") == plain());
}

TEST_CASE("what a table cannot mean is refused in one message", "[studies][text]") {
  CHECK(curve_of("frequency [Hz];E' [MPa];E'' [MPa]\n0,1;4.5;0,5\n") ==
        "dma.csv, line 2: frequency [Hz] = 0,1: has a decimal comma, and 4.5 a point: write all with points");
  CHECK(curve_of("frequency [Hz];E' [MPa];E'' [MPa]\n1;1.234,5;2\n") ==
        "dma.csv, line 2: E' [MPa] = 1.234,5: must be a finite number");
  CHECK(curve_of("DMA 850\nfrequency [Hz],E' [MPa],E'' [MPa]\n1,2,3\n") ==
        "dma.csv, line 2: 3 cells where the first line names 1 columns; lines above the table begin with #");
  CHECK_THAT(
      curve_of("frequency [Hz],E' [MPa],E'' [MPa],Torque [N],Lossmodulus,Torsion\n1,2,3,4,5,6\n"),
      Contains("dma.csv: Torque: unknown column; Lossmodulus: unknown column; did you mean loss_modulus?; Torsion: "
               "unknown column; known are frequency, "));
  CHECK(curve_of("frequency [Hz],E',E''\n1,2,3\n") ==
        "dma.csv, line 2: E': the first line must name a unit of stress (Pa)");
  CHECK_THAT(curve_of(std::string("\xFF\xFE", 2) + "f"), Contains("UTF-16"));
}

TEST_CASE("blocks under the same names are one table, other names below it are refused", "[studies][text]") {
  const TemporaryDirectory directory;
  const auto rows = [&](const std::string& between) {
    return read_measured_table(directory.write("t.csv", "f [Hz],G' [Pa]\n1,2\n" + between + "\n3,4\n")).rows();
  };
  CHECK(rows("\nf [Hz],G' [Pa]") == 2);
  CHECK(rows("f [Hz],G'' [Pa]") == 3);
  const MeasuredTable table = read_measured_table(directory / "t.csv");
  CHECK_THAT(message_of([&] { measured_number(table, table.columns[0], 1, "Hz"); }),
             Catch::Contains("must be a finite number"));
}
