#pragma once

/// The integrals of a single passage, row by row of nodes: where they need the elastic response, and their sums.
///
/// A memory of length T gives the elastic response K convolved along x, g(x) = int_0^inf e^{-s/T}/T K(x + s) ds: one
/// backward recursion for each row of nodes (core/influence/README.md, (K8)).

#include <array>
#include <vector>

#include "core/influence/elastic_kernel.hpp"
#include "core/influence/influence.hpp"
#include "core/numerics/quadrature.hpp"

namespace rollres {

class PassageQuadrature {
  /// Which rule of integration a cell needs: the closer to the loaded cell, the finer.
  enum CellRule { near, middle, far, distant, rule_count };

 public:
  /// @param columns of cells of length cell_x [m] between the load and the farthest node
  PassageQuadrature(const ResponseScales& scales, double cell_x, int columns);

  int columns() const { return columns_; }

  /// Distances x >= 0 at which the response is needed for a row of nodes [m].
  std::vector<double> distances(int row) const;
  /// The same, as many values of K in their order; what is odd in x vanishes under the load, to the last digit.
  template <class Response>
  std::vector<Coefficients> values(int row, const Response& response) const {
    std::vector<Coefficients> values;
    for (const double x : distances(row)) values.push_back(response(x));
    under_load(values);
    return values;
  }
  static void under_load(std::vector<Coefficients>& values) {
    values.front() = 0.5 * (values.front() + coefficient::mirror_x * values.front());
  }

  /// Adds `compliance` times K to a row of the table.
  void add(InfluenceTable& table, int row, double compliance, const std::vector<Coefficients>& values) const;

  /// What a memory weighs the values with.
  struct Weights {
    std::array<Eigen::VectorXd, rule_count> cells;
    Eigen::VectorXd tail;
    double decay;
  };
  Weights weights(double memory_length) const;

  /// Adds `compliance` times g.
  void add(InfluenceTable& table, int row, double compliance, const Weights& weights,
           const std::vector<Coefficients>& values) const;

 private:
  static CellRule rule_of(int column, int row);

  int columns_;
  double cell_x_;
  std::array<MemoryRule, rule_count> cell_rules_;
  MemoryRule tail_rule_;  // from the last column to the end of the response
};

}  // namespace rollres
