#pragma once

/// A measured master curve as a Prony series: a non-negative fit, smooth where the table is silent.
///
/// Relaxation times are laid evenly over the measured band and a little beyond. The moduli are the non-negative ones
/// that minimise the relative misfit of G' and G" in all rows and, with a weight, the bends of the spectrum. It is the
/// least weight with which the loss tangent has no wave that the table does not show, as long as the misfit bears it:
/// storage and loss that do not belong together, by the relations of Kramers and Kronig, show as a misfit and not as
/// waves between the rows.
/// @see Honerkamp and Weese (1989), Macromolecules 22, 4372, for the regularised spectrum; Baumgaertel and Winter
///      (1989), Rheologica Acta 28, 511, for discrete spectra and their density

#include <memory>
#include <string>
#include <vector>

#include "core/material/prony_series.hpp"

namespace rollres {

/// Rows in any order; all lists of the same length.
struct MasterCurve {
  std::vector<double> frequencies;    ///< [Hz], > 0
  std::vector<double> storage, loss;  ///< G' > 0, G" >= 0 [Pa]
  double static_modulus = 0;          ///< G'(0) [Pa] where it is known; 0: found by the fit

  bool operator==(const MasterCurve&) const = default;
};

/// The series with what it costs: misfits are |G*_fit - G*| / |G*| at the rows.
struct MasterCurveFit {
  PronySeries series;
  double rms_misfit = 0, largest_misfit = 0;  ///< [1]
  double worst_frequency = 0;                 ///< of the largest misfit [Hz]
  std::vector<std::string> remarks;           ///< on rows out of order, repeated, falling or far off; one line each

  /// "master curve as 27 Prony terms, misfit 0.8 % rms and 2.1 % at most (at 15100 Hz)"
  std::string in_words() const;
};

/// @param curve with at least two different frequencies
MasterCurveFit fit_master_curve(const MasterCurve& curve);

/// The same, from a small cache shared by all threads: a sweep asks for one curve at every point.
std::shared_ptr<const MasterCurveFit> shared_master_curve_fit(const MasterCurve& curve);

}  // namespace rollres
