#pragma once

/// Points spread over the unit cube, for studies of many inputs at once. The same arguments give the same points on
/// every machine.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scene/quantity.hpp"

namespace rollres {

enum class SampleMethod {
  sobol,           ///< the sequence of Sobol' (1967)
  latin_hypercube  ///< each of n equal parts of each side holds one of n points
};
template <>
struct ChoiceNames<SampleMethod> {
  static constexpr std::array<std::string_view, 2> names{"sobol", "latin_hypercube"};
};

/// Coordinates in [0, 1): one list of `points` numbers for each dimension.
///
/// sobol: the sequence with the direction numbers of Joe and Kuo (2008, new-joe-kuo-6.21201), from Boost.Random. It
/// begins with the origin, so that the first 2^m points are a (t, m, s)-net (Owen, 2020, "On dropping the first Sobol'
/// point"). A seed other than 0 shifts it digitally: each dimension has a random number added bit by bit, which keeps
/// it a net (Lemieux, 2009, "Monte Carlo and Quasi-Monte Carlo Sampling", chapter 6).
///
/// latin_hypercube: fitting/descent/latin_hypercube.hpp.
///
/// @param dimensions  from 1 to 3667 for sobol
std::vector<std::vector<double>> unit_sample(SampleMethod method, std::size_t points, std::size_t dimensions,
                                             std::uint64_t seed = 0);

/// The sequence of Sobol' scrambled at random: each dimension's digits are multiplied by a random lower triangular
/// matrix and shifted (Matousek, 1998, J. Complexity 14, 527, "On the L2-discrepancy for anchored boxes", random linear
/// scrambling). Each point is uniform in the open unit cube, and the first 2^m points are a (t, m, s)-net as before:
/// the mean of a function over them has no bias, and scramblings of different seeds tell its error.
std::vector<std::vector<double>> scrambled_sobol(std::size_t points, std::size_t dimensions, std::uint64_t seed);

/// Points in batches that are independent of each other: scrambled anew, or drawn anew; batch after batch.
/// @return coordinates in (0, 1), one list of batches * points_of_each numbers for each dimension
std::vector<std::vector<double>> batched_sample(SampleMethod method, std::size_t batches, std::size_t points_of_each,
                                                std::size_t dimensions, std::uint64_t seed);

}  // namespace rollres
