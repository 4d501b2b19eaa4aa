#include "studies/fit/strain_file.hpp"

#include <stdexcept>

#include "core/material/strain_softening.hpp"
#include "db/file/digest.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/text/measured_table.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

namespace {

/// The shear strain of one listed strain [1].
double shear_per_listed(const Json& object, const std::string& scene, const std::string& place) {
  MaterialInputs layer;
  layer.sweep_deformation = choice_or_first<SweepDeformation>(object, "sweep_deformation", place);
  layer.sweep_amplitude = choice_or_first<SweepAmplitude>(object, "sweep_amplitude", place);
  layer.poisson_ratio = 0.5;
  if (!scene.empty())
    if (const Json inputs = Json::parse(scene); inputs.contains("poisson_ratio") && inputs["poisson_ratio"].is_number())
      layer.poisson_ratio = inputs["poisson_ratio"].get<double>();
  layer.sweep_strains = {1};
  return largest_measured_strain(layer).value();
}

/// @throws std::invalid_argument if the column has more than one value
void require_one_value(const MeasuredTable& table, std::string_view name, std::string_view unit) {
  const MeasuredColumn* const column = table.find(name);
  for (std::size_t row = 1; column && row < table.rows(); ++row)
    if (measured_number(table, *column, row, unit) != measured_number(table, *column, 0, unit))
      throw std::invalid_argument(table.place(row) + ": " + heading(*column) + " = " + column->cells[row] +
                                  ": must be the same in all rows: a strain sweep is made at one frequency and "
                                  "temperature");
}

}  // namespace

StrainFile read_strain_fit(const std::filesystem::path& file) {
  const std::string place = file.string();
  const Json object = read_object(place);
  StrainFile fit{given_name(object, strain_fit_keys, place)};
  fit.options = given_descents(object, place);
  fit.scene = given_scene(object, file, place);
  const double shear = shear_per_listed(object, fit.scene, place);
  const ModulusSigmas sigma = given_modulus_sigmas(object, place);
  fit.deviations_known = sigma.known;

  const std::string name = needed_text(object, "data", place, "must be the name of a CSV file");
  MeasuredTable table = read_measured_table(file.parent_path() / name);
  fit.data_digest = digest(table.text);
  fit.notes.push_back(table.in_words());
  table.leave_out(names_or_none(object, std::string(ignored_columns_key), place));
  take_modulus_names(table);  // of shear or Young's: only their ratios count
  std::vector<std::string_view> known(modulus_columns.begin(), modulus_columns.end());
  known.insert(known.end(), {"strain", "temperature"});
  note_left_out(fit, object, table.leave_out_others(known));
  require_one_value(table, "frequency", "Hz");
  require_one_value(table, "angular_frequency", "rad/s");
  require_one_value(table, "temperature", "K");
  const std::vector<double> strains = measured_numbers(table, table.needed("strain"), "1", positive);
  const auto [storage, loss] = measured_moduli(table, positive);
  for (std::size_t row = 0; row < table.rows(); ++row)
    fit.data.push_back({.amplitude = shear * strains[row],
                        .storage = storage[row],
                        .loss = loss[row],
                        .storage_deviation = sigma.storage * storage[row],
                        .loss_deviation = sigma.loss * loss[row],
                        .place = table.place(row)});
  fit.notes.emplace_back(
      "storage_modulus and loss_modulus are those of the table at small strains; payne_strain is a "
      "shear strain amplitude");
  return fit;
}

}  // namespace rollres
