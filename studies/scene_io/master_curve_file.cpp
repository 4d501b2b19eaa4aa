#include "studies/scene_io/master_curve_file.hpp"

#include <numbers>
#include <stdexcept>

#include "studies/text/measured_table.hpp"

namespace rollres {

namespace {

const MeasuredColumn& column_of(const MeasuredTable& table, std::string_view name) {
  const MeasuredColumn* const column = table.find(name);
  if (!column) throw std::invalid_argument(table.file + ": has no column " + std::string(name));
  return *column;
}

Json numbers_in(const MeasuredTable& table, const MeasuredColumn& column, std::string_view unit, double factor,
                const Range& range, const std::string& rule) {
  Json numbers = Json::array();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double number = measured_number(table, column, row, unit);
    if (!range.contains(factor * number))
      throw std::invalid_argument(table.place(row) + ": " + heading(column) + " = " + column.cells[row] + ": " + rule);
    numbers.push_back(factor * number);
  }
  return numbers;
}

}  // namespace

Json read_master_curve(const std::filesystem::path& file) {
  const MeasuredTable table = read_measured_table(file);
  constexpr std::string_view known[] = {"frequency", "angular_frequency", "storage_modulus", "loss_modulus", "note"};
  for (const MeasuredColumn& column : table.columns)
    if (find_name(known, column.name) < 0)
      throw std::invalid_argument(table.file + ": " + column.name + ": " +
                                  unknown("unknown column", known, column.name));
  const MeasuredColumn* const turns = table.find("frequency");
  const MeasuredColumn* const radians = table.find("angular_frequency");
  if (turns && radians) throw std::invalid_argument(table.file + ": give frequency or angular_frequency, not both");
  const std::string frequency_rule = frequency_range.rule() + " Hz";
  Json lists;
  lists["frequencies"] =
      radians ? numbers_in(table, *radians, "rad/s", 0.5 / std::numbers::pi, frequency_range, frequency_rule)
              : numbers_in(table, column_of(table, "frequency"), "Hz", 1, frequency_range, frequency_rule);
  lists["storage_moduli"] = numbers_in(table, column_of(table, "storage_modulus"), "Pa", 1, positive, positive.rule());
  lists["loss_moduli"] = numbers_in(table, column_of(table, "loss_modulus"), "Pa", 1, not_negative,
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
