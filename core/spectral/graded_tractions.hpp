#pragma once

/// What the tractions on a graded grid are and make at any place (core/spectral/README.md, section 9).

#include "core/spectral/graded_grid.hpp"

namespace rollres {

/// Tractions at the nodes of a graded grid.
struct GradedTractions {
  GradedGrid grid;
  Eigen::VectorXd pressure, shear;         // at nodes [Pa]
  Eigen::VectorXd retarded_w, retarded_u;  // slopes by the retarded parts of the half-space, at middles [Pa]
  Eigen::ArrayXd source_x, source_pressure, source_shear;  // places [m] and forces [N/m] of all sources

  static constexpr double judged_from = 3.5;  // of s, inside the last nodes
  static constexpr double too_near = 1e-5;    // half-lengths of the contact

  GradedTractions(const GradedGrid& grid, const Eigen::VectorXd& pressure, const Eigen::VectorXd& shear,
                  const Eigen::VectorXd& retarded_w, const Eigen::VectorXd& retarded_u);

  /// At x, 0 outside the contact [Pa].
  double pressure_at(double x) const { return value_at(pressure, x); }
  double shear_at(double x) const { return value_at(shear, x); }
  /// Slopes of unit modulus by all but layers: half-space at once and retarded, dw/dx and du/dx [Pa].
  Eigen::Array2d near_slopes(const SpectralProblem& problem, double x) const;

  /// Whether x is within so much of s of the last nodes at an end of its zone, or nearer to it than any force could
  /// tell.
  bool near_end(double x, double nearest = judged_from) const;
  /// The least distance from the end of a zone at which it is not [m].
  double nearest_judged() const;

 private:
  Eigen::Array2d slopes_between_nodes(const SpectralProblem& problem, const GradedZone* zone, double x) const;
  double value_at(const Eigen::VectorXd& values, double x) const;
  double half_length() const;
};

}  // namespace rollres
