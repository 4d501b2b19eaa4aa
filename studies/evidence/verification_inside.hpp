#pragma once

/// Checks of the inside of the layers.

#include "studies/evidence/verification_checks.hpp"

namespace rollres::verification {

void check_inside_cylinder(Checks& checks);
void check_inside_sphere(Checks& checks);

}  // namespace rollres::verification
