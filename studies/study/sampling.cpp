#include "studies/study/sampling.hpp"

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

}  // namespace

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
