#include "core/influence/passage_kernel.hpp"

#include "core/messages/message_text.hpp"
#include "core/numerics/recently_made.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

constexpr double most_points = 3e9;  // about a minute's

}  // namespace

PassageKernel::PassageKernel(int dimension, const Layer& layer, double cell_x, double cell_y, int columns, int rows)
    : PassageKernel(ElasticKernel(dimension, layer, cell_x, cell_y), cell_x, cell_y, columns, rows) {}

PassageKernel::PassageKernel(const ElasticKernel& kernel, double cell_x, double cell_y, int columns, int rows)
    : rules_(kernel.scales(), cell_x, columns) {
  const double points = static_cast<double>(rules_.distances(0).size()) * (rows + 1.0) * kernel.points_in_a_cell();
  if (points > most_points)
    throw BeyondLimits(message_text("the layer's response needs ", points,
                                    " points: the layer is thin against a cell of ", cell_x,
                                    " m; give a finer spacing"));
  for (int row = 0; row <= rows; ++row) {
    require_time();
    values_.push_back(rules_.values(row, [&](double x) { return kernel(x, row * cell_y); }));
  }
}

InfluenceTable PassageKernel::table(const CreepSpectrum& material, double speed, int reach_x, int reach_y) const {
  InfluenceTable table(reach_x, reach_y);
  const auto values = [&](int row) -> const auto& { return values_[static_cast<std::size_t>(row)]; };
  for (int row = 0; row <= table.reach_y(); ++row) rules_.add(table, row, material.instantaneous, values(row));
  for (const CreepSpectrum::Term& term : material.terms) {
    require_time();
    const PassageQuadrature::Weights weights = rules_.weights(speed * term.time);
    for (int row = 0; row <= table.reach_y(); ++row) rules_.add(table, row, term.compliance, weights, values(row));
  }
  return table;
}

namespace {

struct KernelKey {
  int dimension;
  Layer layer;
  double cell_x, cell_y;
  int columns, rows;
};

/// Where the tail begins shows in the last digits: only a kernel of as many columns gives what a new one would, so that
/// a solution does not depend on what was solved before it. Rows do not know of each other.
struct ServesAsKernel {
  bool operator()(const KernelKey& kept, const KernelKey& wanted) const {
    return kept.dimension == wanted.dimension && kept.layer == wanted.layer && kept.cell_x == wanted.cell_x &&
           kept.cell_y == wanted.cell_y && kept.columns == wanted.columns && kept.rows >= wanted.rows;
  }
};

}  // namespace

std::shared_ptr<const PassageKernel> shared_passage_kernel(int dimension, const Layer& layer, double cell_x,
                                                           double cell_y, int columns, int rows) {
  static RecentlyMade<KernelKey, PassageKernel, 16, ServesAsKernel> cache;
  return cache({dimension, layer, cell_x, cell_y, columns, rows},
               [&] { return PassageKernel(dimension, layer, cell_x, cell_y, columns, rows); });
}

}  // namespace rollres
