#include "core/newton/newton_system.hpp"

#include <cmath>

#include "core/algebra/dense_algebra.hpp"
#include "core/algebra/krylov.hpp"
#include "core/convolution/krylov_operator.hpp"
#include "core/messages/message_text.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

Vector pack(const LawResiduals& residuals, const LawRows<double>& rows) {
  Vector packed(rows.unknowns());
  const Eigen::Index n = rows.contacts();
  packed.head(n) = residuals.normal;
  if (rows.components() > 1) packed.segment(n, n) = residuals.shear_x;
  if (rows.components() > 2) packed.segment(2 * n, n) = residuals.shear_y;
  Eigen::Index at = rows.components() * n;
  if (rows.approach_unknown()) packed(at++) = residuals.load / rows.force_scale();
  if (rows.rotation_unknown()) packed(at) = residuals.drive / rows.force_scale();
  return packed;
}

/// What GMRES needs: the rows and their approximate inverse, on packed vectors.
template <class Real>
class KrylovRows {
 public:
  using Field = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

  KrylovRows(const ContactProblem& problem, const InfluenceOperator& influence, const ActiveLaws& laws)
      : rows_(problem, laws),
        laws_(laws),
        edge_(problem.edge),
        influence_(influence.krylov<Real>()),
        per_normal_(static_cast<Real>(1 / influence.self_normal())),
        per_slip_(static_cast<Real>(1 / influence.self_slip())) {
    const Eigen::Index size = problem.grid.size();
    tractions_.pressure = response_.w = Field::Zero(size);
    if (rows_.components() > 1) tractions_.shear_x = response_.slip_x = Field::Zero(size);
    if (rows_.components() > 2) tractions_.shear_y = response_.slip_y = Field::Zero(size);
    prepare_border();
  }

  Field apply(const Field& x) {
    const Eigen::Index n = rows_.contacts();
    scatter(x.head(n), tractions_.pressure, Real(1));
    if (rows_.components() > 1) scatter(x.segment(n, n), tractions_.shear_x, Real(1));
    if (rows_.components() > 2) scatter(x.segment(2 * n, n), tractions_.shear_y, Real(1));
    influence_.apply(tractions_, moved_);
    if (rows_.components() > 2) edge_.add(tractions_.shear_x, tractions_.shear_y, moved_.slip_x, moved_.slip_y);
    gather(moved_.w, scaled_.w, per_normal_);
    if (rows_.components() > 1) gather(moved_.slip_x, scaled_.slip_x, per_slip_);
    if (rows_.components() > 2) gather(moved_.slip_y, scaled_.slip_y, per_slip_);
    return rows_(x, scaled_);
  }

  /// core/newton/README.md, (N12)
  Field precondition(const Field& right_side) {
    Field x = precondition_laws(right_side);
    const Eigen::Index border = rows_.border();
    if (border == 0) return x;
    // Rows of load and drive on what the laws alone would give; the border's unknowns make up the difference.
    const Field share = border_schur_ * (right_side.tail(border) - rows_.border_rows(x));
    x.noalias() -= border_response_ * share;
    x.tail(border) = share;
    return x;
  }

 private:
  template <class Packed>
  void scatter(const Packed& values, Field& field, Real factor) const {
    for (Eigen::Index i = 0; i < values.size(); ++i)
      field(laws_.contact[static_cast<std::size_t>(i)]) = factor * values(i);
  }
  void gather(const Field& field, Field& values, Real factor) const {
    values.resize(rows_.contacts());
    for (Eigen::Index i = 0; i < values.size(); ++i)
      values(i) = factor * field(laws_.contact[static_cast<std::size_t>(i)]);
  }

  /// (N11)
  Field precondition_laws(const Field& right_side) {
    const Eigen::Index n = rows_.contacts();
    const bool lateral = rows_.components() > 2;
    scatter(right_side.head(n), response_.w, 1 / per_normal_);
    for (Eigen::Index i = 0; rows_.components() > 1 && i < n; ++i) {
      const Eigen::Index node = laws_.contact[static_cast<std::size_t>(i)];
      const Real factor = rows_.sticks(i) ? 1 / per_slip_ : Real(0);
      response_.slip_x(node) = factor * right_side(n + i);
      if (lateral) response_.slip_y(node) = factor * right_side(2 * n + i);
    }
    influence_.approximate_inverse(response_, inverse_);

    Field x = Field::Zero(rows_.unknowns());
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Index node = laws_.contact[static_cast<std::size_t>(i)];
      x(i) = inverse_.pressure(node);
      if (rows_.components() == 1) continue;
      const bool sticks = rows_.sticks(i);
      x(n + i) = sticks ? inverse_.shear_x(node) : right_side(n + i) + rows_.along_x(i) * x(i);
      if (lateral)
        x(2 * n + i) = !rows_.sheared_across(i) ? right_side(2 * n + i)
                       : sticks                 ? inverse_.shear_y(node)
                                                : right_side(2 * n + i) + rows_.along_y(i) * x(i);
    }
    return x;
  }

  void prepare_border() {
    const Eigen::Index border = rows_.border(), n = rows_.contacts();
    if (border == 0) return;
    const ScaledResponse<Real> still{Field::Zero(n), Field::Zero(n), Field::Zero(n)};
    border_response_.resize(rows_.unknowns(), border);
    Matrix schur(border, border);
    for (Eigen::Index b = 0; b < border; ++b) {
      const Field unit = Field::Unit(rows_.unknowns(), rows_.unknowns() - border + b);
      border_response_.col(b) = precondition_laws(rows_(unit, still));
      schur.col(b) = -rows_.border_rows(border_response_.col(b));
    }
    border_schur_ = pseudo_inverse(schur.template cast<double>()).template cast<Real>();
  }

  LawRows<Real> rows_;
  const ActiveLaws& laws_;
  const EdgeSlip& edge_;
  KrylovOperator<Real>& influence_;
  Real per_normal_, per_slip_;
  typename KrylovOperator<Real>::Tractions tractions_, inverse_;
  typename KrylovOperator<Real>::Response moved_, response_;
  ScaledResponse<Real> scaled_;
  Matrix border_response_;  // preconditioned columns of the border
  Matrix border_schur_;     // and what they leave in the border's rows, inverted
};

}  // namespace

ContactUnknowns& ContactUnknowns::add(double factor, const ContactUnknowns& other) {
  pressure += factor * other.pressure;
  if (shear_x.size() > 0) shear_x += factor * other.shear_x;
  if (shear_y.size() > 0) shear_y += factor * other.shear_y;
  approach += factor * other.approach;
  rotation_ratio += factor * other.rotation_ratio;
  return *this;
}

ContactUnknowns NewtonSystem::unpack(const Vector& x, const LawRows<double>& rows) const {
  ContactUnknowns unknowns;
  const Eigen::Index n = rows.contacts(), size = problem_.grid.size();
  const auto scatter = [&](Eigen::Index component) {
    Vector field = Vector::Zero(size);
    for (Eigen::Index i = 0; i < n; ++i) field(laws_.contact[static_cast<std::size_t>(i)]) = x(component * n + i);
    return field;
  };
  unknowns.pressure = scatter(0);
  if (rows.components() > 1) unknowns.shear_x = scatter(1);
  if (rows.components() > 2) unknowns.shear_y = scatter(2);
  Eigen::Index at = rows.components() * n;
  unknowns.approach = rows.approach_unknown() ? x(at++) * influence_.self_normal() : 0;
  unknowns.rotation_ratio = rows.rotation_unknown() ? x(at) * influence_.self_slip() : 0;
  return unknowns;
}

/// What a unit of one component of the traction at a node of the contact does at all of them.
ScaledResponse<double> NewtonSystem::response_to(const InfluenceTable& table, const LawRows<double>& rows,
                                                 Eigen::Index component, Eigen::Index source) const {
  using enum Direction;
  const Eigen::Index n = rows.contacts(), components = rows.components();
  const SurfaceGrid& grid = problem_.grid;
  const double per_normal = 1 / influence_.self_normal();
  const double per_slip = 1 / (influence_.self_slip() * grid.spacing_x);
  const Direction force = component == 0 ? w : component == 1 ? u : v;
  const double strength = (component == 0 ? -1 : 1) * grid.cell_area();  // pressure pushes down
  const double parity = component == 2 ? -1 : 1;                         // of the mirror image at y < 0
  const int source_column = static_cast<int>(source % grid.columns);
  const int source_row = static_cast<int>(source / grid.columns);
  const bool image = problem_.images(source) > 1;
  const auto moved = [&](Direction displacement, int column, int row) {
    double value = table(displacement, force, column - source_column, row - source_row);
    if (image) value += parity * table(displacement, force, column - source_column, row + source_row);
    return strength * value;
  };
  ScaledResponse<double> response{Vector::Zero(n), Vector::Zero(n), Vector::Zero(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index node = laws_.contact[static_cast<std::size_t>(i)];
    const int column = static_cast<int>(node % grid.columns), row = static_cast<int>(node / grid.columns);
    const auto slip = [&](Direction along) {
      return (moved(along, column + 1, row) - moved(along, column, row)) * per_slip;
    };
    // On a line shear along the axle and all else do not know of each other.
    const bool in_plane = problem_.plane || component < 2, across = problem_.plane || component == 2;
    response.w(i) = in_plane ? moved(w, column, row) * per_normal : 0;
    if (components > 1) response.slip_x(i) = in_plane ? slip(u) : 0;
    if (components > 2) response.slip_y(i) = across ? slip(v) : 0;
  }
  if (component == 0 || !problem_.edge.curve().known()) return response;
  Vector along = Vector::Zero(grid.size()), aside = along, of_edge_x = along, of_edge_y = along;
  (component == 1 ? along : aside)(source) = 1 / influence_.self_slip();
  problem_.edge.add(along, aside, of_edge_x, of_edge_y);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index node = laws_.contact[static_cast<std::size_t>(i)];
    response.slip_x(i) += of_edge_x(node);
    response.slip_y(i) += of_edge_y(node);
  }
  return response;
}

LinearStep NewtonSystem::solve_dense(const InfluenceTable& table, const LawResiduals& residuals) const {
  const LawRows<double> rows(problem_, laws_);
  const Eigen::Index n = rows.contacts(), size = rows.unknowns(), components = rows.components();
  require_factorisation(static_cast<double>(size),
                        message_text("a factorisation for ", n, " nodes of ", problem_.grid.spacing_x, " m"));
  Eigen::MatrixXd matrix(size, size);
  for (Eigen::Index component = 0; component < components; ++component)
    for (Eigen::Index j = 0; j < n; ++j) {
      require_time();
      const Eigen::Index column = component * n + j, source = laws_.contact[static_cast<std::size_t>(j)];
      matrix.col(column) = rows(Vector::Unit(size, column), response_to(table, rows, component, source));
    }
  // Columns of d and omega.
  const ScaledResponse<double> nothing{Vector::Zero(n), Vector::Zero(n), Vector::Zero(n)};
  for (Eigen::Index b = components * n; b < size; ++b) matrix.col(b) = rows(Vector::Unit(size, b), nothing);
  LinearStep result;
  const Vector x = SquareSystem(matrix).solve(pack(residuals, rows));
  result.solved = x.allFinite();
  if (result.solved) result.step = unpack(x, rows);
  return result;
}

namespace {

template <class Real>
KrylovResult<double> iterate(const ContactProblem& problem, const InfluenceOperator& influence, const ActiveLaws& laws,
                             const Vector& right_side, double tolerance, int most_iterations) {
  KrylovRows<Real> rows(problem, influence, laws);
  using Field = typename KrylovRows<Real>::Field;
  const KrylovResult<Real> found =
      gmres<Real>([&](const Field& x) { return rows.apply(x); }, [&](const Field& x) { return rows.precondition(x); },
                  right_side.cast<Real>(), tolerance, most_iterations);
  return {found.x.template cast<double>(), found.iterations, static_cast<double>(found.relative_residual)};
}

}  // namespace

Vector NewtonSystem::apply(const Vector& x, const LawRows<double>& rows) const {
  const ContactUnknowns increment = unpack(x, rows);
  const Displacements moved = influence_.apply(increment.pressure, increment.shear_x, increment.shear_y);
  const SurfaceGrid& grid = problem_.grid;
  const double per_normal = 1 / influence_.self_normal(), per_slip = 1 / influence_.self_slip();
  const Eigen::Index n = rows.contacts();
  ScaledResponse<double> response{Vector(n), Vector(n), Vector(n)};
  Displacements slip;  // on all nodes, as the edge's
  for (Vector* field : {&slip.u, &slip.v}) field->setZero(grid.size());
  const auto at_node = [&](Eigen::Index node) { return node + node / grid.columns; };  // a row has one column more
  for (const Eigen::Index node : laws_.contact) {
    const Eigen::Index at = at_node(node);
    if (rows.components() > 1) slip.u(node) = (moved.u(at + 1) - moved.u(at)) / grid.spacing_x;
    if (rows.components() > 2) slip.v(node) = (moved.v(at + 1) - moved.v(at)) / grid.spacing_x;
  }
  if (rows.components() > 2) problem_.edge.add(increment.shear_x, increment.shear_y, slip.u, slip.v);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index node = laws_.contact[static_cast<std::size_t>(i)];
    response.w(i) = moved.w(at_node(node)) * per_normal;
    response.slip_x(i) = slip.u(node) * per_slip;
    response.slip_y(i) = slip.v(node) * per_slip;
  }
  return rows(x, response);
}

LinearStep NewtonSystem::solve_krylov(const LawResiduals& residuals, double tolerance, int most_iterations) const {
  const LawRows<double> rows(problem_, laws_);
  const Vector right_side = pack(residuals, rows);
  const double size = right_side.norm(), target = tolerance * size;
  LinearStep result;
  if (!(size > 0)) return result;
  Vector x = Vector::Zero(right_side.size()), missing = right_side;
  double reached = size;
  // Single precision first, on what is missing in double precision.
  while (influence_.single_precision_suffices() && reached > target) {
    const KrylovResult<double> found =
        iterate<float>(problem_, influence_, laws_, missing / reached, target / reached, most_iterations);
    result.iterations += found.iterations;
    const Vector candidate = x + reached * found.x;
    const Vector left = right_side - apply(candidate, rows);
    const double now = left.norm();
    if (now < reached) {
      x = candidate;
      missing = left;
    }
    // The recurrence's estimate is a little off in single precision.
    if (!(now <= std::max(1.2 * target, 0.05 * reached))) influence_.demand_double_precision();
    reached = std::min(now, reached);
    if (reached <= 1.2 * target) break;
  }
  if (reached > 1.2 * target) {
    const KrylovResult<double> found =
        iterate<double>(problem_, influence_, laws_, missing / reached, target / reached, most_iterations);
    result.iterations += found.iterations;
    x += reached * found.x;
    reached *= found.relative_residual;
  }
  result.solved = x.allFinite() && reached < 0.1 * size;
  if (result.solved) result.step = unpack(x, rows);
  return result;
}

}  // namespace rollres
