#include "studies/text/table_heading.hpp"

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;

namespace {

std::string read_heading(const std::string& text) {
  const TableHeading heading = table_heading(text);
  return heading.name + "|" + heading.unit;
}

}  // namespace

TEST_CASE("headings are read as instruments and spreadsheets write them", "[studies][text]") {
  CHECK(read_heading("frequency [Hz]") == "frequency|Hz");
  CHECK(read_heading("Frequency (Hz)") == "frequency|Hz");
  CHECK(read_heading("FREQUENCY / Hz") == "frequency|Hz");
  CHECK(read_heading("Freq(Hz)") == "frequency|Hz");
  CHECK(read_heading("Angular Frequency (rad/s)") == "angular_frequency|rad/s");
  CHECK(read_heading("Storage Modulus [MPa]") == "storage_modulus|MPa");
  CHECK(read_heading("Loss-Modulus(MPa)") == "loss_modulus|MPa");
  CHECK(read_heading("E' (MPa)") == "E'|MPa");
  CHECK(read_heading("e’’ [Pa]") == "E''|Pa");
  CHECK(read_heading("G\" / kPa") == "G''|kPa");
  CHECK(read_heading("Storage Modulus E' [MPa]") == "E'|MPa");
  CHECK(read_heading("Verlustmodul G\" / kPa") == "G''|kPa");
  CHECK(read_heading("Loss Modulus E' [MPa]") == "loss_modulus_e'|MPa");  // one of the two is wrong
  CHECK(read_heading("Tan(delta)") == "tan_delta|");
  CHECK(read_heading("tan(delta) (-)") == "tan_delta|1");
  CHECK(read_heading("Tan δ [-]") == "tan_delta|1");
  CHECK(read_heading("Temperature (°C)") == "temperature|°C");
  CHECK(read_heading("Temp. [oC]") == "temperature|degC");
  CHECK(read_heading("T [°C]") == "temperature|°C");
  CHECK(read_heading("t [s]") == "time|s");  // a time
  CHECK(read_heading("Freq. [Hz]") == "frequency|Hz");
  CHECK(read_heading("Ang. frequency (rad/s)") == "angular_frequency|rad/s");
  CHECK(read_heading("aT") == "a_T|");
  CHECK(read_heading("log10_a_T") == "log10_a_T|");
  CHECK(read_heading("Strain (%)") == "strain|%");
  CHECK(read_heading("coating_layers[0].layer_thickness [mm]") == "coating_layers[0].layer_thickness|mm");
  CHECK(read_heading("relaxation (of the second kind)") == "relaxation_(of_the_second_kind)|");
  CHECK(table_heading("Storage Modulus [MPa]").written == "Storage Modulus");
  CHECK(table_heading("frequency [Hz]").written.empty());
  CHECK(message_of([] { table_heading("speed [m/s] of it"); }) ==
        "\"speed [m/s] of it\": must be a name with its unit in brackets: \"speed [m/s]\"");
  CHECK(message_of([] { table_heading(""); }) == "a column has no name");
  CHECK(message_of([] { table_heading("[m]"); }) == "\"[m]\": a column has no name");
}
