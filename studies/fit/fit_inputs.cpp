#include "studies/fit/fit_inputs.hpp"

#include "studies/scene_io/scene_inputs.hpp"

namespace rollres {

namespace {

constexpr const char* angular_frequency = "angular_frequency";

}  // namespace

std::vector<FitInputRecord> measured_inputs(const FitFile& file) {
  std::vector<FitInputRecord> inputs;
  for (std::size_t i = 0; i < file.scenes.size(); ++i) {
    const auto datum = static_cast<std::int64_t>(i + 1);
    const MeasuredScene& row = file.scenes[i];
    for (const std::string& key : file.varying) {
      const InputKind& kind = *find_input(key);
      const bool acts = !is_of_material(row.output) || key == "temperature";  // on a modulus nothing of the scene does
      if (kind.real() && acts)
        inputs.push_back(
            {datum, key, std::string(kind.quantity.unit_for(file.indenter())), real_input(row.scene, key)});
    }
    if (is_curve(row.output))
      inputs.push_back({datum, "time", "s", row.time});
    else if (is_of_material(row.output))
      inputs.push_back({datum, angular_frequency, "rad/s", row.angular_frequency});
  }
  return inputs;
}

std::vector<FitInputRecord> measured_inputs(const MaterialFile& file) {
  std::vector<FitInputRecord> inputs;
  std::int64_t datum = 0;
  for (const MeasuredModulus& row : file.data)
    for (int modulus = 0; modulus < 2; ++modulus) {
      inputs.push_back({++datum, angular_frequency, "rad/s", row.angular_frequency});
      inputs.push_back({datum, "temperature", "K", row.temperature});
    }
  return inputs;
}

std::vector<FitInputRecord> measured_inputs(const ShiftFile& file) {
  std::vector<FitInputRecord> inputs;
  for (const MeasuredShift& row : file.data)
    inputs.push_back({std::ssize(inputs) + 1, "temperature", "K", row.temperature});
  return inputs;
}

std::vector<FitInputRecord> measured_inputs(const StrainFile& file) {
  std::vector<FitInputRecord> inputs;
  for (const MeasuredStrain& row : file.data)
    for (int modulus = 0; modulus < 2; ++modulus)
      inputs.push_back({std::ssize(inputs) + 1, "strain_amplitude", "1", row.amplitude});
  return inputs;
}

}  // namespace rollres
