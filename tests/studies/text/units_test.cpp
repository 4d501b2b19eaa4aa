#include "studies/text/units.hpp"

#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/readable_number.hpp"
#include "tests/catch.hpp"

using namespace rollres;

TEST_CASE("numbers with units become the SI numbers one would write by hand", "[studies][units]") {
  struct Example {
    std::string text, unit;
    double value;
  };
  // Exact: the literal on the right is the nearest double to the same decimal number.
  const std::vector<Example> examples{{"5 mm", "m", 0.005},
                                      {"0.25 mm", "m", 0.00025},
                                      {"5mm", "m", 0.005},
                                      {" 5  mm ", "m", 0.005},
                                      {"+5e0 mm", "m", 0.005},
                                      {"7 cm", "m", 0.07},
                                      {"3 µm", "m", 3e-6},
                                      {"3 um", "m", 3e-6},
                                      {"-3 mm", "m", -0.003},
                                      {"36 km/h", "m/s", 10},
                                      {"5 cm/s", "m/s", 0.05},
                                      {"60 mph", "m/s", 26.8224},
                                      {"500 fpm", "m/s", 2.54},
                                      {"7 mm s-1", "m/s", 0.007},
                                      {"20 kN/m", "N/m", 20e3},
                                      {"3 N/mm", "N/m", 3e3},
                                      {"150 N", "N", 150},
                                      {"0.15 kN", "N", 150},
                                      {"3 MPa", "Pa", 3e6},
                                      {"3 N/mm2", "Pa", 3e6},
                                      {"3 N/mm^2", "Pa", 3e6},
                                      {"2 bar", "Pa", 2e5},
                                      {"250 ms", "s", 0.25},
                                      {"2 min", "s", 120},
                                      {"1.2 g/cm3", "kg/m3", 1200},
                                      {"1000 kg/m³", "kg/m3", 1000},
                                      {"2 N.m", "N.m", 2},
                                      {"2 N·m", "N.m", 2},
                                      {"2 kN mm", "N.m", 2},
                                      {"20 %", "1", 0.2},
                                      {"0.1234567890123456 m", "m", 0.1234567890123456}};
  for (const Example& example : examples) {
    INFO(example.text);
    CHECK(si_value(example.text, example.unit) == example.value);
  }
}

TEST_CASE("the root of a second in an effusivity is no number, and W/m2/K is no effusivity", "[studies][units]") {
  const std::string unit = "W.s0.5/m2/K";
  CHECK(si_value("600 W.s^0.5/m2/K", unit) == 600);
  CHECK(si_value("0.6 kW s0.5/m2/K", unit) == 600);
  CHECK_THROWS_WITH(si_value("600 W/m2/K", unit), Catch::Matchers::Contains("thermal effusivity"));
}

TEST_CASE("every unit of an input is read back as itself, with and without a prefix", "[studies][units]") {
  for (const InputKind& kind : input_kinds())
    for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
      const std::string unit(kind.quantity.unit_for(indenter));
      if (unit.empty() || unit == "1") continue;
      INFO(kind.quantity.key << " in " << unit);
      CHECK(si_value("0.125 " + unit, unit) == 0.125);
      CHECK(unit_in_words(unit).find("converts") == std::string::npos);
      for (const double value : {2.5e-7, 0.0125, 0.4, 7.0, 31250.0, 2e8}) {
        INFO(readable(value, unit));
        // "kkg/m3" is no unit: density takes no prefix, and is then written as it is; angles are told in degrees
        if (unit == "rad")
          CHECK(si_value(readable(value, unit), unit) == Approx(value).epsilon(1e-4));
        else
          CHECK(si_value(readable(value, unit), unit) == value);
      }
    }
}

TEST_CASE("what is not a number with the wanted unit is refused with the unit that is wanted", "[studies][units]") {
  const std::string speed = "must have a unit of speed (m/s)", number = "must be a finite number, or one with a unit";
  CHECK_THROWS_WITH(si_value("5 kg", "m/s"), speed);
  CHECK_THROWS_WITH(si_value("5,5 m/s", "m/s"), "must have a decimal point, not a comma");
  for (const std::string text :
       {"5", "5 m", "5 furlongs", "5 m/s/", "5 6 m/s", "5 +6 m/s", "5 m/s @ 3", "5 m/s since 3", "5 lg(re 1 m/s)",
        "5 (((", "5 \xff", "5 m/0", "0x10 m/s", "5 m^999", "5 m/s m/s m/s m/s m/s m/s m/s m/s m/s m/s m/s m/s m/s"}) {
    INFO(text);
    CHECK_THROWS_WITH(si_value(text, "m/s"), speed);
  }
  for (const std::string text :
       {"", "m/s", "nan m/s", "inf m/s", "-inf m/s", "1e999 m/s", "fast", "--5 m/s", "+-5 m/s"}) {
    INFO(text);
    CHECK_THROWS_WITH(si_value(text, "m/s"), number);
  }
  CHECK_THROWS_WITH(si_value("1e308 km/s", "m/s"), "must be a finite number");
  CHECK_THROWS_WITH(si_value("5 kg", "1"), "must be a number without a unit");
  CHECK_THROWS_WITH(si_value("5 degC", "K"), "must have a unit of temperature (K)");
  CHECK_THROWS_WITH(si_value("5 m", "A"), "must have a unit that converts to A");
}

TEST_CASE("a plain number is a plain number whatever follows", "[studies][units]") {
  CHECK(plain_number("-1e-3").value() == -1e-3);
  CHECK(plain_number(" 5 ").value() == 5);
  for (const char* const text : {"", "5 m", "nan", "inf", "infinite", "1e999", "1,5", "0x10"}) {
    INFO(text);
    CHECK_FALSE(plain_number(text).has_value());
  }
}

TEST_CASE("units may be read by several threads at once", "[studies][units]") {
  std::vector<int> wrong(4, 0);
  {
    std::vector<std::thread> threads;
    for (int& mine : wrong)
      threads.emplace_back([&mine] {
        for (int i = 0; i < 200; ++i) mine += si_value("36 km/h", "m/s") == 10 ? 0 : 1;
      });
    for (std::thread& thread : threads) thread.join();
  }
  CHECK(wrong == std::vector<int>(4, 0));
}

TEST_CASE("readable numbers carry the prefix that leaves one to three digits before the point", "[studies][units]") {
  CHECK(readable(0.00036982, "m") == "369.82 µm");
  CHECK(readable(2.556e6, "Pa") == "2.556 MPa");
  CHECK(readable(357.5, "N/m") == "357.5 N/m");
  CHECK(readable(20e3, "N/m") == "20 kN/m");
  CHECK(readable(-0.00375, "m") == "-3.75 mm");
  CHECK(readable(2000, "m") == "2000 m");
  CHECK(readable(4.8e-5, "m2") == "48 mm2");
  CHECK(readable(0.0306, "N.m") == "30.6 mN.m");
  CHECK(readable(2.5, "rad/s") == "2.5 rad/s");
  CHECK(readable(1000, "kg/m3") == "1000 kg/m3");
  CHECK(readable(0, "m") == "0 m");
  CHECK(readable(0.9999999, "Pa") == "1 Pa");
  CHECK(readable(1.0405, "1") == "1.0405");
  CHECK(readable(std::numeric_limits<double>::infinity(), "m") == "infinite");
  CHECK(readable(std::numeric_limits<double>::quiet_NaN(), "m") == "-");
  CHECK(width("τ_xz") == 4);
  CHECK(padded("Ω", 3) == "Ω  ");
}

TEST_CASE("usual units are what the database of units says, to the last bit", "[studies][units]") {
  // Names in full are looked up in the database.
  const std::vector<std::tuple<std::string, std::string, std::string>> same{{"m", "mm", "millimeter"},
                                                                            {"m", "cm", "centimeter"},
                                                                            {"m", "um", "micrometer"},
                                                                            {"m/s", "mm/s", "millimeter/s"},
                                                                            {"m/s", "cm/s", "centimeter/s"},
                                                                            {"m/s", "km/h", "kilometer/hour"},
                                                                            {"s", "ms", "millisecond"},
                                                                            {"s", "us", "microsecond"},
                                                                            {"s", "min", "minute"},
                                                                            {"s", "h", "hour"},
                                                                            {"Pa", "kPa", "kilopascal"},
                                                                            {"Pa", "MPa", "megapascal"},
                                                                            {"Pa", "GPa", "gigapascal"},
                                                                            {"N", "kN", "kilonewton"},
                                                                            {"N", "mN", "millinewton"},
                                                                            {"N/m", "kN/m", "kilonewton/m"},
                                                                            {"N/m", "N/mm", "N/millimeter"},
                                                                            {"m", "m", "meter"},
                                                                            {"Pa", "Pa", "pascal"},
                                                                            {"N", "N", "newton"},
                                                                            {"s", "s", "second"},
                                                                            {"m/s", "m/s", "meter/second"},
                                                                            {"N/m", "N/m", "newton/meter"},
                                                                            {"kg/m3", "kg/m3", "kilogram/m3"}};
  double number = 0.1;
  for (const auto& [si, usual, whole] : same)
    for (int i = 0; i < 100; ++i) {
      number = number > 1e6 ? number / 3e9 : number * 1.37;
      const std::string text = std::to_string(number) + "7 ";
      INFO(text << usual);
      CHECK(si_value(text + usual, si) == si_value(text + whole, si));
    }
  CHECK_THROWS_AS(si_value("1e308 GPa", "Pa"), std::invalid_argument);
}
