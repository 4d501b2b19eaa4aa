#include "studies/study/sampling.hpp"

#include <algorithm>
#include <bit>
#include <boost/random/sobol.hpp>
#include <random>

#include "fitting/descent/latin_hypercube.hpp"

namespace rollres {

namespace {

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

/// The fraction whose 53 leading binary digits these are; 0 becomes half of the last.
double open_fraction(std::uint64_t digits) { return std::max(static_cast<double>(digits >> 11) * 0x1p-53, 0x1p-54); }

/// A random lower triangular matrix of binary digits with ones on its diagonal: one row for each digit.
std::array<std::uint64_t, 64> random_triangle(std::mt19937_64& random) {
  std::array<std::uint64_t, 64> rows{};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::uint64_t diagonal = std::uint64_t{1} << (63 - i), before = ~(2 * diagonal - 1);
    rows[i] = diagonal | (i == 0 ? 0 : random() & before);
  }
  return rows;
}

std::uint64_t times(const std::array<std::uint64_t, 64>& rows, std::uint64_t digits) {
  std::uint64_t product = 0;
  for (const std::uint64_t row : rows) product = product << 1 | (std::popcount(row & digits) & 1U);
  return product;
}

}  // namespace

std::vector<std::vector<double>> scrambled_sobol(std::size_t points, std::size_t dimensions, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::array<std::uint64_t, 64>> triangles(dimensions);
  std::vector<std::uint64_t> shifts(dimensions);
  for (std::size_t i = 0; i < dimensions; ++i) {
    triangles[i] = random_triangle(random);
    shifts[i] = random();
  }
  boost::random::sobol sequence(dimensions);  // begins behind the origin
  std::vector<std::vector<double>> columns(dimensions);
  for (std::size_t point = 0; point < points; ++point)
    for (std::size_t i = 0; i < dimensions; ++i) {
      const std::uint64_t digits = point == 0 ? 0 : sequence();
      columns[i].push_back(open_fraction(times(triangles[i], digits) ^ shifts[i]));
    }
  return columns;
}

std::vector<std::vector<double>> batched_sample(SampleMethod method, std::size_t batches, std::size_t points_of_each,
                                                std::size_t dimensions, std::uint64_t seed) {
  std::mt19937_64 seeds(seed);
  std::vector<std::vector<double>> columns(dimensions);
  for (std::size_t batch = 0; batch < batches; ++batch) {
    const std::uint64_t own = seeds();
    const auto points = method == SampleMethod::sobol ? scrambled_sobol(points_of_each, dimensions, own)
                                                      : unit_sample(method, points_of_each, dimensions, own);
    for (std::size_t i = 0; i < dimensions; ++i)
      for (const double place : points[i]) columns[i].push_back(std::max(place, 0x1p-54));
  }
  return columns;
}

std::vector<std::vector<double>> unit_sample(SampleMethod method, std::size_t points, std::size_t dimensions,
                                             std::uint64_t seed) {
  if (method == SampleMethod::sobol) return sobol(points, dimensions, seed);
  const Eigen::MatrixXd sample =
      latin_hypercube(static_cast<Eigen::Index>(points), static_cast<Eigen::Index>(dimensions), seed);
  std::vector<std::vector<double>> columns;
  for (const auto& column : sample.colwise()) columns.emplace_back(column.begin(), column.end());
  return columns;
}

}  // namespace rollres
