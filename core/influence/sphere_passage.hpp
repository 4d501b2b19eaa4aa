#pragma once

/// Influence coefficients of a sphere in a single passage over any layers, with inertia or without: each retardation
/// time's response is that of an elastic surface (directional_expansion.hpp), a half-space's in closed form plus a
/// smooth correction from tables, with an exponential memory (core/influence/README.md, section 5).

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "core/influence/directional_expansion.hpp"
#include "core/influence/influence.hpp"
#include "core/influence/piecewise_field.hpp"

namespace rollres {

class SpherePassage {
 public:
  /// @param wave_speed V, for the inertia [m/s]; 0: without
  SpherePassage(const LayeredMedium& medium, double wave_speed);

  /// As of DirectionalExpansion.
  double error() const { return error_; }

  /// At a speed [m/s], which with inertia is that of the waves, for offsets of up to reach_x columns and reach_y rows
  /// of cells [m].
  InfluenceTable table(double speed, double cell_x, double cell_y, int reach_x, int reach_y) const;

 private:
  /// By term and place.
  using Responses = std::vector<std::vector<Coefficients>>;
  /// Functions that all terms are sums of, at some of the places along a row.
  struct Places {
    std::vector<std::size_t> at;
    std::vector<Harmonics> functions;
    void add(std::size_t place, Harmonics values) {
      at.push_back(place);
      functions.push_back(std::move(values));
    }
  };
  /// What each term weighs such functions with.
  class TermSums {
   public:
    TermSums() = default;
    explicit TermSums(const std::vector<Harmonics>& of_terms);
    void add_to(Responses& responses, const Places& places) const;

   private:
    std::array<Eigen::MatrixXd, 6> of_coefficient_;  // [term, function]
  };
  Responses responses(const std::vector<double>& along, double y, double cell_x, double cell_y) const;

  double error_;
  int harmonics_;
  ResponseScales scales_;
  std::vector<double> times_;            // tau_m of each term [s]
  std::array<TermSums, 2> deep_, base_;  // half-spaces under short and long waves, near and far from the cell
  TermSums tail_;                        // of what the correction has left to base at the extent, over a half-space
  std::unique_ptr<const PiecewiseField> correction_;  // to deep, of all terms, up to the extent; none for a half-space
};

}  // namespace rollres
