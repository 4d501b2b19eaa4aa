#pragma once

/// A measured master curve as a Prony series, and how far others may lie from it that meet the table as well.
///
/// Two kinds of spectra are fitted, both by the relative misfit of G' and of G" at the rows:
///  - few terms of free times (free_series.hpp): the curve of a Prony series without noise gives that series back;
///  - a smooth spectrum (smooth_spectrum.hpp): no more bends of its logarithm than the rows ask for.
/// The one is taken on which the rows are more likely (Bayes' factor), with an advantage for few terms.
///
/// What is left open: the rows' errors are taken as of the size of the residuals at like frequencies, and as
/// independent but for what the residuals of neighbours have in common (row_noise.hpp); the error of whatever is linear
/// in a small change of the spectrum is then normally distributed. Storage and loss that do not belong together, by the
/// relations of Kramers and Kronig, are residuals of any spectrum and widen it. Where the other kind of spectrum is
/// about as likely, the difference of the two is open as well.
/// @see Honerkamp and Weese (1989), Macromolecules 22, 4372, for the regularised spectrum; Baumgaertel and Winter
///      (1989), Rheologica Acta 28, 511, for free times; MacKay (1992), Neural Computation 4, 415, for Bayes' factor
///      and the weight of smoothness

#include <memory>
#include <string>
#include <vector>

#include "core/material/open_spectrum.hpp"
#include "core/material/prony_series.hpp"
#include "core/scene/material_inputs.hpp"

namespace rollres {

/// Rows in any order; all lists of the same length. A table of relaxation has no loss: its storage is G(t) at the times
/// t = 1/(2 pi frequency).
struct MasterCurve {
  std::vector<double> frequencies;    ///< [Hz], > 0
  std::vector<double> storage, loss;  ///< G' > 0, G" >= 0 [Pa]; or G(t) > 0, and none
  double static_modulus = 0;          ///< G'(0) [Pa] where it is known; 0: found by the fit

  bool is_relaxation() const { return loss.empty(); }
  bool operator==(const MasterCurve&) const = default;
};

/// The series with what it costs: misfits are |G*_fit - G*| / |G*| at the rows, of G(t) where that is measured.
struct MasterCurveFit {
  PronySeries series;
  double rms_misfit = 0, largest_misfit = 0;  ///< [1]
  double worst_frequency = 0;                 ///< of the largest misfit [Hz]
  bool is_relaxation = false;                 ///< what the rows are
  OpenSpectrum open;
  std::vector<std::string> remarks;  ///< on rows out of order, repeated, falling or far off; one line each

  /// "master curve as 27 Prony terms, misfit 0.8 % rms and 2.1 % at most (at 15100 Hz)"
  std::string in_words() const;
};

/// Places of the rows, by frequency.
std::vector<std::size_t> rows_in_order(const MasterCurve& curve);

/// |G*_series - G*| / |G*| of each row [1].
std::vector<double> relative_misfits(const MasterCurve& curve, const PronySeries& series);

/// @param curve with at least two different frequencies
MasterCurveFit fit_master_curve(const MasterCurve& curve);

/// The same, from a small cache shared by all threads: a sweep asks for one curve at every point.
std::shared_ptr<const MasterCurveFit> shared_master_curve_fit(const MasterCurve& curve);

/// The rows of a layer whose material is_measured_curve, in shear, at the reference temperature.
MasterCurve measured_curve(const MaterialInputs& layer);

/// Their fit.
std::shared_ptr<const MasterCurveFit> shared_master_curve_fit(const MaterialInputs& layer);

}  // namespace rollres
