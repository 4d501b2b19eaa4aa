#include "studies/scene_io/usual_names.hpp"

#include <algorithm>
#include <cctype>
#include <initializer_list>

#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

struct UsualNames {
  std::initializer_list<std::string_view> names;  // in small letters
  std::string_view meant;
};

const UsualNames usual_names[] = {
    {{"d_roll"}, "the key is diameter"},
    {{"thickness", "height", "h"}, "the key is layer_thickness"},
    {{"density"}, "the key is layer_density"},
    {{"velocity", "v"}, "the key is speed"},
    {{"force", "weight", "normal_load", "normal_force", "line_load"},
     "the key is load, for a cylinder without a width per metre of it"},
    {{"length", "face_width"}, "the key is width, of a cylinder"},
    {{"mu", "friction", "cof", "coefficient_of_friction"}, "the key is friction_coefficient"},
    {{"nu", "poisson"}, "the key is poisson_ratio"},
    {{"g", "modulus", "shear_modulus"}, "the key is static_shear_modulus, or static_young_modulus: at rest"},
    {{"e", "young", "youngs_modulus", "young_modulus", "elastic_modulus"}, "the key is static_young_modulus: at rest"},
    {{"hardness", "shore"}, "a hardness is no modulus: give static_shear_modulus or static_young_modulus"},
    {{"tau", "viscosity"}, "the key is creep_time, or relaxation_times"},
    {{"tan_delta", "loss_tangent", "loss_factor", "damping"},
     "a loss belongs to its frequency: give frequencies, storage_moduli and loss_moduli, or stiffening and creep_time"},
    {{"prony", "prony_series"}, "the keys are relaxation_times and relaxation_moduli, with material \"prony\""},
    {{"material_file", "dma", "dma_file", "moduli_file"},
     "the key is master_curve_file, with material \"master_curve\""},
    {{"torque"}, "the key is driving_torque, with drive \"torque\""},
    {{"slip", "creepage"}, "the key is rotation_ratio, with drive \"rotation\""},
    {{"coating", "tyre", "tread", "cover"},
     "layers on the body are coating_layers, the track is layer_thickness and its material"},
    {{"layers", "base", "substrate"}, "layers below the first are lower_layers"},
    {{"tyre_thickness", "coating_thickness"}, "the key is layer_thickness of an object in coating_layers"},
};

std::string input_with_symbol(std::string_view symbol) {
  for (const InputKind& kind : input_kinds())
    if (kind.quantity.symbol == symbol) return "the key is " + std::string(kind.quantity.key);
  return "";
}

std::string meant_by(std::string_view key) {
  std::string small(key);
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char letter) { return std::tolower(letter); });
  for (const UsualNames& usual : usual_names)
    if (contains(usual.names, small)) return std::string(usual.meant);
  return input_with_symbol(key);
}

}  // namespace

std::string unknown_input(std::span<const std::string_view> known, std::string_view key) {
  const std::string meant = meant_by(key);
  return meant.empty() ? unknown("unknown key", known, key, "rollres quantities lists the keys")
                       : "unknown key; " + meant;
}

}  // namespace rollres
