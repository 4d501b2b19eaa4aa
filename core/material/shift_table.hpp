#pragma once

/// Factors of time-temperature superposition from a table, between its rows.
///
/// The logarithm of the factor over the temperature by the rational pieces of Gregory and Delbourgo (1982, IMA J.
/// Numer. Anal. 2, 123): with the values f, the slopes d at the two rows, their secant D and the place t between them
///
///     (t^2 f1 + t (1 - t) (f0 d1 + f1 d0)/D + (1 - t)^2 f0) / (t^2 + t (1 - t) (d0 + d1)/D + (1 - t)^2)
///
/// which rises and falls only where the table does. The slope at a row is that of the hyperbola through it and the rows
/// beside it, s01 s12/s02 with the three secants; at an end s01 s02/s12, three times the secant at most, and of two
/// rows those of a line over 1/T. So the rows of WLF, VFT and Arrhenius, which are hyperbolas, give these laws
/// everywhere. As far as a table reaches beyond its ends (core/scene/shift_reach.hpp) it goes on along the slope there.

#include <utility>
#include <vector>

namespace rollres {

class TableFactors {
 public:
  /// @param temperatures  [K], > 0, two at least, different, in any order   @param factors  [1], > 0, as many
  TableFactors(const std::vector<double>& temperatures, const std::vector<double>& factors);

  /// @param temperature [K]   @throws std::invalid_argument if it lies beyond the table, or this has one row only
  double operator()(double temperature) const;

 private:
  std::vector<std::pair<double, double>> rows_;  // temperatures, ascending, with the logarithms of their factors
};

}  // namespace rollres
