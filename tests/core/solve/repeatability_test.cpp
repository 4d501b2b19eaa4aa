#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <thread>
#include <type_traits>

#include "core/numerics/recently_made.hpp"
#include "core/numerics/threads.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

/// Every number of a solution but its seconds, to the last bit.
std::vector<std::uint64_t> bits(const RollingSolution& solution) {
  std::vector<std::uint64_t> all;
  visit_outputs(solution, [&](const Quantity& quantity, const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, double>) {
      if (quantity.key != "seconds") all.push_back(std::isnan(value) ? 0 : std::bit_cast<std::uint64_t>(value));
    } else if constexpr (std::is_same_v<Value, int> || std::is_enum_v<Value>) {
      all.push_back(static_cast<std::uint64_t>(value));
    }
  });
  return all;
}

/// Slow, quick, light and heavy: their contacts, and so the reach of the kernels on one layer, differ.
std::vector<RollingScene> scenes(const RollingScene& base, std::vector<double> loads, std::vector<double> speeds) {
  std::vector<RollingScene> all;
  for (const double load : loads)
    for (const double speed : speeds) {
      all.push_back(base);
      all.back().load = load;
      all.back().speed = speed;
    }
  return all;
}

}  // namespace

TEST_CASE("a solution is the same to the last bit whatever was solved before it, and on how many threads",
          "[core][rolling_contact]") {
  const std::vector<double> speeds{1e-3, 0.02, 0.05, 0.3, 10};
  RollingScene cylinder = paper_cylinder(), sphere = paper_sphere();
  cylinder.spacing = 0.25e-3;
  sphere.spacing = 0.5e-3;
  RollingScene active_set = cylinder, fine = sphere;  // fine enough for its transforms to be shared out
  active_set.method = Method::active_set;
  fine.spacing = 0.125e-3;
  std::vector<RollingScene> all = scenes(cylinder, {1e4, 2e4, 8e4}, speeds);
  for (const auto& some :
       {scenes(active_set, {1e4, 4e4}, speeds), scenes(sphere, {75, 300}, speeds), scenes(fine, {150}, {0.05, 1})})
    all.insert(all.end(), some.begin(), some.end());

  std::vector<std::vector<std::uint64_t>> alone;
  for (const RollingScene& scene : all) {
    forget_kernels();
    alone.push_back(bits(solve(scene)));
  }
  std::mt19937 random(20130501);
  std::vector<std::size_t> order(all.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  for (const int threads : {1, 2}) {
    std::shuffle(order.begin(), order.end(), random);
    std::size_t different = 0;
    std::jthread([&] {
      limit_threads(threads);
      for (const std::size_t i : order) different += bits(solve(all[i])) != alone[i];
    }).join();
    CHECK(different == 0);
  }
}
