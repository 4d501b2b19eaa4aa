#pragma once

/// The fit of a Prony series whose terms are known but for their moduli, or nearly so: a spectrum at fixed times holds
/// free shifts to places at which its ripples meet the data's.

#include <vector>

#include "fitting/material/material_fit.hpp"

namespace rollres {

inline constexpr Quantity relaxation_time{"time", "τ", "s", "a relaxation time", positive};

/// What is known of rows and times before a fit of moduli.
struct KnownOfSeries {
  double deviation = 0;                   ///< of the rows, in theirs; 0: nothing is known
  SeriesTimes times = SeriesTimes::even;  ///< free: each is fitted, too, known to 0.3 of the way to the next
};

/// The fit of the moduli of these terms; free shifts are looked for among even steps (even_steps).
MaterialFit fit_moduli(const std::vector<MeasuredModulus>& data, const PronySeries& series,
                       const MaterialFitOptions& options, const KnownOfSeries& known);

}  // namespace rollres
