// Covers table_lines, too.

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
  std::string little("\xFF\xFE", 2), big("\xFE\xFF", 2);  // of Windows' programs
  for (const char letter : german) {
    little += {letter, '\0'};
    big += {'\0', letter};
  }
  CHECK(curve_of(little) == plain());
  CHECK(curve_of(big) == plain());
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
  CHECK(curve_of("DMA 850\nfreq in Hz,storage,loss\n1,2,3\n") ==
        "dma.csv, line 2: 3 cells where the first line names 1 columns; no line has two names that are known, as "
        "\"frequency [Hz];E' [MPa];E'' [MPa]\", apart by tabs, semicolons or commas");
  CHECK_THAT(
      curve_of("frequency [Hz],E' [MPa],E'' [MPa],Torque [N],Lossmodulus,Torsion\n1,2,3,4,5,6\n"),
      Contains("dma.csv: Torque: unknown column; Lossmodulus: unknown column; did you mean loss_modulus?; Torsion: "
               "unknown column; known are frequency, "));
  CHECK(curve_of("") == "dma.csv: is empty");
  CHECK(curve_of("frequency [Hz],E',E''\n1,2,3\n") ==
        "dma.csv, line 2: E': the first line must name a unit of stress (Pa)");
  CHECK_THAT(curve_of(std::string("\xFF\xFE", 2) + "f"), Contains("UTF-16"));  // half a letter
  CHECK_THAT(curve_of(std::string("\xFF\xFE\x00\xDC"
                                  "f\x00",
                                  6)),
             Contains("is no letter"));  // half a pair
}

TEST_CASE("ten manners of instruments give the same rows", "[studies][text]") {
  const Json truth = Json::parse(plain());
  for (const std::string& text : std::initializer_list<std::string>{
           // What stands above the table is no comment.
           "Instrument name\tDMA 850\nOperator\tA. B.\nSample\tS1, cut 3\nStart\t25 °C\n\n[step]\nFrequency sweep - 1\n"
           "Frequency\tE'\tE''\tTan(delta)\nHz\tMPa\tMPa\t\n0.1\t4.5\t0.5\t0.111\n10\t7.25\t1.5\t0.207\n",
           "#INSTRUMENT: DMA 242\n#SAMPLE: S1\n\nf/Hz;E'/MPa;E''/MPa\n0,1;4,5;0,5\n10;7,25;1,5\n",
           "Gerät;Eplexor 500\nBediener;M.\nDatum;3.11.2026\n\nFrequenz [Hz];Temperatur [°C];E' [MPa];E'' [MPa];"
           "Bemerkung\n0,1;23,1;4,5;0,5;ok\n10;23,0;7,25;1,5;\n",
           "Fr\xE9quence (Hz);E' (MPa);Facteur de perte\n0,1;4,5;0,1111111111111111\n10;7,25;0,2068965517241379\n",
           "Fréquence (Hz);E' (MPa);E'' (MPa)\n0,1;4,5;0,5\n10;7,25;1,5\n",
           // A modulus and its angle, a modulus and the tangent of its angle.
           "Frequency (Hz),|E*| (MPa),Phase angle (°)\n0.1,4.527692569068709,6.34019174590991\n"
           "10,7.403546447480424,11.689369175439193\n",
           "Frequenz;|E*|;Verlustfaktor\nHz;MPa;-\n0,1;4,527692569068709;0,1111111111111111\n"
           "10;7,403546447480424;0,2068965517241379\n",
           "Freq. [Hz],E* [Pa],delta [rad]\n0.1,4.527692569068709e6,0.11065722117389565\n"
           "10,7.403546447480424e6,0.20401797959254858\n",
           // Blocks with a title each.
           "[step]\nSweep 1\nFrequency,E',E\"\nHz,MPa,MPa\n0.1,4.5,0.5\n[step]\nSweep 2\nFrequency,E',E\"\nHz,MPa,MPa\n"
           "10,7.25,1.5\n",
           "\xEF\xBB\xBF\"Test\",\"S1\"\r\n\"Angular Frequency (rad/s)\",\"E' (MPa)\",\"tan_delta\"\r\n"
           "0.628318530717959,4.5,0.1111111111111111\r\n62.8318530717959,7.25,0.2068965517241379\r\n"}) {
    CAPTURE(text);
    const Json read = Json::parse(curve_of(text), nullptr, false);
    REQUIRE_FALSE(read.is_discarded());
    CHECK(read["listed_moduli"] == "young");
    for (const char* const key : {"frequencies", "storage_moduli", "loss_moduli"})
      for (std::size_t row = 0; row < 2; ++row)
        CHECK(read[key][row].get<double>() == Approx(truth[key][row].get<double>()).epsilon(1e-12));
  }
}

TEST_CASE("what instruments write and a master curve cannot be is refused in one sentence with what to do",
          "[studies][text]") {
  CHECK(curve_of("Frequency (Hz);Temp. (°C);E' (MPa);E'' (MPa)\n1;20;4;1\n1;40;3;1\n") ==
        "dma.csv, line 3: Temp. [°C] = 40: a master curve is at one temperature, and the first row is at 20; \"rollres "
        "fit\" with \"shift\": \"free\" makes one of rows at several");
  CHECK(curve_of("Frequency (Hz),|G*| (MPa)\n1,2\n10,3\n") ==
        "dma.csv: |G*| needs a column beside it: tan_delta or phase_angle [deg]");
  CHECK_THAT(curve_of("Frequency (Hz),|G*| (MPa),Phase (°)\n1,2,95\n10,3,5\n"),
             Contains("dma.csv, line 2: Phase [°] = 95: must be above 0 and below 90 deg"));
  CHECK_THAT(curve_of("Frequency (Hz),G' (MPa),G'' (MPa)\n1,2,1\n[step]\nTemp sweep\nT,G'\n"),
             Contains("dma.csv, line 3: 1 cells where the first line names 3 columns"));
  CHECK_THAT(curve_of("Frequency (Hz),G' (MPa),G'' (MPa),Complex viscosity (Pa.s)\n1,2,1,3\n"),
             Contains("Complex viscosity: unknown column") && Contains("ignore_columns"));
}

TEST_CASE("what was understood of a table is one line", "[studies][text]") {
  const TemporaryDirectory folder;
  const auto file = folder.write("dma.csv",
                                 "Gerät;Eplexor\nFrequenz [Hz];Temperatur [°C];E' [MPa];E'' [MPa]\n0,1;-10;4,5;0,5\n"
                                 "10;23;7,25;1,5\n");
  CHECK(
      read_measured_table(file).in_words() ==
      "dma.csv: 2 rows of frequency [Hz] (Frequenz), temperature [°C] (Temperatur), E' [MPa], E'' [MPa]; names in line "
      "2, lines passed over: 1; decimal commas; at -10 to 23 degC");
}

TEST_CASE("blocks under the same names are one table, other names below it are refused", "[studies][text]") {
  const TemporaryDirectory directory;
  const auto rows = [&](const std::string& between) {
    return read_measured_table(directory.write("t.csv", "f [Hz],G' [Pa]\n1,2\n" + between + "\n3,4\n")).rows();
  };
  CHECK(rows("\nf [Hz],G' [Pa]") == 2);
  CHECK(rows("Segment,2,end\nf [Hz],G' [Pa]") == 2);
  CHECK_THAT(message_of([&] { rows("5,6,7\nf [Hz],G' [Pa]"); }), Contains("line 3: 3 cells where"));
  CHECK(rows("f [Hz],G'' [Pa]") == 3);
  const MeasuredTable table = read_measured_table(directory / "t.csv");
  CHECK_THAT(message_of([&] { measured_number(table, table.columns[0], 1, "Hz"); }),
             Catch::Contains("must be a finite number"));
}
