#pragma once

/// A master curve by few terms of free times.
///
/// The non-negative moduli of least relative misfit on a dense grid of relaxation times, from a decade below the table
/// to a decade above (few of them are not zero); neighbours joined, times and moduli moved by steps of Levenberg and
/// Marquardt to the least misfit, and joined further as long as Schwarz's criterion gains by it.
/// @see Baumgaertel and Winter (1989), Rheologica Acta 28, 511; Schwarz (1978), Annals of Statistics 6, 461

#include "core/material/open_spectrum.hpp"
#include "core/material/relative_rows.hpp"

namespace rollres {

/// @param wanted_evidence without a chance to come near it, the search ends before terms are joined
SpectrumFit free_series(const RelativeRows& rows, double wanted_evidence);

}  // namespace rollres
