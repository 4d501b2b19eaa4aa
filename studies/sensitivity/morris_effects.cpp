#include <Eigen/Core>

#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "core/messages/require.hpp"
#include "core/numerics/parallel.hpp"
#include "studies/sensitivity/global_sensitivity.hpp"

namespace rollres {

namespace {

constexpr double step = 2.0 / 3;  // between levels 0, 1/3, 2/3, 1
/// Where one trajectory goes: from `start`, along the inputs in this order.
struct Trajectory {
  std::vector<double> start;
  std::vector<std::size_t> order;
};

Trajectory random_trajectory(std::size_t inputs, std::mt19937_64& random) {
  Trajectory trajectory{std::vector<double>(inputs), std::vector<std::size_t>(inputs)};
  for (double& level : trajectory.start) level = static_cast<double>(random() % 4) / 3;
  std::iota(trajectory.order.begin(), trajectory.order.end(), std::size_t{0});
  for (std::size_t i = inputs; i > 1; --i)  // Fisher and Yates; std::shuffle differs between libraries
    std::swap(trajectory.order[i - 1], trajectory.order[random() % i]);
  return trajectory;
}

/// From the lower two levels up, from the upper two down.
double step_from(double level) { return level < 0.5 ? step : -step; }

}  // namespace

MorrisEffects morris_effects(const CubeFunction& function, std::size_t inputs, std::size_t count, std::uint64_t seed,
                             int jobs) {
  require(inputs >= 1, "inputs", static_cast<double>(inputs), "must be at least 1");
  require(count >= 2, "trajectories", static_cast<double>(count), "must be at least 2");
  std::mt19937_64 random(seed);
  std::vector<Trajectory> trajectories;
  for (std::size_t k = 0; k < count; ++k) trajectories.push_back(random_trajectory(inputs, random));

  std::vector<std::vector<double>> values(count, std::vector<double>(inputs + 1));
  for_each_piece(count * (inputs + 1), jobs, [&](std::size_t piece) {
    const auto& [start, order] = trajectories[piece / (inputs + 1)];
    std::vector<double> place = start;
    for (std::size_t move = 0; move < piece % (inputs + 1); ++move) place[order[move]] += step_from(start[order[move]]);
    values[piece / (inputs + 1)][piece % (inputs + 1)] = function(place);
  });

  MorrisEffects found{std::vector<MorrisEffect>(inputs), count * (inputs + 1), 0};
  std::vector<std::vector<double>> effects(inputs);
  for (std::size_t k = 0; k < count; ++k) {
    for (const double value : values[k]) found.failed += !std::isfinite(value);
    for (std::size_t move = 0; move < inputs; ++move) {
      const std::size_t input = trajectories[k].order[move];
      const double effect = (values[k][move + 1] - values[k][move]) / step_from(trajectories[k].start[input]);
      if (std::isfinite(effect)) effects[input].push_back(effect);
    }
  }
  for (std::size_t i = 0; i < inputs; ++i) {
    MorrisEffect& of = found.inputs[i];
    const auto n = static_cast<double>(effects[i].size());
    of.effects = effects[i].size();
    if (of.effects < 2) {
      of.mean = of.mean_size = of.mean_size_error = of.deviation = std::nan("");
      continue;
    }
    const Eigen::Map<const Eigen::ArrayXd> all(effects[i].data(), std::ssize(effects[i]));
    const auto deviation = [&](const Eigen::ArrayXd& of_all) {
      return std::sqrt((of_all - of_all.mean()).square().sum() / (n - 1));
    };
    of.mean = all.mean();
    of.mean_size = all.abs().mean();
    of.deviation = deviation(all);
    of.mean_size_error = in_95_percent * deviation(all.abs()) / std::sqrt(n);
  }
  return found;
}

}  // namespace rollres
