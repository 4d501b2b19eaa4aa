#include "studies/text/units.hpp"

#include <udunits2.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "studies/text/unit_in_si.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

template <auto free>
struct Freed {
  void operator()(auto* object) const { free(object); }
};
using Unit = std::unique_ptr<ut_unit, Freed<ut_free>>;
using Converter = std::unique_ptr<cv_converter, Freed<cv_free>>;
using System = std::unique_ptr<ut_system, Freed<ut_free_system>>;

/// The library has whole powers alone, and reads "s0.5" as 5: the root of a second, in an effusivity, is a unit of its
/// own to it.
constexpr const char* root_second = "root_second";
std::string with_root(std::string text) {
  for (const std::string_view written : {"s^0.5", "s0.5"})
    for (std::size_t at = text.find(written); at != std::string::npos; at = text.find(written))
      text.replace(at, written.size(), root_second);
  return text;
}

std::mutex udunits;  // the library keeps global state: one thread at a time

/// The database of units beside the program in a copied folder (studies/portable.sh); else that of the environment, or
/// the library's own.
System read_units() {
  std::error_code none;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", none);
  const auto beside = program.parent_path().parent_path() / "share/rollres/udunits/udunits2.xml";
  const bool taken = !std::getenv("UDUNITS2_XML_PATH") && std::filesystem::exists(beside, none);
  return System(ut_read_xml(taken ? beside.c_str() : nullptr));
}

/// Call with `udunits` held.
ut_system* unit_system() {
  static const System system = [] {
    ut_set_error_message_handler(ut_ignore);
    System read = read_units();
    if (!read)
      throw std::runtime_error("the database of units (udunits2) cannot be read; is libudunits2-data installed?");
    // Speeds of vehicles and belts that the library lacks, and the usual name of a degree.
    for (const auto& [name, meaning] :
         {std::pair{"mph", "mile/hour"}, std::pair{"fpm", "foot/minute"}, std::pair{"deg", "arc_degree"}}) {
      const Unit unit(ut_parse(read.get(), meaning, UT_ASCII));
      ut_map_name_to_unit(name, UT_ASCII, unit.get());
    }
    // What energy is sold in.
    const Unit watt_hour(ut_parse(read.get(), "W.hour", UT_ASCII));
    ut_map_symbol_to_unit("Wh", UT_ASCII, watt_hour.get());
    for (const std::string_view name : currencies) {
      const Unit unit(ut_new_base_unit(read.get()));
      ut_map_unit_to_symbol(unit.get(), name.data(), UT_ASCII);
      ut_map_symbol_to_unit(name.data(), UT_ASCII, unit.get());
      if (name == "EUR") ut_map_symbol_to_unit("€", UT_UTF8, unit.get());
    }
    const Unit root(ut_new_base_unit(read.get()));
    ut_map_unit_to_symbol(root.get(), root_second, UT_ASCII);
    ut_map_symbol_to_unit(root_second, UT_ASCII, root.get());
    return read;
  }();
  return system.get();
}

/// A unit that is often given, and what one of it is in SI as the library says: to read its database takes longer than
/// to solve a cylinder.
struct UsualUnit {
  std::string_view si, text;
  double size;
};
constexpr std::array<UsualUnit, 24> usual_units{
    {{"m", "m", 1},      {"m", "mm", 1e-3},     {"m", "cm", 1e-2},     {"m", "um", 1e-6},
     {"m/s", "m/s", 1},  {"m/s", "mm/s", 1e-3}, {"m/s", "cm/s", 1e-2}, {"m/s", "km/h", 1 / 3.6},
     {"s", "s", 1},      {"s", "ms", 1e-3},     {"s", "us", 1e-6},     {"s", "min", 60},
     {"s", "h", 3600},   {"Pa", "Pa", 1},       {"Pa", "kPa", 1e3},    {"Pa", "MPa", 1e6},
     {"Pa", "GPa", 1e9}, {"N", "N", 1},         {"N", "kN", 1e3},      {"N", "mN", 1e-3},
     {"N/m", "N/m", 1},  {"N/m", "kN/m", 1e3},  {"N/m", "N/mm", 1e3},  {"kg/m3", "kg/m3", 1}}};

/// A number at the start of a text and what follows it; `number` is NaN if the text does not start with one.
struct Leading {
  double number = std::nan("");
  std::string_view rest;
};

Leading leading_number(std::string_view text) {
  text = trimmed(text);
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  const char* const end = text.data() + text.size();
  Leading found;
  const auto [stop, error] = std::from_chars(text.data() + (plus ? 1 : 0), end, found.number);
  if (error != std::errc{} || !std::isfinite(found.number))
    found.number = std::nan("");
  else
    found.rest = trimmed({stop, static_cast<std::size_t>(end - stop)});
  return found;
}

double with_15_digits(double value) {
  std::array<char, 40> digits;
  const auto written =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::scientific, 14);
  std::from_chars(digits.data(), written.ptr, value);
  return value;
}

Converter converter(const std::string& from, const std::string& to) {
  constexpr std::size_t longest = 40;  // bounds what the library's parser is fed
  if (from.size() > longest) return nullptr;
  const std::scoped_lock lock(udunits);
  ut_system* const system = unit_system();
  const Unit source(ut_parse(system, with_root(from).c_str(), UT_UTF8));
  const Unit target(ut_parse(system, with_root(to).c_str(), UT_UTF8));
  if (!source || !target) return nullptr;
  return Converter(ut_get_converter(source.get(), target.get()));
}

/// A number with a unit, taken apart.
struct NumberWithUnit {
  double number;
  Converter to_si;
};

/// To the library an angle is a number, and rad/s the same as Hz: whether a unit counts one.
bool has_angle(std::string_view unit) {
  const std::scoped_lock lock(udunits);
  const Unit parsed(ut_parse(unit_system(), std::string(unit).c_str(), UT_UTF8));
  std::array<char, 200> definition{};
  return parsed && ut_format(parsed.get(), definition.data(), definition.size() - 1, UT_ASCII | UT_DEFINITION) > 0 &&
         std::string_view(definition.data()).find("rad") != std::string_view::npos;
}

NumberWithUnit number_with_unit(std::string_view text, std::string_view unit, const std::string& rule) {
  const Leading leading = leading_number(text);
  if (std::isnan(leading.number)) throw std::invalid_argument("must be a finite number, or one with a unit");
  if (leading.rest.size() > 1 && leading.rest[0] == ',' && leading.rest[1] >= '0' && leading.rest[1] <= '9')
    throw std::invalid_argument("must have a decimal point, not a comma");
  // A second number ("5 10 mm") or a sum ("5 +3 mm") would be read by the library as part of the unit; "1/m" is one.
  if (leading.rest.empty() || (!leading.rest.starts_with("1/") &&
                               std::string_view("+-.0123456789").find(leading.rest.front()) != std::string_view::npos))
    throw std::invalid_argument(rule);
  Converter to_si = converter(std::string(leading.rest), std::string(unit));
  if (!to_si) throw std::invalid_argument(rule);
  return {leading.number, std::move(to_si)};
}

double finite(double value) {
  if (!std::isfinite(value)) throw std::invalid_argument("must be a finite number");
  return value;
}

}  // namespace

std::optional<double> plain_number(std::string_view text) {
  const Leading leading = leading_number(text);
  if (std::isnan(leading.number) || !leading.rest.empty()) return std::nullopt;
  return leading.number;
}

std::optional<double> percentage(std::string_view text) {
  if (!text.ends_with('%')) return std::nullopt;
  const auto number = plain_number(text.substr(0, text.size() - 1));
  return number ? std::optional(*number / 100) : std::nullopt;
}

std::string unit_in_words(std::string_view unit) {
  constexpr std::string_view measures =  // units, each with what it measures
      ", m length, byte memory, m2 area, m/s speed, s time, Pa stress, N force, N/m force per length, N.m torque, W "
      "power, W/m power per length, kg/m3 density, rad/s rotational speed, rad angle, K temperature, Hz frequency, "
      "J/mol molar energy, 1/m curvature, W/m/K thermal conductivity, J/m3/K heat capacity per volume, W/m2/K heat "
      "transfer, W.s0.5/m2/K thermal effusivity,";
  const std::string head = ", " + std::string(unit) + " ";
  if (const std::size_t at = measures.find(head); at != std::string_view::npos) {
    const std::string_view measure = measures.substr(at + head.size());
    return "a unit of " + std::string(measure.substr(0, measure.find(','))) + " (" + std::string(unit) + ")";
  }
  return "a unit that converts to " + std::string(unit);
}

double si_value(std::string_view text, std::string_view unit) {
  if (const Leading leading = leading_number(text); !std::isnan(leading.number))
    for (const UsualUnit& usual : usual_units)
      if (usual.si == unit && usual.text == leading.rest) {
        const double value = finite(leading.number * usual.size);
        return usual.size == 1 ? value : with_15_digits(value);
      }
  const std::string rule =
      unit == "1" ? std::string("must be a number without a unit") : "must have " + unit_in_words(unit);
  const auto [number, to_si] = number_with_unit(text, unit, rule);
  const std::string_view given = leading_number(text).rest;
  const bool frequency = unit == "Hz", angle = (frequency || unit == "rad/s") && has_angle(given);
  if (frequency && angle && given.find("rad") == std::string_view::npos)
    throw std::invalid_argument(rule + " or rad/s, as an angular frequency");
  if (unit == "rad/s" && !angle) throw std::invalid_argument(rule + ", which is 2 π times a frequency in Hz");
  // Scales with an origin (degC, "m since 3") or a logarithm have no place here.
  const double one = cv_convert_double(to_si.get(), 1.0);
  if (cv_convert_double(to_si.get(), 0.0) != 0.0 || !std::isfinite(one) || one <= 0) throw std::invalid_argument(rule);
  const double value = finite(cv_convert_double(to_si.get(), number));
  if (frequency && angle) return with_15_digits(value / (2 * std::numbers::pi));
  return one == 1.0 ? value : with_15_digits(value);
}

UnitInSi unit_in_si(const std::string& unit) {
  constexpr std::size_t longest = 40;
  const std::string rule = unit + ": must be a unit, as in kN/m2";
  std::array<char, 200> definition{};
  {
    const std::scoped_lock lock(udunits);
    const Unit parsed(
        unit.size() > longest || unit.empty() ? nullptr : ut_parse(unit_system(), with_root(unit).c_str(), UT_UTF8));
    if (!parsed || ut_format(parsed.get(), definition.data(), definition.size() - 1, UT_ASCII | UT_DEFINITION) <= 0)
      throw std::invalid_argument(rule);
  }
  UnitInSi found;
  constexpr std::array<std::string_view, 5 + currencies.size()> bases{
      "m", "kg", "s", "K", "mol", currencies[0], currencies[1], currencies[2], currencies[3]};
  std::string_view rest(definition.data());
  if (const Leading size = leading_number(rest); !std::isnan(size.number)) {
    found.size = size.number;
    rest = size.rest;
  }
  while (!rest.empty()) {  // "kg.m-1.s-2"
    const std::string_view part = rest.substr(0, rest.find('.'));
    rest.remove_prefix(std::min(part.size() + 1, rest.size()));
    const std::string_view name = part.substr(0, part.find_first_of("-0123456789"));
    const double power = name.size() == part.size() ? 1 : plain_number(part.substr(name.size())).value_or(0);
    if (name == root_second) {
      found.exponents[2] += 0.5 * power;  // of seconds
      continue;
    }
    const auto base = std::find(bases.begin(), bases.end(), name);
    if (power == 0 || (base == bases.end() && name != "rad")) throw std::invalid_argument(rule);
    if (base != bases.end()) found.exponents[static_cast<std::size_t>(base - bases.begin())] += power;
  }
  return found;
}

double kelvin(std::string_view text) {
  const auto [number, to_si] = number_with_unit(text, "K", "must have a unit of temperature (K or degC)");
  if (cv_convert_double(to_si.get(), 0.0) == 0.0 && cv_convert_double(to_si.get(), 1.0) == 1.0) return finite(number);
  return with_15_digits(finite(cv_convert_double(to_si.get(), number)));
}

}  // namespace rollres
