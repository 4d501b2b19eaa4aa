#include "studies/scene_io/master_curve_file.hpp"

#include <numbers>
#include <stdexcept>

namespace rollres {

std::vector<double> measured_frequencies(const MeasuredTable& table) {
  const MeasuredColumn* const radians = table.find("angular_frequency");
  if (radians && table.find("frequency"))
    throw std::invalid_argument(table.file + ": give frequency or angular_frequency, not both");
  const std::string rule = frequency_range.rule() + " Hz";
  if (!radians) return measured_numbers(table, table.needed("frequency"), "Hz", frequency_range, rule);
  constexpr double turn = 2 * std::numbers::pi;
  const Range range{turn * frequency_range.lowest, turn * frequency_range.highest};
  std::vector<double> frequencies = measured_numbers(table, *radians, "rad/s", range, rule);
  for (double& frequency : frequencies) frequency *= 0.5 / std::numbers::pi;
  return frequencies;
}

Json read_master_curve(const std::filesystem::path& file) {
  const MeasuredTable table = read_measured_table(file);
  table.refuse_others(
      std::array<std::string_view, 5>{"frequency", "angular_frequency", "storage_modulus", "loss_modulus", "note"});
  Json lists;
  lists["frequencies"] = measured_frequencies(table);
  lists["storage_moduli"] = measured_numbers(table, table.needed("storage_modulus"), "Pa", positive);
  lists["loss_moduli"] = measured_numbers(table, table.needed("loss_modulus"), "Pa", not_negative,
                                          not_negative.rule() + ": no passive material gives energy back");
  return lists;
}

Json with_master_curve(const Json& object, const std::filesystem::path& folder, const std::string& place) {
  const std::string key(master_curve_key);
  if (!object.is_object() || !object.contains(key)) return object;
  const Json& name = object[key];
  if (!name.is_string() || name.get_ref<const std::string&>().empty())
    refuse(place, key, name, "must be the name of a CSV file");
  for (const std::string_view input : master_curve_inputs)
    if (object.contains(std::string(input)))
      refuse(place, input, object[std::string(input)], "is in the master_curve_file; give one of them");
  Json complete = Json::object();
  for (const auto& [other, value] : object.items())
    if (other == key)
      complete.update(read_master_curve(folder / name.get<std::string>()));
    else
      complete[other] = value;
  return complete;
}

}  // namespace rollres
