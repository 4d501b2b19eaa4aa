#include "core/passage_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <list>
#include <mutex>

namespace rollres {

PassageKernel::PassageKernel(Indenter indenter, const SurfaceShape& shape, double cell_x, double cell_y, int columns,
                             int rows)
    : PassageKernel(
          shape.scales(),
          [kernel = ElasticKernel(indenter, shape, cell_x, cell_y)](double y) -> ResponseAlong {
            return [&kernel, y](double x) { return kernel(x, y); };
          },
          cell_x, cell_y, columns, rows) {}

PassageKernel::PassageKernel(const ResponseScales& scales, const ElasticResponse& response, double cell_x,
                             double cell_y, int columns, int rows)
    : columns_(columns), rows_(rows), cell_x_(cell_x) {
  // Displacements bend at the edge of the loaded cell, in the middle of a cell of nodes: two halves near it, and
  // panels no longer than the surface's finest scale.
  const double half = 0.5 * cell_x;
  const int parts = std::max(1, static_cast<int>(std::ceil(half / scales.length)));
  const auto split = [&](MemoryRule& rule, double start, double length, int count, int order) {
    for (int part = 0; part < count; ++part) rule.add_panel(start + part * length / count, length / count, order);
  };
  using enum MemoryRule::Singular;
  split(cell_rules_[near], 0, half * (parts - 1) / parts, parts - 1, 16);
  cell_rules_[near].add_panel(half * (parts - 1) / parts, half / parts, 16, right);
  cell_rules_[near].add_panel(half, half / parts, 16, left);
  split(cell_rules_[near], half + half / parts, half * (parts - 1) / parts, parts - 1, 16);
  split(cell_rules_[middle], 0, cell_x, 2 * parts - 1, parts > 1 ? 10 : 8);
  split(cell_rules_[far], 0, cell_x, 2 * parts - 1, parts > 1 ? 10 : 5);
  split(cell_rules_[distant], 0, cell_x, 2 * parts - 1, parts > 1 ? 10 : 3);

  const double start = columns * cell_x;
  const double end = scales.rigid_base
                         ? scales.reach()
                         : std::ldexp(std::isinf(scales.extent) ? start : std::max(start, scales.extent), 40);
  for (double s = 0, length = 0.5 * start; end - start - s > 1e-9 * end; length *= 1.5) {
    // Over a layer the response falls by e^{-0.74 s/H}: the farther, the less it takes.
    const double kept = std::min({length, end - start - s, 2.5 * scales.grain(start + s)});
    const bool faint = scales.rigid_base && start + s > 8.0 / 30 * scales.extent;
    split(tail_rule_, s, kept, 1, faint ? 8 : 12);
    s += kept;
  }

  nodes_.reserve(static_cast<std::size_t>((columns + 1) * (rows + 1)));
  for (int row = 0; row <= rows; ++row) {
    const ResponseAlong kernel = response(row * cell_y);
    for (int column = 0; column <= columns; ++column) nodes_.push_back(kernel(column * cell_x));
    // Odd coefficients vanish under the load, to the last digit.
    Coefficients& under = nodes_[nodes_.size() - static_cast<std::size_t>(columns) - 1];
    under = 0.5 * (under + coefficient::mirror_x * under);
    for (int column = 0; column < columns; ++column) {
      first_sample_.push_back(samples_.size());
      // A rule begins and ends on nodes.
      const std::vector<double>& points = cell_rules_[rule_of(column, row)].nodes();
      const Coefficients* const node = &nodes_[nodes_.size() - static_cast<std::size_t>(columns - column) - 1];
      samples_.push_back(node[0]);
      for (std::size_t i = 1; i + 1 < points.size(); ++i) samples_.push_back(kernel(column * cell_x + points[i]));
      samples_.push_back(node[1]);
    }
    for (const double s : tail_rule_.nodes()) tail_.push_back(kernel(start + s));
  }
}

PassageKernel::CellRule PassageKernel::rule_of(int column, int row) const {
  const int distance = std::max(column, row);
  return distance < 3 ? near : distance < 10 ? middle : distance < 40 ? far : distant;
}

InfluenceTable PassageKernel::table(const CreepSpectrum& material, double speed, int reach_x, int reach_y) const {
  InfluenceTable table(reach_x, reach_y);
  add_to(table, material, speed);
  return table;
}

void PassageKernel::add_to(InfluenceTable& table, const CreepSpectrum& material, double speed) const {
  const int reach_x = table.reach_x(), reach_y = table.reach_y();
  const Coefficients& mirror = coefficient::mirror_x;
  const auto node = [&](int column, int row) -> Coefficients {
    const Coefficients& value = nodes_[static_cast<std::size_t>(row * (columns_ + 1) + std::abs(column))];
    return column < 0 ? Coefficients(mirror * value) : value;
  };
  const auto add = [&](int column, int row, const Coefficients& value) {
    const auto i = static_cast<std::size_t>(table.index(column, row));
    table.ww[i] += value(coefficient::ww);
    table.uu[i] += value(coefficient::uu);
    table.uw[i] += value(coefficient::uw);
    if (rows_ == 0) return;
    table.vv[i] += value(coefficient::vv);
    table.uv[i] += value(coefficient::uv);
    table.vw[i] += value(coefficient::vw);
  };
  for (int row = 0; row <= reach_y; ++row)
    for (int column = -reach_x; column <= reach_x; ++column)
      add(column, row, material.instantaneous * node(column, row));

  for (const CreepSpectrum::Term& term : material.terms) {
    const double memory = speed * term.time;  // T [m]
    std::array<Eigen::VectorXd, rule_count> weights;
    for (std::size_t rule = 0; rule < rule_count; ++rule) weights[rule] = cell_rules_[rule].weights(memory);
    const Eigen::VectorXd tail_weights = tail_rule_.weights(memory);
    const double decay = std::exp(-cell_x_ / memory);

    for (int row = 0; row <= reach_y; ++row) {
      Coefficients g = Coefficients::Zero();
      const auto tail = static_cast<std::size_t>(row * tail_weights.size());
      for (Eigen::Index q = 0; q < tail_weights.size(); ++q)
        g += tail_weights(q) * tail_[tail + static_cast<std::size_t>(q)];
      for (int column = columns_; column >= -reach_x; --column) {
        if (column < columns_) {
          // The cell from this node to the next; left of the origin it is the mirror image of one on the right.
          const int mirrored = column >= 0 ? column : -column - 1;
          const Eigen::VectorXd& w = weights[rule_of(mirrored, row)];
          const Coefficients* k = &samples_[first_sample_[static_cast<std::size_t>(row * columns_ + mirrored)]];
          const Eigen::Index count = w.size();
          Coefficients integral = Coefficients::Zero();
          if (column >= 0)
            for (Eigen::Index q = 0; q < count; ++q) integral += w(q) * k[q];
          else
            for (Eigen::Index q = 0; q < count; ++q) integral += w(q) * k[count - 1 - q];
          g = decay * g + (column >= 0 ? integral : Coefficients(mirror * integral));
        }
        if (column <= reach_x) add(column, row, term.compliance * g);
      }
    }
  }
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
