#pragma once

/// A master curve by a smooth spectrum: the logarithms of moduli at even times, whose bends weigh.
///
/// Least |residuals|^2 + weight |d2 ln g / d(decades)2|^2, by steps of Levenberg and Marquardt, the weight the one on
/// which the rows are most likely (MacKay 1992, Neural Computation 4, 415), or less as long as that is nearly so. By
/// the logarithms moduli are positive and their errors relative; a spectrum that falls steeply needs no bends. What it
/// leaves open between many rows is told with next to no weight: single terms may hide there.

#include "core/material/open_spectrum.hpp"
#include "core/material/relative_rows.hpp"

namespace rollres {

SpectrumFit smooth_spectrum(const RelativeRows& rows);

}  // namespace rollres
