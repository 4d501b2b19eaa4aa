#pragma once

/// The material of a scene's layer as a Prony series in shear, in the input of other programs.
///
/// The series is the material's at its reference temperature, with WLF's constants (VFT's law is WLF's with others); by
/// any other law, and with b_T, it is that at the scene's temperature, and a comment says so. G and K relax alike, as
/// poisson_ratio is constant; above 0.4995 it is written as that, for which programs need no special elements.
///
/// - abaqus: moduli at once, g_i = k_i = G_i/G(0) and times (*VISCOELASTIC, TIME=PRONY); *TRS has T0, C1, C2 of
///   -log10 A = C1 (T - T0)/(C2 + T - T0) with the reduced time t/A: Abaqus Analysis User's Guide, section "Time domain
///   viscoelasticity".
/// - ansys: Young's modulus at once, shares of shear and bulk and times in pairs (TB,PRONY), T0, C1, C2
/// (TB,SHIFT,,,,WLF):
///   Ansys Mechanical APDL Material Reference, section "Viscoelasticity".
/// - comsol: number of the branch, its shear modulus, its relaxation time, in a file as the table of branches loads it;
///   the shear modulus at rest and the shift in comments: COMSOL Structural Mechanics Module User's Guide, section
///   "Viscoelasticity".
/// - prony_csv: time and modulus of each term, in a comment the modulus at rest and the shift.
/// - scene: the scene with the material `prony` in place of its own, and its shift as it is.
///
/// SI units and kelvins everywhere.

#include <array>
#include <string>
#include <string_view>

#include "core/scene/scene.hpp"

namespace rollres {

inline constexpr std::array<std::string_view, 5> material_export_formats{"abaqus", "ansys", "comsol", "prony_csv",
                                                                         "scene"};

/// @param layer  as layer_of takes it   @param format one of those
std::string exported_material(RollingScene scene, std::string_view layer, std::string_view format);

}  // namespace rollres
