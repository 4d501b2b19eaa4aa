#include "studies/sampling.hpp"

#include <boost/random/sobol.hpp>
#include <numeric>
#include <random>
#include <utility>

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

std::vector<std::vector<double>> sobol(std::size_t points, std::size_t dimensions, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::uint64_t> shifts(dimensions, 0);
  if (seed != 0)
    for (std::uint64_t& shift : shifts) shift = random();
  boost::random::sobol sequence(dimensions);  // begins behind the origin
  std::vector<std::vector<double>> columns(dimensions);
  for (std::size_t point = 0; point < points; ++point)
    for (std::size_t i = 0; i < dimensions; ++i)
      columns[i].push_back(static_cast<double>(((point == 0 ? 0 : sequence()) ^ shifts[i]) >> 11) * 0x1p-53);
  return columns;
}

std::vector<std::vector<double>> latin_hypercube(std::size_t points, std::size_t dimensions, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::vector<double>> columns(dimensions);
  for (std::vector<double>& column : columns)
    for (const std::uint64_t part : permutation(points, random)) {
      const double inside = static_cast<double>(random() >> 32) * 0x1p-32;  // few enough bits not to round to 1
      column.push_back((static_cast<double>(part) + inside) / static_cast<double>(points));
    }
  return columns;
}

}  // namespace

std::vector<std::vector<double>> unit_sample(SampleMethod method, std::size_t points, std::size_t dimensions,
                                             std::uint64_t seed) {
  return method == SampleMethod::sobol ? sobol(points, dimensions, seed) : latin_hypercube(points, dimensions, seed);
}

}  // namespace rollres
