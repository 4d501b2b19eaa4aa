#include "fitting/latin_hypercube.hpp"

#include <random>
#include <utility>

namespace rollres {

std::vector<Eigen::VectorXd> latin_hypercube(int count, Eigen::Index dimensions, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<Eigen::VectorXd> points(static_cast<std::size_t>(count), Eigen::VectorXd(dimensions));
  std::vector<int> cells(points.size());
  for (Eigen::Index d = 0; d < dimensions; ++d) {
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = static_cast<int>(i);
    for (std::size_t i = cells.size(); i > 1; --i)
      std::swap(cells[i - 1], cells[static_cast<std::size_t>(uniform() * static_cast<double>(i))]);
    for (std::size_t i = 0; i < cells.size(); ++i) points[i][d] = (cells[i] + uniform()) / count;
  }
  return points;
}

}  // namespace rollres
