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
  measured_numbers(table, *radians, "rad/s", range, rule);
  // As under "frequency": to 15 digits, so that a table in rad/s is to all digits the one in Hz. Rotations are refused.
  return measured_numbers(table, *radians, "Hz", frequency_range, rule);
}

MeasuredModuli measured_moduli(const MeasuredTable& table, const Range& loss_range, const std::string& rule) {
  const MeasuredColumn* const storage = table.find("storage_modulus");
  const MeasuredColumn* const loss = table.find("loss_modulus");
  const MeasuredColumn* tangent = table.find("loss_tangent");
  const MeasuredColumn* const other = table.find("tan_delta");
  if (tangent && other) throw std::invalid_argument(table.file + ": give loss_tangent or tan_delta, not both");
  if (!tangent) tangent = other;
  MeasuredModuli moduli;
  if (storage || !tangent) moduli.storage = measured_numbers(table, table.needed("storage_modulus"), "Pa", positive);
  if (loss || !tangent || !storage)
    moduli.loss = measured_numbers(table, table.needed("loss_modulus"), "Pa", loss_range, rule);
  if (storage && loss) return moduli;
  const std::vector<double> tangents =
      measured_numbers(table, *tangent, "1", storage ? loss_range : positive, storage ? rule : std::string());
  auto& missing = storage ? moduli.loss : moduli.storage;
  for (std::size_t row = 0; row < table.rows(); ++row)
    missing.push_back(storage ? moduli.storage[row] * tangents[row] : moduli.loss[row] / tangents[row]);
  return moduli;
}

Json read_master_curve(const std::filesystem::path& file, const std::vector<std::string>& ignored) {
  MeasuredTable table = read_measured_table(file);
  table.leave_out(ignored);
  table.refuse_others(modulus_columns);
  Json lists;
  lists["frequencies"] = measured_frequencies(table);
  const MeasuredModuli moduli =
      measured_moduli(table, not_negative, not_negative.rule() + ": no passive material gives energy back");
  lists["storage_moduli"] = moduli.storage;
  lists["loss_moduli"] = moduli.loss;
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
  const std::vector<std::string> ignored = names_or_none(object, std::string(ignored_columns_key), place);
  Json complete = Json::object();
  for (const auto& [other, value] : object.items())
    if (other == key)
      complete.update(read_master_curve(folder / name.get<std::string>(), ignored));
    else if (other != ignored_columns_key)
      complete[other] = value;
  return complete;
}

}  // namespace rollres
