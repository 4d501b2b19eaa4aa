#include "studies/fit/shift_file.hpp"

#include <stdexcept>

#include "db/file/digest.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/text/measured_table.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/units.hpp"

namespace rollres {

ShiftFile read_shift_fit(const std::filesystem::path& file) {
  const std::string place = file.string();
  const Json object = read_object(place);
  ShiftFile fit{given_name(object, shift_fit_keys, place)};
  fit.law.law = static_cast<ShiftLaw>(find_name(shift_names, name_or_first(object, "shift", law_names, place)));
  fit.options = given_descents(object, place);
  fit.scene = given_scene(object, file, place);
  if (const auto sigma = object.find("sigma"); sigma != object.end())
    fit.deviation = relative_sigma(*sigma, "sigma", place, "must be a percentage > 0: \"5 %\"");

  const std::string name = needed_text(object, "data", place, "must be the name of a CSV file");
  MeasuredTable table = read_measured_table(file.parent_path() / name);
  fit.data_digest = digest(table.text);
  fit.notes.push_back(table.in_words());
  table.leave_out(names_or_none(object, "ignore_columns", place));
  constexpr std::array<std::string_view, 4> known{"temperature", "a_T", "log10_a_T", "note"};
  std::vector<std::string> others;
  if (table.find("b_T")) others.emplace_back("b_T"), table.leave_out(others);  // resembles a_T
  for (const std::string& other : table.leave_out_others(known)) others.push_back(other);
  note_left_out(fit, object, others);
  const std::vector<double> factors = measured_shift_factors(table);
  for (std::size_t row = 0; row < table.rows(); ++row)
    fit.data.push_back({measured_number(table, table.needed("temperature"), row, "K"), factors[row], table.place(row)});
  fit.law.reference =
      object.contains("reference_temperature") ? given_reference_temperature(object, place) : reference_of(fit.data);
  fit.relative_to = take_reference(fit.data);
  if (fit.relative_to)
    fit.notes.push_back("the row at " + readable(*fit.relative_to, "K") +
                        " is the reference (a_T = 1) and does not count as a measurement");
  return fit;
}

}  // namespace rollres
