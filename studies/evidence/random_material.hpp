#pragma once

/// Random materials with memories over many decades.

#include "core/scene/material_inputs.hpp"
#include "studies/evidence/dice.hpp"

namespace rollres {

/// Gives a layer another material of the same modulus at rest and Poisson's ratio: in half of the cases a Prony series
/// of 5 to 40 terms over 2 to 16 decades (moduli in all 0.1 to 1000 times G0, growing towards short times or not), in a
/// quarter a fractional Zener solid of order 0.1 to 1, else a master curve of 15 to 50 rows over 6 to 12 decades with
/// four digits, or an elastic solid. One in four has a temperature and a law of shift.
/// @param contact_time  half-width over speed, within the decades of memories [s]
void draw_material(Dice& dice, double contact_time, MaterialInputs& layer);

}  // namespace rollres
