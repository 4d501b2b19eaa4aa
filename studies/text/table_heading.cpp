#include "studies/text/table_heading.hpp"

#include <array>
#include <cctype>
#include <stdexcept>
#include <utility>

#include "studies/text/unit_in_si.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// Names, each with what instruments call it, and what those of letters of both cases are in small letters.
constexpr std::pair<std::string_view, std::string_view> usual_headings[] = {
    {"a_T", "a_t at"},
    {"b_T", "b_t bt"},
    {"log10_a_T", "log10_a_t log_a_t log_at log(at) log(a_t) log10(at) log10(a_t)"},
    {"frequency", "freq f freq. oscillation_frequency frequenz messfrequenz prüffrequenz fréquence frequence"},
    {"angular_frequency",
     "angular_freq angular_freq. ang._freq. ang._frequency omega ω ang._freq kreisfrequenz pulsation"},
    {"temperature", "temp. temp temperatur probentemperatur température"},
    {"tan_delta", "tan(delta) tan_(delta) tan(δ) tan_δ tanδ tandelta tan_d"},
    {"loss_tangent", "loss_factor verlustfaktor facteur_de_perte"},
    {"relaxation_shear_modulus", "g(t) shear_relaxation_modulus"},
    {"relaxation_young_modulus", "e(t) tensile_relaxation_modulus young_relaxation_modulus"},
    {"shear_creep_compliance", "j(t) creep_shear_compliance"},
    {"tensile_creep_compliance", "d(t) creep_tensile_compliance"},
    {"complex_shear_modulus", "|g*| g*"},
    {"complex_young_modulus", "|e*| e*"},
    {"phase_angle",
     "phase loss_angle delta δ phasenwinkel phasenverschiebung verlustwinkel angle_de_phase angle_de_perte déphasage"},
    {"time", "zeit temps"},
    {"storage_modulus", "speichermodul module_de_conservation module_de_stockage"},
    {"loss_modulus", "verlustmodul module_de_perte"},
    {"complex_modulus", "komplexer_modul module_complexe"},
    {"relaxation_modulus", "relaxationsmodul module_de_relaxation"},
    {"creep_compliance", "kriechnachgiebigkeit complaisance_de_fluage"},
    {"strain", "dehnung"},
    {"note", "bemerkung"},
};

constexpr std::string_view measured_names =
    "frequency angular_frequency temperature time strain storage_modulus storage_shear_modulus storage_young_modulus "
    "loss_modulus loss_shear_modulus loss_young_modulus complex_modulus complex_shear_modulus complex_young_modulus "
    "phase_angle loss_tangent tan_delta E' E'' G' G'' relaxation_modulus relaxation_shear_modulus "
    "relaxation_young_modulus creep_compliance shear_creep_compliance tensile_creep_compliance a_T b_T log10_a_T note";

/// "E'" of "e’": a letter and strokes, straight or bent.
std::string modulus_symbol(std::string_view name) {
  if (name.empty() || std::string_view("eEgG").find(name.front()) == std::string_view::npos) return {};
  std::string symbol(1, static_cast<char>(std::toupper(static_cast<unsigned char>(name.front()))));
  name.remove_prefix(1);
  while (!name.empty()) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 7> strokes{
        {{"'", "'"}, {"′", "'"}, {"’", "'"}, {"´", "'"}, {"\"", "''"}, {"″", "''"}, {"”", "''"}}};
    const auto found = find_if(strokes, [&](const auto& stroke) { return name.starts_with(stroke.first); });
    if (found == strokes.end()) return {};
    symbol += found->second;
    name.remove_prefix(found->first.size());
  }
  return symbol == "E'" || symbol == "E''" || symbol == "G'" || symbol == "G''" ? symbol : std::string();
}

/// The name as keys are written.
std::string as_key(std::string_view name) {
  if (std::string symbol = modulus_symbol(name); !symbol.empty()) return symbol;
  std::string key;
  for (const char letter : name) {
    const bool gap = letter == ' ' || letter == '-' || letter == '_';
    if (gap && !key.empty() && key.back() == '_') continue;
    key += gap ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  for (const auto& [usual, others] : usual_headings)
    if (has_word(others, key)) return std::string(usual);
  const std::size_t gap = name.rfind(' ');  // "Storage Modulus E'": the symbol says more than the name
  const std::string symbol = gap == std::string_view::npos ? std::string() : modulus_symbol(name.substr(gap + 1));
  const char* const meant = symbol.ends_with("''") ? "loss_modulus" : "storage_modulus";
  return !symbol.empty() && as_key(name.substr(0, gap)) == meant ? symbol : key;
}

/// The unit as the library of units has it.
std::string plain_unit(std::string_view unit) {
  if (unit == "-" || unit == "–") return "1";
  if (unit == "deg C" || unit == "oC" || unit == "° C" || unit == "ºC") return "degC";
  return std::string(unit);
}

/// Where a unit that stands at the end of a heading begins, and where its name ends.
struct UnitPlace {
  std::size_t name_end, begin, end;
};

/// @throws std::invalid_argument if a bracket is not closed
UnitPlace unit_place(std::string_view text) {
  const UnitPlace none{text.size(), text.size(), text.size()};
  const auto layer = text.find("].");  // of coating_layers[0].layer_thickness [mm]
  const auto open = text.find('[', layer == std::string_view::npos ? 0 : layer);
  if (open != std::string_view::npos) {
    if (text.back() != ']')
      throw std::invalid_argument('"' + shortened(std::string(text)) +
                                  "\": must be a name with its unit in brackets: \"speed [m/s]\"");
    return {open, open + 1, text.size() - 1};
  }
  constexpr std::string_view of_time = "(t)";  // of G(t) and J(t) no tonne
  if (const auto round = text.rfind('(');
      round != std::string_view::npos && round > 0 && text.back() == ')' && text.substr(round) != of_time)
    if (is_unit(trimmed(text.substr(round + 1, text.size() - round - 2)))) return {round, round + 1, text.size() - 1};
  if (const auto stroke = text.find(" / ");
      stroke != std::string_view::npos && is_unit(trimmed(text.substr(stroke + 3))))
    return {stroke, stroke + 3, text.size()};
  // "E'/MPa"; other names may be ratios.
  if (const auto stroke = text.find('/');
      stroke != std::string_view::npos && is_unit(text.substr(stroke + 1)) &&
      (is_measured_name(as_key(text.substr(0, stroke))) || as_key(text.substr(0, stroke)) == "t"))
    return {stroke, stroke + 1, text.size()};
  return none;
}

}  // namespace

bool is_measured_name(std::string_view name) { return has_word(measured_names, name); }

bool is_unit(std::string_view text) {
  const std::string unit = plain_unit(text);
  if (unit == "1" || unit == "%" || unit == "degC" || unit == "°C" || unit == "°F" || unit == "degF") return true;
  try {
    unit_in_si(unit);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

TableHeading table_heading(std::string_view text) {
  if (text.empty()) throw std::invalid_argument("a column has no name");
  const UnitPlace place = unit_place(text);
  const std::string name(trimmed(text.substr(0, place.name_end)));
  if (name.empty()) throw std::invalid_argument('"' + shortened(std::string(text)) + "\": a column has no name");
  TableHeading heading{as_key(name), plain_unit(trimmed(text.substr(place.begin, place.end - place.begin))), {}};
  constexpr std::array<std::string_view, 5> of_temperature{"K", "degC", "°C", "°F", "degF"};
  if (heading.name == "t" && contains(of_temperature, heading.unit))
    heading.name = "temperature";
  else if (heading.name == "t" && !heading.unit.empty())
    heading.name = "time";
  if (heading.name != name) heading.written = name;
  return heading;
}

}  // namespace rollres
