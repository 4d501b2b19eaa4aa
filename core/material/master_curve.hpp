#pragma once

/// A measured master curve as a Prony series, and how far others may lie from it that meet the table as well.
///
/// Free times: the non-negative moduli of least relative misfit of G' and G" on a dense grid of relaxation times, from
/// a decade below the table to a decade above (few of them are not zero); neighbours joined, times and moduli moved by
/// Gauss-Newton steps to the least misfit, and joined further as long as Akaike's criterion gains by it. The curve of a
/// Prony series without noise gives that series back.
///
/// Where rows are so few that the loss tangent then has waves between them that the table does not show, times are
/// fixed and even, and bends of the spectrum weigh: the least weight without such waves, as long as the misfit bears
/// it. Storage and loss that do not belong together, by the relations of Kramers and Kronig, show as a misfit.
///
/// What is left open: the rows' errors are taken as independent, of the size of the residuals; before the rows the
/// spectrum is the fit's with an error of the order of itself at each of many times, within the table and beyond. Both
/// are normally distributed, and so is then the error of whatever is linear in a small change of the spectrum.
/// @see Honerkamp and Weese (1989), Macromolecules 22, 4372, for the regularised spectrum; Baumgaertel and Winter
///      (1989), Rheologica Acta 28, 511, for free times; Rasmussen and Williams (2006), Gaussian Processes for Machine
///      Learning, chapter 2, for the error

#include <Eigen/Core>
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

/// Changes of the spectrum that the table does not exclude: a modulus more or less at each time, and at rest.
struct OpenSpectrum {
  std::vector<double> times;  ///< [s]; the last infinite (the modulus at rest) where that was not given
  Eigen::MatrixXd spread;     ///< [Pa]: the changes are spread * z, z normal, independent, of deviation 1

  /// Standard deviation of the sum of slopes(j) times the change at times[j].
  double deviation(const Eigen::VectorXd& slopes) const { return (spread.transpose() * slopes).norm(); }
};

/// The series with what it costs: misfits are |G*_fit - G*| / |G*| at the rows.
struct MasterCurveFit {
  PronySeries series;
  double rms_misfit = 0, largest_misfit = 0;  ///< [1]
  double worst_frequency = 0;                 ///< of the largest misfit [Hz]
  OpenSpectrum open;
  std::vector<std::string> remarks;  ///< on rows out of order, repeated, falling or far off; one line each

  /// "master curve as 27 Prony terms, misfit 0.8 % rms and 2.1 % at most (at 15100 Hz)"
  std::string in_words() const;
};

/// @param curve with at least two different frequencies
MasterCurveFit fit_master_curve(const MasterCurve& curve);

/// The same, from a small cache shared by all threads: a sweep asks for one curve at every point.
std::shared_ptr<const MasterCurveFit> shared_master_curve_fit(const MasterCurve& curve);

/// The fit of a layer whose material is a master curve, at the reference temperature.
std::shared_ptr<const MasterCurveFit> shared_master_curve_fit(const MaterialInputs& layer);

}  // namespace rollres
