#pragma once

/// A layer's material as charts. The rows of a master curve stand as marks, and what the material does beyond them is
/// dashed: nothing was measured there.

#include <optional>

#include "core/scene/scene.hpp"
#include "studies/drawing/chart.hpp"

namespace rollres {

/// G' and G" against frequency, at the layer's temperature; of a table with the bands that it leaves open.
ChartRequest moduli_chart(const MaterialInputs& layer, const std::string& title);

/// 1/J(t) and G(t) against time, at the layer's temperature.
ChartRequest creep_chart(const MaterialInputs& layer, const std::string& title);

/// What the fit of a measured curve misses at each row, at the table's own temperature.
ChartRequest misfit_chart(const MaterialInputs& layer, const std::string& title);

/// The moduli of relaxation over their times, at the layer's temperature. @param layer  not elastic
ChartRequest spectrum_chart(const MaterialInputs& layer, const std::string& title);

/// Frequency at which the contact asks the layers, V over 2 pi and the half-width of an estimate [Hz]; nothing where
/// none is to be had.
std::optional<double> contact_frequency(const RollingScene& scene);

}  // namespace rollres
