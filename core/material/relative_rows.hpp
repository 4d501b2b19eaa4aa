#pragma once

/// A master curve's rows as equations of one weight each, linear in the moduli of given relaxation times.
///
/// Residuals are relative, of the storage moduli first and then of the loss moduli: rolling resistance follows the
/// loss, so that a percent of it weighs as much as one of the storage, however small the loss tangent is (down to
/// noticeable_tangent, less than which counts as so much). Those of a table of relaxation are of G(t), at the
/// frequencies 1/t. Those of a table of creep are of J(t): what is said of moduli then holds of the compliances of
/// retardation times, and what is at rest is the creep at once.

#include <Eigen/Core>
#include <vector>

#include "core/material/master_curve.hpp"

namespace rollres {

class RelativeRows {
 public:
  /// All rows equally certain.
  /// @param curve with at least two different frequencies
  explicit RelativeRows(const MasterCurve& curve);

  /// @param times [s], compliances [1/Pa]  positive, of the same length
  static RelativeRows of_creep(const std::vector<double>& times, const std::vector<double>& compliances);

  /// The same rows with deviations of their errors over the usual one, one for each equation.
  RelativeRows with_noise(const Eigen::VectorXd& noise) const;

  Eigen::Index rows() const { return omega_.size(); }
  const Eigen::VectorXd& frequencies() const { return omega_; }         ///< of the rows as they came [rad/s]
  const std::vector<Eigen::Index>& in_order() const { return order_; }  ///< by ascending frequencies
  /// Of G' and of G", or of G(t): once or twice the rows.
  Eigen::Index equations() const { return wanted_.size(); }
  double lowest() const { return omega_.minCoeff(); }   ///< [rad/s]
  double highest() const { return omega_.maxCoeff(); }  ///< [rad/s]
  double decades() const;                               ///< of the table

  /// Whether the modulus at rest is not given; it is then least_rest() and more.
  bool free_rest() const { return free_rest_; }
  double least_rest() const { return rest_; }  ///< [Pa]

  /// What a modulus of 1 Pa at each time adds, the last column being at rest where that is free.
  Eigen::MatrixXd responses(const std::vector<double>& times) const;
  /// Its derivative with respect to the logarithm of each time, without the last column.
  Eigen::MatrixXd slopes(const std::vector<double>& times) const;
  /// What these have to meet: the rows without the least modulus at rest.
  Eigen::VectorXd wanted() const;

  Eigen::VectorXd residuals(const PronySeries& series) const;

  /// The loss modulus at the frequency omega, interpolated in logarithms, beyond the table that of its end [Pa].
  double loss_at(double omega) const;

 private:
  Eigen::VectorXd omega_, wanted_, loss_, noise_;
  Eigen::VectorXd size_;  // what a residual of 1 is, for usual noise
  enum class Kind { moduli, relaxation, creep } kind_;
  std::vector<Eigen::Index> order_;  // of ascending frequencies
  double rest_;
  bool free_rest_;

  RelativeRows(const MasterCurve& curve, Kind kind);
  /// About G"(1/t) = (pi/2) |dG/d ln t|, and likewise of J.
  Eigen::VectorXd loss_over_time() const;
};

/// The non-negative moduli of least misfit at fixed times, the last at rest where that is free [Pa].
Eigen::VectorXd nonnegative_moduli(const RelativeRows& rows, const std::vector<double>& times);

/// A series' parameters and the rows' derivatives with respect to their logarithms.
struct TermSlopes {
  std::vector<double> times;  ///< [s]
  Eigen::VectorXd moduli;     ///< [Pa], the last at rest where that is free
  Eigen::MatrixXd slopes;     ///< columns: of the moduli, then of the times

  TermSlopes(const RelativeRows& rows, const PronySeries& series);
};

}  // namespace rollres
