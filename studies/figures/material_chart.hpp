#pragma once

/// A layer's material as charts. The rows of a master curve stand as marks, and what the material does beyond them is
/// dashed: nothing was measured there.

#include "core/scene/material_inputs.hpp"
#include "studies/drawing/chart.hpp"

namespace rollres {

/// G' and G" against frequency, at the layer's temperature.
ChartRequest moduli_chart(const MaterialInputs& layer, const std::string& title);

/// 1/J(t) and G(t) against time, at the layer's temperature.
ChartRequest creep_chart(const MaterialInputs& layer, const std::string& title);

}  // namespace rollres
