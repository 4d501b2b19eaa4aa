#include "core/influence/passage_quadrature.hpp"

#include <algorithm>
#include <cmath>

#include "core/messages/message_text.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

/// Panels in half a cell beyond which a cell is too coarse for its layers.
constexpr int most_parts = 1000;

void add_at(InfluenceTable& table, int column, int row, const Coefficients& value) {
  const auto i = static_cast<std::size_t>(table.index(column, row));
  table.ww[i] += value(coefficient::ww);
  table.uu[i] += value(coefficient::uu);
  table.uw[i] += value(coefficient::uw);
  if (table.vv.empty()) return;
  table.vv[i] += value(coefficient::vv);
  table.uv[i] += value(coefficient::uv);
  table.vw[i] += value(coefficient::vw);
}

}  // namespace

PassageQuadrature::PassageQuadrature(const ResponseScales& scales, double cell_x, int columns)
    : columns_(columns), cell_x_(cell_x) {
  // Displacements bend at the edge of the loaded cell, in the middle of a cell of nodes: two halves near it, and
  // panels no longer than the surface's finest scale.
  const double half = 0.5 * cell_x;
  const int parts = std::max(1, checked_count(std::ceil(half / scales.length), "panels in a cell"));
  if (parts > most_parts)
    throw BeyondLimits(message_text("the layers respond over ", scales.length, " m, much less than a cell of ", cell_x,
                                    " m: give a finer spacing"));
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
  // 1/x is over far sooner than -ln x, which must be known over all of a memory (unending ones: lumped_spectrum.hpp).
  const int doublings = scales.line_load ? 50 : 40;
  const double end = scales.rigid_base
                         ? scales.reach()
                         : std::ldexp(std::isinf(scales.extent) ? start : std::max(start, scales.extent), doublings);
  for (double s = 0, length = 0.5 * start; end - start - s > 1e-9 * end; length *= 1.5) {
    // Over a layer the response falls by e^{-0.74 s/H}: the farther, the less it takes.
    const double kept = std::min({length, end - start - s, 2.5 * scales.grain(start + s)});
    const bool faint = scales.rigid_base && start + s > 8.0 / 30 * scales.extent;
    split(tail_rule_, s, kept, 1, faint ? 8 : 12);
    s += kept;
  }
}

PassageQuadrature::CellRule PassageQuadrature::rule_of(int column, int row) {
  const int distance = std::max(column, row);
  return distance < 3 ? near : distance < 10 ? middle : distance < 40 ? far : distant;
}

std::vector<double> PassageQuadrature::distances(int row) const {
  std::vector<double> distances;
  for (int column = 0; column <= columns_; ++column) distances.push_back(column * cell_x_);
  for (int column = 0; column < columns_; ++column) {
    // A rule begins and ends on nodes.
    const std::vector<double>& points = cell_rules_[rule_of(column, row)].nodes();
    for (std::size_t i = 1; i + 1 < points.size(); ++i) distances.push_back(column * cell_x_ + points[i]);
  }
  for (const double s : tail_rule_.nodes()) distances.push_back(columns_ * cell_x_ + s);
  return distances;
}

void PassageQuadrature::add(InfluenceTable& table, int row, double compliance,
                            const std::vector<Coefficients>& values) const {
  for (int column = -table.reach_x(); column <= table.reach_x(); ++column) {
    const Coefficients& value = values[static_cast<std::size_t>(std::abs(column))];
    add_at(table, column, row, compliance * (column < 0 ? Coefficients(coefficient::mirror_x * value) : value));
  }
}

PassageQuadrature::Weights PassageQuadrature::weights(double memory_length) const {
  Weights weights;
  for (std::size_t rule = 0; rule < rule_count; ++rule) weights.cells[rule] = cell_rules_[rule].weights(memory_length);
  weights.tail = tail_rule_.weights(memory_length);
  weights.decay = std::exp(-cell_x_ / memory_length);
  return weights;
}

/// The recursion (K8), from the last column to the first.
void PassageQuadrature::add(InfluenceTable& table, int row, double compliance, const Weights& weights,
                            const std::vector<Coefficients>& values) const {
  const Coefficients& mirror = coefficient::mirror_x;
  const auto count_in = [&](int column) { return weights.cells[rule_of(column, row)].size(); };
  Coefficients g = Coefficients::Zero();
  const Coefficients* const tail = values.data() + (static_cast<Eigen::Index>(values.size()) - weights.tail.size());
  for (Eigen::Index q = 0; q < weights.tail.size(); ++q) g += weights.tail(q) * tail[q];

  const Coefficients* inside = tail;  // of the cell on the right, then of its mirror image
  for (int column = columns_; column >= -table.reach_x(); --column) {
    if (column < columns_) {
      // The cell from this node to the next; left of the origin it is the mirror image of one on the right.
      const int mirrored = column >= 0 ? column : -column - 1;
      const Eigen::VectorXd& w = weights.cells[rule_of(mirrored, row)];
      const Eigen::Index last = w.size() - 1;
      if (column >= 0) inside -= last - 1;
      const auto node = values.begin() + mirrored;
      Coefficients integral;
      if (column >= 0) {
        integral = w(0) * node[0];
        for (Eigen::Index q = 1; q < last; ++q) integral += w(q) * inside[q - 1];
        integral += w(last) * node[1];
      } else {
        integral = w(0) * node[1];
        for (Eigen::Index q = 1; q < last; ++q) integral += w(q) * inside[last - 1 - q];
        integral += w(last) * node[0];
        integral *= mirror;
      }
      g = weights.decay * g + integral;
      if (column < 0 && -column < columns_) inside += count_in(mirrored) - 2;
    }
    if (column <= table.reach_x()) add_at(table, column, row, compliance * g);
  }
}

}  // namespace rollres
