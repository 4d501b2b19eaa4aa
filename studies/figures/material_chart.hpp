#pragma once

/// A layer's material as charts. The rows of a master curve stand as marks, and what the material does beyond them is
/// dashed: nothing was measured there.

#include <optional>

#include "core/estimate/composite_estimate.hpp"
#include "core/scene/scene.hpp"
#include "studies/drawing/chart.hpp"

namespace rollres {

/// At which frequencies a scene's contact asks its layers, by an estimate of it.
struct ContactFrequencies {
  double typical;                ///< V over 2 pi and the half-width [Hz]
  std::optional<LossBand> band;  ///< where 80 % of the power is lost; nothing of elastic layers

  /// "about 194 Hz; 80 % of the power is lost between 105 and 501 Hz"
  std::string in_words() const;
};
/// Nothing where no estimate is to be had.
std::optional<ContactFrequencies> contact_frequencies(const RollingScene& scene);

/// G' and G" against frequency, at the layer's temperature; of a table with the bands that it leaves open.
/// @param contact  of the scene, shaded
ChartRequest moduli_chart(const MaterialInputs& layer, const std::string& title,
                          const std::optional<ContactFrequencies>& contact = {});

/// 1/J(t) and G(t) against time, at the layer's temperature.
ChartRequest creep_chart(const MaterialInputs& layer, const std::string& title);

/// What the fit of a measured curve misses at each row, at the table's own temperature.
ChartRequest misfit_chart(const MaterialInputs& layer, const std::string& title);

/// The moduli of relaxation over their times, at the layer's temperature. @param layer  not elastic
ChartRequest spectrum_chart(const MaterialInputs& layer, const std::string& title);

/// Whether a law or a table shifts the layer's times by its temperature.
bool shifts_times(const MaterialInputs& layer);

/// a_T against temperature, with the rows of a table and the layer's own temperature. @param layer  one that
/// shifts_times
ChartRequest shift_chart(const MaterialInputs& layer, const std::string& title);

}  // namespace rollres
