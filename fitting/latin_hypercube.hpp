#pragma once

/// Points that fill a cube evenly.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace rollres {

/// `count` points of [0, 1]^dimensions of which each n-th part of each side holds one (McKay, Beckman and Conover 1979,
/// Technometrics 21, 239). The same seed gives the same points on every machine.
std::vector<Eigen::VectorXd> latin_hypercube(int count, Eigen::Index dimensions, std::uint64_t seed);

}  // namespace rollres
