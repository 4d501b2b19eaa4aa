#pragma once

/// Inputs of a layer's material, as a plain value.

#include <optional>
#include <vector>

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

/// Walks the inputs of a layer's material as `visit_inputs` does those of a scene; a list is a std::vector<double>,
/// its quantity and range those of each value.
template <class Inputs, class Visitor>
void visit_material_inputs(Inputs& layer, Visitor&& visitor) {
  using Q = Quantity;
  visitor(Q{"poisson_ratio", "ν", "1", "Poisson's ratio of the layer", {.lowest = 0.0, .highest = 0.5}},
          layer.poisson_ratio);
  visitor(Q{"material", "", "", "model of the layer's material"}, layer.material);
  visitor(Q{"static_shear_modulus", "G0", "Pa", "shear modulus at rest, G'(0)", positive}, layer.static_shear_modulus);
  visitor(Q{"static_young_modulus", "E0", "Pa", "Young's modulus at rest, 2 (1 + ν) G0, in place of G0", positive},
          layer.static_young_modulus);
  visitor(Q{"stiffening", "f", "1", "G'(∞)/G'(0) - 1", not_negative}, layer.stiffening);
  visitor(Q{"creep_time", "τ", "s", "creep (retardation) time", not_negative}, layer.creep_time);
  visitor(Q{"fractional_order",
            "",
            "1",
            "order of the spring-pot of a fractional Zener solid; 1: a dashpot",
            {.lowest = 0.0, .highest = 1.0, .lowest_excluded = true}},
          layer.fractional_order);
  visitor(Q{"relaxation_times", "τ_j", "s", "relaxation times of a Prony series; times of a relaxation_curve's rows",
            positive},
          layer.relaxation_times);
  visitor(Q{"relaxation_moduli", "g_j", "Pa",
            "moduli of a Prony series, G(t) = G0 + Σ g_j e^(-t/τ_j); G(t) of a relaxation_curve", not_negative},
          layer.relaxation_moduli);
  visitor(Q{"frequencies", "", "Hz", "frequencies of a master curve", positive}, layer.frequencies);
  visitor(Q{"storage_moduli", "G'", "Pa", "storage moduli of a master curve", positive}, layer.storage_moduli);
  visitor(Q{"loss_moduli", "G\"", "Pa", "loss moduli of a master curve", not_negative}, layer.loss_moduli);
  visitor(Q{"listed_moduli", "", "", "what the moduli in lists are: G, or E = 2 (1 + ν) G"}, layer.listed_moduli);
  visitor(Q{"temperature", "", "K", "temperature of the layer; shifts all its times by the shift law", positive},
          layer.temperature);
  visitor(Q{"reference_temperature", "", "K", "temperature at which the material was given", positive},
          layer.reference_temperature);
  visitor(Q{"wlf_c1", "c1", "1", "of the shift law log10 a = -c1 (T - T_ref)/(c2 + T - T_ref)", positive},
          layer.wlf_c1);
  visitor(Q{"wlf_c2", "c2", "K", "of the same law (Williams, Landel and Ferry)", positive}, layer.wlf_c2);
  visitor(Q{"activation_energy", "", "J/mol", "of the shift law ln a = E_a/R (1/T - 1/T_ref) (Arrhenius)", positive},
          layer.activation_energy);
  visitor(Q{"vft_b", "B", "K", "of the shift law ln a = B/(T - T∞) - B/(T_ref - T∞)", positive}, layer.vft_b);
  visitor(Q{"vft_temperature", "T∞", "K", "of the same law (Vogel, Fulcher and Tammann)", positive},
          layer.vft_temperature);
  visitor(Q{"shift_temperatures", "", "K", "temperatures of a table of shifts", positive}, layer.shift_temperatures);
  visitor(Q{"shift_factors", "a_T", "1", "times at these temperatures over those at T_ref", positive},
          layer.shift_factors);
  visitor(
      Q{"modulus_shifts", "b_T", "1", "moduli at T_ref over those at these temperatures, at shifted times", positive},
      layer.modulus_shifts);
  visitor(Q{"payne_drop",
            "",
            "1",
            "share of G' that large strains take (Kraus): G'/G'lin = 1 - drop r/(1 + r), r = (γ/payne_strain)^(2m)",
            {.lowest = 0.0, .highest = 0.99}},
          layer.payne_drop);
  visitor(Q{"payne_strain", "γ_c", "1", "shear strain amplitude at which half of payne_drop is gone", positive},
          layer.payne_strain);
  visitor(Q{"payne_exponent",
            "m",
            "1",
            "exponent of the same law",
            {.lowest = 0.0, .highest = 5.0, .lowest_excluded = true}},
          layer.payne_exponent);
  visitor(Q{"payne_loss_peak",
            "",
            "1",
            "G\" at payne_strain over that at small strains: G\"/G\"lin = 1 + 2 (peak - 1) sqrt(r)/(1 + r)",
            {.lowest = 0.01, .highest = 100.0}},
          layer.payne_loss_peak);
  visitor(Q{"sweep_strains", "", "1", "strain amplitudes of a strain sweep", positive}, layer.sweep_strains);
  visitor(Q{"sweep_storage_moduli", "", "Pa", "storage moduli of a strain sweep, relative to the first", positive},
          layer.sweep_storage_moduli);
  visitor(Q{"sweep_loss_moduli", "", "Pa", "loss moduli of a strain sweep, relative to the first", positive},
          layer.sweep_loss_moduli);
  visitor(Q{"sweep_deformation", "", "", "how the strains of the sweep were applied"}, layer.sweep_deformation);
  visitor(Q{"sweep_amplitude", "", "", "what the strains of the sweep are: peak, or peak to peak"},
          layer.sweep_amplitude);
  visitor(Q{"yeoh_second", "c_2", "1",
            "finite_strain: C20/C10 of Yeoh's energy C10 (I - 3) + C20 (I - 3)² + C30 (I - 3)³, C10 = G/2"},
          layer.yeoh_second);
  visitor(
      Q{"yeoh_third", "c_3", "1", "C30/C10 of the same; above 0.6 yeoh_second² where that is negative", not_negative},
      layer.yeoh_third);
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
