#pragma once

/// What the rows of a master curve leave open of its spectrum of relaxation.

#include <Eigen/Core>
#include <vector>

#include "core/material/prony_series.hpp"

namespace rollres {

class RelativeRows;

/// Changes of the spectrum that the table does not exclude: a modulus more or less at each time, and at rest.
struct OpenSpectrum {
  std::vector<double> times;  ///< [s]; infinite: the modulus at rest
  Eigen::MatrixXd spread;     ///< [Pa]: the changes are spread * z, z normal, independent, of deviation 1

  /// Standard deviation of the sum of slopes(j) times the change at times[j].
  double deviation(const Eigen::VectorXd& slopes) const { return (spread.transpose() * slopes).norm(); }

  /// Adds changes that are independent of those here.
  void add(const OpenSpectrum& other);
};

/// A series that meets the rows, what it leaves open, and how likely the rows are on all series of its kind: the
/// logarithm of that probability, by Laplace's approximation about the best one.
struct SpectrumFit {
  PronySeries series;
  OpenSpectrum open;
  double evidence = 0;
};

/// What rows with independent errors leave open of moduli and times of few terms (Gauss and Newton), and of terms that
/// may be missed among and beyond them.
OpenSpectrum open_beside_terms(const RelativeRows& rows, const PronySeries& series);

/// Another fit in place of the best: their difference, as likely as that one is the true one.
/// @param odds ratio of the other's probability to the best's
OpenSpectrum open_between(const PronySeries& best, const PronySeries& other, double odds);

}  // namespace rollres
