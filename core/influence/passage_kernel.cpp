#include "core/influence/passage_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <list>
#include <mutex>

namespace rollres {

PassageKernel::PassageKernel(Indenter indenter, const Layer& layer, double cell_x, double cell_y, int columns, int rows)
    : rules_(surface_shape(indenter, layer).scales(), cell_x, columns) {
  const ElasticKernel kernel(indenter, layer, cell_x, cell_y);
  for (int row = 0; row <= rows; ++row)
    values_.push_back(rules_.values(row, [&](double x) { return kernel(x, row * cell_y); }));
}

InfluenceTable PassageKernel::table(const CreepSpectrum& material, double speed, int reach_x, int reach_y) const {
  InfluenceTable table(reach_x, reach_y);
  const auto values = [&](int row) -> const auto& { return values_[static_cast<std::size_t>(row)]; };
  for (int row = 0; row <= table.reach_y(); ++row) rules_.add(table, row, material.instantaneous, values(row));
  for (const CreepSpectrum::Term& term : material.terms) {
    const PassageRules::Weights weights = rules_.weights(speed * term.time);
    for (int row = 0; row <= table.reach_y(); ++row) rules_.add(table, row, term.compliance, weights, values(row));
  }
  return table;
}

namespace {

struct KernelCache {
  struct Entry {
    Indenter indenter;
    Layer layer;
    double cell_x, cell_y;
    std::shared_ptr<const PassageKernel> kernel;
  };
  std::mutex mutex;
  std::list<Entry> entries;  // most recently used first
};

KernelCache& kernel_cache() {
  static KernelCache cache;
  return cache;
}

}  // namespace

std::shared_ptr<const PassageKernel> shared_passage_kernel(Indenter indenter, const Layer& layer, double cell_x,
                                                           double cell_y, int columns, int rows) {
  auto& [mutex, cache] = kernel_cache();
  constexpr std::size_t capacity = 16;

  // Where the tail begins shows in the last digits: only a kernel of as many columns gives what a new one would, so
  // that a solution does not depend on what was solved before it. Rows do not know of each other.
  const auto fits = [&](const KernelCache::Entry& entry) {
    return entry.indenter == indenter && entry.layer == layer && entry.cell_x == cell_x && entry.cell_y == cell_y &&
           entry.kernel->columns() == columns && entry.kernel->rows() >= rows;
  };
  {
    const std::lock_guard lock(mutex);
    const auto found = std::find_if(cache.begin(), cache.end(), fits);
    if (found != cache.end()) {
      cache.splice(cache.begin(), cache, found);
      return found->kernel;
    }
  }
  auto kernel = std::make_shared<const PassageKernel>(indenter, layer, cell_x, cell_y, columns, rows);
  const std::lock_guard lock(mutex);
  cache.push_front({indenter, layer, cell_x, cell_y, kernel});
  if (cache.size() > capacity) cache.pop_back();
  return kernel;
}

void forget_passage_kernels() {
  KernelCache& cache = kernel_cache();
  const std::lock_guard lock(cache.mutex);
  cache.entries.clear();
}

}  // namespace rollres
