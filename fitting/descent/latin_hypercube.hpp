#pragma once

/// Points that fill a cube evenly.

#include <Eigen/Core>
#include <cstdint>

namespace rollres {

/// Points of [0, 1)^dimensions, a row each, of which each n-th part of each side holds one: one random permutation for
/// each dimension, and a random place inside each part (McKay, Beckman and Conover 1979, Technometrics 21, 239). The
/// same seed gives the same points on every machine.
Eigen::MatrixXd latin_hypercube(Eigen::Index points, Eigen::Index dimensions, std::uint64_t seed);

}  // namespace rollres
