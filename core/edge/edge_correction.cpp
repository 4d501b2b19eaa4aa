#include "core/edge/edge_correction.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/krylov.hpp"
#include "core/convolution/krylov_operator.hpp"
#include "core/edge/edge_pressure.hpp"
#include "core/model/contact_surface.hpp"

namespace rollres {

namespace {

/// The normal problem on the nodes inside a given edge: no gap there, and the load.
class NormalProblem {
 public:
  NormalProblem(const PressedSphere& sphere, const EdgePressure& edge)
      : sphere_(sphere),
        influence_(sphere.influence),
        edge_(edge),
        nodes_(static_cast<Eigen::Index>(edge.contact().size())) {
    prepare_border();
  }

  /// Solves for pressure and approach from a start, to gaps below a part of the approach; false where it does not get
  /// there.
  bool solve(Vector& pressure, double& approach, double enough) {
    constexpr int most_refinements = 6, most_vectors = 60;
    constexpr double forcing = 1e-3;
    for (int refinement = 0; refinement < most_refinements; ++refinement) {
      const Vector moved = displacements(pressure);
      Vector missing(nodes_ + 1);  // gaps over the response of a node to itself, load over its scale
      for (Eigen::Index i = 0; i < nodes_; ++i) {
        const Eigen::Index node = edge_.contact()[static_cast<std::size_t>(i)];
        missing(i) = -(sphere_.height(node) - approach - moved(node)) / influence_.self_normal();
      }
      missing(nodes_) = (load() - sphere_.of_load.dot(edge_.even(pressure))) / force_scale();
      const double gap = missing.head(nodes_).norm() * influence_.self_normal() / std::sqrt(nodes_);
      if (gap < enough * approach && std::abs(missing(nodes_)) * force_scale() < enough * load()) return true;
      const KrylovResult<float> found =
          gmres<float>([&](const Field& x) { return apply(x); }, [&](const Field& x) { return precondition(x); },
                       missing.cast<float>(), forcing, most_vectors);
      if (!found.x.allFinite()) return false;
      for (Eigen::Index i = 0; i < nodes_; ++i)
        pressure(edge_.contact()[static_cast<std::size_t>(i)]) += static_cast<double>(found.x(i));
      approach += static_cast<double>(found.x(nodes_)) * influence_.self_normal();
    }
    return false;
  }

 private:
  using Field = Eigen::VectorXf;

  double load() const { return *sphere_.model.load; }
  double force_scale() const { return sphere_.of_load.maxCoeff() * std::sqrt(static_cast<double>(nodes_)); }

  /// w of all nodes [m], one column beyond the grid's left out.
  Vector displacements(const Vector& pressure) const {
    const SurfaceGrid& grid = sphere_.half;
    const Displacements moved = influence_.apply(edge_.even(pressure), {}, {});
    Vector w(grid.size());
    for (Eigen::Index row = 0; row < grid.rows; ++row)
      w.segment(row * grid.columns, grid.columns) = moved.w.segment(row * (grid.columns + 1), grid.columns);
    edge_.add_near(pressure, w);
    return w;
  }

  Field scattered(const Field& values, double factor) const {
    Field field = Field::Zero(sphere_.half.size());
    for (Eigen::Index i = 0; i < nodes_; ++i)
      field(edge_.contact()[static_cast<std::size_t>(i)]) = static_cast<float>(factor) * values(i);
    return field;
  }

  /// Rows as (N8): gaps over the response of a node to itself; the approach over it is the last unknown.
  Field apply(const Field& x) {
    const Field pressure = scattered(x, 1);
    KrylovOperator<float>::Tractions tractions;
    tractions.pressure = edge_.even(pressure);
    KrylovOperator<float>::Response moved;
    influence_.krylov<float>().apply(tractions, moved);
    edge_.add_near(pressure, moved.w);
    Field rows(nodes_ + 1);
    const auto per_normal = static_cast<float>(1 / influence_.self_normal());
    for (Eigen::Index i = 0; i < nodes_; ++i)
      rows(i) = -per_normal * moved.w(edge_.contact()[static_cast<std::size_t>(i)]) - x(nodes_);
    rows(nodes_) = load_row(tractions.pressure);
    return rows;
  }

  float load_row(const Field& even) const {
    return static_cast<float>(sphere_.of_load.cast<float>().dot(even) / force_scale());
  }

  Field precondition_gaps(const Field& right_side) {
    KrylovOperator<float>::Response wanted;
    wanted.w = scattered(right_side, influence_.self_normal());
    KrylovOperator<float>::Tractions tractions;
    influence_.krylov<float>().approximate_inverse(wanted, tractions);
    Field x = Field::Zero(nodes_ + 1);
    for (Eigen::Index i = 0; i < nodes_; ++i) x(i) = tractions.pressure(edge_.contact()[static_cast<std::size_t>(i)]);
    return x;
  }
  float load_of(const Field& x) const { return load_row(scattered(x, 1)); }

  /// (N12) with the approach alone.
  void prepare_border() {
    Field rows = Field::Zero(nodes_ + 1);
    rows.head(nodes_).setConstant(-1);
    of_approach_ = precondition_gaps(rows);
    per_load_ = -1 / load_of(of_approach_);
  }
  Field precondition(const Field& right_side) {
    Field x = precondition_gaps(right_side);
    const float share = per_load_ * (right_side(nodes_) - load_of(x));
    x -= share * of_approach_;
    x(nodes_) = share;
    return x;
  }

  const PressedSphere& sphere_;
  const InfluenceOperator& influence_;
  const EdgePressure& edge_;
  Eigen::Index nodes_;
  Field of_approach_;
  float per_load_ = 0;
};

/// From 0 to 1, without kinks.
double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// The cells on the shorter half of a contact.
double cells_on_half(const EdgeCurve& curve, const SurfaceGrid& grid) {
  return std::min(std::sqrt(std::max(curve.squared_length(0), 0.0)) / grid.spacing_x, curve.unit / grid.spacing_y);
}

/// 1 where no memory of the materials at the contact is some cells long: p^2 is no parabola over the ring then.
/// @param contact  cells along the contact
double smooth_over_ring(const PressedSphere& sphere, double contact) {
  constexpr double too_long = 0.2, too_short = 10, long_enough = 16;  // cells
  constexpr double negligible = 0.1;                                  // part of the compliance that the contact sees
  const CreepSpectrum creep = near_spectrum(sphere.model);
  double whole = creep.instantaneous, between = 0;
  for (const CreepSpectrum::Term& term : creep.terms) {
    const double cells = sphere.model.speed * term.time / sphere.half.spacing_x;
    const double resolved = smooth_step((cells - too_short) / (long_enough - too_short));
    const double as_elastic = smooth_step(2 - cells / too_long);
    whole += term.compliance / (1 + std::pow(cells / contact, 2));
    between += term.compliance * (1 - std::max(resolved, as_elastic));
  }
  return smooth_step(1.5 - between / (negligible * whole));
}

}  // namespace

EdgeCorrection edge_correction(const PressedSphere& sphere, const Vector& even_pressure, double approach) {
  const SurfaceGrid& grid = sphere.half;
  // How far outside its place the pressure of even cells shows the edge, on Hertz's contact on 241 to 2353 nodes:
  // 0.031 to 0.037.
  constexpr EdgeRing of_even_cells{2, 5.5, 0.034}, of_uneven_cells{0.5, 5, 0};
  constexpr int passes = 3;
  EdgeCurve curve = edge_around(grid, even_pressure, of_even_cells);
  Vector pressure = even_pressure;
  double before = RollingSolution::absent, change = before;
  for (int pass = 0; pass < passes; ++pass) {
    if (!curve.known()) return {};
    const EdgePressure edge(sphere.model, grid, curve);
    if (!edge.fits()) return {};
    Vector inside = Vector::Zero(grid.size());
    for (const Eigen::Index node : edge.contact()) inside(node) = pressure(node);
    pressure = std::move(inside);
    // The last pass settles R_r; those before only the edge.
    constexpr double of_edge = 1e-6, of_resistance = 1e-8;
    if (!NormalProblem(sphere, edge).solve(pressure, approach, pass + 1 < passes ? of_edge : of_resistance)) return {};
    for (const Eigen::Index node : edge.contact())
      if (!(pressure(node) > 0)) return {};
    before = change;
    change = sphere.of_resistance.dot(edge.even(pressure) - even_pressure);
    if (pass + 1 < passes) curve = edge_around(grid, edge.of_cells(pressure), of_uneven_cells);
  }
  constexpr double of_change = 0.25, of_whole = 2e-4;
  constexpr double too_coarse = 12, fine_enough = 16;  // cells: below, the ring is as wide as the contact
  const double resistance = sphere.of_resistance.dot(even_pressure) + sphere.resistance_of_shear;
  const double allowed = of_change * std::abs(change) + of_whole * std::abs(resistance);
  const double agrees = smooth_step(1.5 - std::abs(change - before) / allowed);
  const double resolves = smooth_step((cells_on_half(curve, grid) - too_coarse) / (fine_enough - too_coarse));
  return {change, agrees * resolves * smooth_over_ring(sphere, 2 * cells_on_half(curve, grid))};
}

}  // namespace rollres
