#include "fitting/descent/latin_hypercube.hpp"

#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace rollres {

namespace {

// What std::shuffle and the distributions make of a generator differs between libraries; its own numbers do not.

/// A number below `end`, without bias.
std::uint64_t number_below(std::uint64_t end, std::mt19937_64& random) {
  const std::uint64_t uneven = (0 - end) % end;  // 2^64 modulo end
  std::uint64_t bits = random();
  while (bits < uneven) bits = random();
  return bits % end;
}

std::vector<std::uint64_t> permutation(std::size_t size, std::mt19937_64& random) {
  std::vector<std::uint64_t> order(size);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = size; i > 1; --i) std::swap(order[i - 1], order[number_below(i, random)]);
  return order;
}

}  // namespace

Eigen::MatrixXd latin_hypercube(Eigen::Index points, Eigen::Index dimensions, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Eigen::MatrixXd sample(points, dimensions);
  for (Eigen::Index d = 0; d < dimensions; ++d) {
    Eigen::Index point = 0;
    for (const std::uint64_t part : permutation(static_cast<std::size_t>(points), random)) {
      const double inside = static_cast<double>(random() >> 32) * 0x1p-32;  // few enough bits not to round to 1
      sample(point++, d) = (static_cast<double>(part) + inside) / static_cast<double>(points);
    }
  }
  return sample;
}

}  // namespace rollres
