#pragma once

/// Which of several inputs matter over their whole ranges: indices of Sobol' and elementary effects of Morris, of any
/// function of the unit cube. The same arguments give the same points on every machine.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rollres {

/// A function of the unit cube; NaN where it has no value. Called by several threads at once.
using CubeFunction = std::function<double(std::span<const double>)>;

inline constexpr double in_95_percent = 1.96;  ///< standard deviations

struct EstimatedIndex {
  double value = 0;
  double error = 0;  ///< half-width of its 95 % interval
};

struct SobolIndices {
  std::vector<EstimatedIndex> first;  ///< share of the variance that an input explains by itself [1]
  std::vector<EstimatedIndex> total;  ///< share in which it has a part [1]
  double mean = 0, variance = 0;      ///< of the function
  std::size_t rows = 0;               ///< that were used
  std::size_t failed_rows = 0;        ///< left out because one of their points has no value
  std::size_t evaluations = 0;
};

/// `rows` points A and B of Sobol's sequence in twice the dimensions, and A with one column of B for each input: rows
/// (inputs + 2) evaluations. First order by Saltelli et al. (2010, Comput. Phys. Commun. 181, 259, table 2b), total by
/// Jansen (1999, Comput. Phys. Commun. 117, 35; table 2f there). Errors by bootstrap over the rows.
/// @param rows  best a power of two
/// @param jobs  threads; 0: one for each core
/// @throws std::invalid_argument if rows < 8 or inputs < 1, or if fewer than 8 rows have values
SobolIndices sobol_indices(const CubeFunction& function, std::size_t inputs, std::size_t rows, std::uint64_t seed = 0,
                           int jobs = 0);

/// Elementary effects of one input over its whole range [unit of the function].
struct MorrisEffect {
  double mean = 0;             ///< mu
  double mean_size = 0;        ///< mu*: mean of the sizes
  double mean_size_error = 0;  ///< half-width of its 95 % interval
  double deviation = 0;        ///< sigma: of bends and interactions
  std::size_t effects = 0;     ///< that were found
};

struct MorrisEffects {
  std::vector<MorrisEffect> inputs;
  std::size_t evaluations = 0, failed = 0;
};

/// Morris (1991, Technometrics 33, 161) on 4 levels with steps of 2/3; mu* by Campolongo, Cariboni and Saltelli (2007,
/// Environ. Model. Softw. 22, 1509). Each of the trajectories costs inputs + 1 evaluations.
/// @throws std::invalid_argument if trajectories < 2 or inputs < 1
MorrisEffects morris_effects(const CubeFunction& function, std::size_t inputs, std::size_t trajectories,
                             std::uint64_t seed = 0, int jobs = 0);

}  // namespace rollres
