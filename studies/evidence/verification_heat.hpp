#pragma once

/// Checks of the heat of rolling: closed forms of conduction, the wheel of a prototype, steady states of a narrow peak.

#include "studies/evidence/verification_checks.hpp"

namespace rollres::verification {

void check_heat(Checks& checks);

}  // namespace rollres::verification
