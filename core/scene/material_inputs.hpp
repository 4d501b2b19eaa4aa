#pragma once

/// Inputs of a layer's material, as a plain value.

#include <optional>
#include <span>
#include <vector>

#include "core/scene/listed_quantities.hpp"
#include "core/scene/quantity.hpp"

namespace rollres {

enum class MaterialModel {
  zener,             ///< G0, f, tau: one exponential
  elastic,           ///< G0
  prony,             ///< G0 and a list of relaxation times and moduli (generalised Maxwell solid)
  fractional_zener,  ///< G0, f, tau and the order of its spring-pot
  master_curve,      ///< a table of storage and loss moduli
  relaxation_curve   ///< a table of relaxation moduli G(t) at relaxation_times, to which a Prony series is fitted
};
template <>
struct ChoiceNames<MaterialModel> {
  static constexpr std::array<std::string_view, 6> names{"zener",        "elastic",         "prony", "fractional_zener",
                                                         "master_curve", "relaxation_curve"};
};

/// What the moduli in a layer's lists are: G, or E = 2 (1 + nu) G.
enum class ListedModuli { shear, young };
template <>
struct ChoiceNames<ListedModuli> {
  static constexpr std::array<std::string_view, 2> names{"shear", "young"};
};

/// How the strains of a strain sweep were applied.
enum class SweepDeformation {
  shear,   ///< simple shear
  tension  ///< uniaxial: a strain e counts as the shear 2 (1 + nu)/sqrt(3) e of the same distortion
};
template <>
struct ChoiceNames<SweepDeformation> {
  static constexpr std::array<std::string_view, 2> names{"shear", "tension"};
};

/// What the strains of a strain sweep are: amplitudes, or twice that.
enum class SweepAmplitude { peak, peak_to_peak };
template <>
struct ChoiceNames<SweepAmplitude> {
  static constexpr std::array<std::string_view, 2> names{"peak", "peak_to_peak"};
};

/// Base of a scene and of whatever else has a layer's material. What the model does not need is ignored.
struct MaterialInputs {
  double poisson_ratio = 0.5;  // nu [1]
  MaterialModel material = MaterialModel::zener;
  std::optional<double> static_shear_modulus;  // G0 = G'(0) [Pa]; this or
  std::optional<double> static_young_modulus;  // E0 = 2 (1 + nu) G0 [Pa]; a master curve needs neither
  double stiffening = 0;                       // f = G'(infinity)/G'(0) - 1 [1]
  double creep_time = 0;                       // tau [s]
  double fractional_order = 1;                 // [1]
  std::vector<double> relaxation_times;        // [s], of a Prony series, or of the rows of a relaxation curve
  std::vector<double> relaxation_moduli;       // [Pa], as many
  std::vector<double> frequencies;             // [Hz], of a master curve, at the reference temperature
  std::vector<double> storage_moduli;          // G' or E' [Pa], as many
  std::vector<double> loss_moduli;             // G" or E" [Pa], as many
  ListedModuli listed_moduli = ListedModuli::shear;
  std::optional<double> temperature;             // [K]; all times above are those at
  std::optional<double> reference_temperature;   // [K]
  std::optional<double> wlf_c1, wlf_c2;          // [1], [K]; the shift law, or
  std::optional<double> activation_energy;       // [J/mol], or
  std::optional<double> vft_b, vft_temperature;  // [K], [K], or
  std::vector<double> shift_temperatures;        // [K], of a table of
  std::vector<double> shift_factors;             // a_T [1], as many, and
  std::vector<double> modulus_shifts;            // b_T [1], as many or none; beside any law
  double payne_drop = 0;                         // of G' with the strain amplitude, over G' [1]; Kraus's model, or
  std::optional<double> payne_strain;            // amplitude of half the drop [1]
  double payne_exponent = 0.6;                   // m [1]
  double payne_loss_peak = 1;                    // G" at payne_strain over that at small strains [1]
  std::vector<double> sweep_strains;             // [1], of a strain sweep
  std::vector<double> sweep_storage_moduli;      // [Pa], as many
  std::vector<double> sweep_loss_moduli;         // [Pa], as many
  SweepDeformation sweep_deformation = SweepDeformation::shear;
  SweepAmplitude sweep_amplitude = SweepAmplitude::peak;
  double yeoh_second = 0, yeoh_third = 0;  // C20/C10 and C30/C10 of Yeoh's energy, C10 = G0/2 [1]

  bool operator==(const MaterialInputs&) const = default;
};

/// The inputs of a layer's material, in the order in which all walk them.
using MaterialInput = ListedQuantity<MaterialInputs, double, std::optional<double>, std::vector<double>, MaterialModel,
                                     ListedModuli, SweepDeformation, SweepAmplitude>;
std::span<const MaterialInput> listed_material_inputs();

/// Walks them as `visit_inputs` does those of a scene; a list is a std::vector<double>, its quantity and range those of
/// each value.
template <class Inputs, class Visitor>
void visit_material_inputs(Inputs& layer, Visitor&& visitor) {
  visit_listed(layer, listed_material_inputs(), visitor);
}

/// The inputs that a material cannot do without, beside the modulus at rest.
std::vector<std::string_view> needed_inputs(MaterialModel material);

/// Whether a material is a table of measured values that a Prony series is fitted to.
inline bool is_measured_curve(MaterialModel material) {
  return material == MaterialModel::master_curve || material == MaterialModel::relaxation_curve;
}

/// Whether a material needs static_shear_modulus or static_young_modulus.
inline bool needs_static_modulus(MaterialModel material) { return !is_measured_curve(material); }

/// Whether a shift law, or a table of a_T or b_T, says what the temperature does.
bool has_shift(const MaterialInputs& layer);

/// Every rule that the inputs break together, each as one line "key = value: rule"; ranges are left to the caller.
std::vector<std::string> check_material(const MaterialInputs& layer);

}  // namespace rollres
