
#include <cmath>

#include "studies/text/readable_number.hpp"
#include "studies/text/value_and_error.hpp"
#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("the prefix of a unit puts its number between 1 and 1000", "[studies][scaled_unit]") {
  CHECK(scaled_unit("N/m", 20000).name == "kN/m");
  CHECK(scaled_unit("N/m", 20000).factor == Approx(1e3));
  CHECK(scaled_unit("m/s", 0.05).name == "mm/s");
  CHECK(scaled_unit("W/m", -1500).name == "kW/m");
  CHECK(scaled_unit("N", 999.999).name == "kN");
  CHECK(scaled_unit("N", 999.98).name == "N");
  CHECK(scaled_unit("m", 2000).name == "m");
  CHECK(scaled_unit("s", 5000).name == "s");
  CHECK(scaled_unit("kg/m3", 1000).name == "kg/m3");
  CHECK(scaled_unit("rad/s", 2000).name == "rad/s");
  CHECK(scaled_unit("1", 1e-9).name.empty());
}

TEST_CASE("a value beside its error has the digits of the error, and both one unit", "[studies][scaled_unit]") {
  const auto shown = [](double value, double error, const char* unit) {
    const ValueAndError both = value_and_error(value, error, unit);
    return both.value + " +- " + both.error;
  };
  CHECK(shown(15.199, 2.7, "N/m") == "15.2 N/m +- 2.7 N/m");
  CHECK(shown(1.6947e6, 267.38e3, "Pa") == "1.69 MPa +- 0.27 MPa");
  CHECK(shown(0.982564, 0.441931, "") == "0.98 +- 0.44");
  CHECK(shown(0.003, 0.44, "") == "0 +- 0.44");
  CHECK(shown(3.2317, 1e-9, "") == "3.2317 +- 1e-09");
  CHECK(shown(1234, 560, "N/m") == "1.23 kN/m +- 0.56 kN/m");
  CHECK(shown(2.5, NAN, "m") == "2.5 m +- -");
}

TEST_CASE("a square takes the square of its prefix", "[studies][scaled_unit]") {
  CHECK(scaled_unit("m2", 5.9e-5).name == "mm2");
  CHECK(scaled_unit("m2", 5.9e-5).factor == Approx(1e-6));
}

TEST_CASE("a logarithmic axis keeps the plain unit where its numbers are short", "[studies][scaled_unit]") {
  CHECK(scaled_unit_logarithmic("m/s", 1e-3, 10).name == "m/s");
  CHECK(scaled_unit_logarithmic("N/m", 1e-6, 628).name == "N/m");
  CHECK(scaled_unit_logarithmic("N/m", 20, 1e4).name == "N/m");
  CHECK(scaled_unit_logarithmic("m", 2e-3, 2e-2).name == "mm");
  CHECK(scaled_unit_logarithmic("m", 1e-3, 0.5).name == "mm");
  CHECK(scaled_unit_logarithmic("Pa", 1e5, 1e9).name == "MPa");
  CHECK(scaled_unit_logarithmic("m", 1e-6, 1e-4).name == "µm");
  CHECK(scaled_unit_logarithmic("m", 1e-6, 1e-4).factor == Approx(1e-6));
  CHECK(scaled_unit_logarithmic("1", 1e-9, 1).name.empty());
}

TEST_CASE("units are printed with raised powers", "[studies][scaled_unit]") {
  CHECK(typeset_unit("kg/m3") == "kg/m³");
  CHECK(typeset_unit("mN.m") == "mN·m");
}

TEST_CASE("short numbers have no exponent at everyday sizes and no trailing zeros", "[studies][scaled_unit]") {
  CHECK(short_number(4030.4, 3) == "4030");
  CHECK(short_number(100000) == "100000");
  CHECK(short_number(0.25, 3) == "0.25");
  CHECK(short_number(0.1 + 0.2) == "0.3");
  CHECK(short_number(1.25e-9, 3) == "1.25e-09");
  CHECK(short_number(0) == "0");
}
