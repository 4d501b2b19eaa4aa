#include "studies/scaled_unit.hpp"

#include <limits>

#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("a number is shown in the unit in which it lies between 1 and 1000", "[studies][scaled_unit]") {
  CHECK(with_scaled_unit(0.005, "m") == "5 mm");
  CHECK(with_scaled_unit(3.6982e-4, "m") == "369.82 µm");
  CHECK(with_scaled_unit(20000, "N/m") == "20 kN/m");
  CHECK(with_scaled_unit(3e6, "Pa") == "3 MPa");
  CHECK(with_scaled_unit(0.05, "m/s") == "50 mm/s");
  CHECK(with_scaled_unit(0.25, "s") == "250 ms");
  CHECK(with_scaled_unit(0.02, "N.m") == "20 mN·m");
  CHECK(with_scaled_unit(-1500, "W/m") == "-1.5 kW/m");
}

TEST_CASE("a square takes the square of its prefix", "[studies][scaled_unit]") {
  CHECK(with_scaled_unit(5.9e-5, "m2") == "59 mm²");
  CHECK(with_scaled_unit(2, "m2") == "2 m²");
}

TEST_CASE("units that nobody prefixes stay as they are", "[studies][scaled_unit]") {
  CHECK(with_scaled_unit(1000, "kg/m3") == "1000 kg/m³");
  CHECK(with_scaled_unit(2.6, "rad/s") == "2.6 rad/s");
  CHECK(with_scaled_unit(5000, "s") == "5000 s");
  CHECK(with_scaled_unit(2000, "m") == "2000 m");
  CHECK(with_scaled_unit(0.2, "1") == "0.2");
  CHECK(with_scaled_unit(0, "Pa") == "0 Pa");
  CHECK(with_scaled_unit(std::numeric_limits<double>::infinity(), "m") == "infinite");
}

TEST_CASE("a number that rounds up to 1000 takes the next prefix", "[studies][scaled_unit]") {
  CHECK(with_scaled_unit(999.9999999, "N") == "1 kN");
  CHECK(with_scaled_unit(999.99, "N") == "999.99 N");
  CHECK(with_scaled_unit(0.3 - 0.1, "m") == "200 mm");
}

TEST_CASE("a logarithmic axis keeps the plain unit where its numbers are short", "[studies][scaled_unit]") {
  CHECK(scaled_unit_logarithmic("m/s", 1e-3, 10).name == "m/s");
  CHECK(scaled_unit_logarithmic("Pa", 1e5, 1e9).name == "MPa");
  CHECK(scaled_unit_logarithmic("m", 1e-6, 1e-4).name == "µm");
  CHECK(scaled_unit_logarithmic("m", 1e-6, 1e-4).factor == Approx(1e-6));
  CHECK(scaled_unit_logarithmic("1", 1e-9, 1).name.empty());
}

TEST_CASE("short numbers have no exponent at everyday sizes and no trailing zeros", "[studies][scaled_unit]") {
  CHECK(short_number(4030.4, 3) == "4030");
  CHECK(short_number(100000) == "100000");
  CHECK(short_number(0.25, 3) == "0.25");
  CHECK(short_number(0.1 + 0.2) == "0.3");
  CHECK(short_number(1.25e-9, 3) == "1.25e-09");
  CHECK(short_number(0) == "0");
}
