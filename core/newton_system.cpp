#include "core/newton_system.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

#include "core/krylov.hpp"

namespace rollres {

ContactUnknowns& ContactUnknowns::add(double factor, const ContactUnknowns& other) {
  pressure += factor * other.pressure;
  if (shear_x.size() > 0) shear_x += factor * other.shear_x;
  if (shear_y.size() > 0) shear_y += factor * other.shear_y;
  approach += factor * other.approach;
  rotation_ratio += factor * other.rotation_ratio;
  return *this;
}

NewtonSystem::NewtonSystem(const ContactProblem& problem, const InfluenceOperator& influence, const ActiveLaws& laws)
    : problem_(problem),
      influence_(influence),
      laws_(laws),
      components_(!problem.friction ? 1
                  : problem.sphere  ? 3
                                    : 2),
      approach_unknown_(problem.load_given()),
      rotation_unknown_(problem.friction && !problem.rotation_given()),
      force_scale_(problem.load.of_pressure.maxCoeff() * std::sqrt(static_cast<double>(laws.contact.size()))) {
  border_ = (approach_unknown_ ? 1 : 0) + (rotation_unknown_ ? 1 : 0);
}

Vector NewtonSystem::pack(const LawResiduals& residuals) const {
  Vector packed(unknowns());
  const Eigen::Index n = contacts();
  packed.head(n) = residuals.normal;
  if (components_ > 1) packed.segment(n, n) = residuals.shear_x;
  if (components_ > 2) packed.segment(2 * n, n) = residuals.shear_y;
  Eigen::Index at = components_ * n;
  if (approach_unknown_) packed(at++) = residuals.load / force_scale_;
  if (rotation_unknown_) packed(at) = residuals.drive / force_scale_;
  return packed;
}

ContactUnknowns NewtonSystem::unpack(const Vector& x) const {
  ContactUnknowns unknowns;
  const Eigen::Index n = contacts(), size = problem_.grid.size();
  const auto scatter = [&](Eigen::Index component) {
    Vector field = Vector::Zero(size);
    for (Eigen::Index i = 0; i < n; ++i) field(laws_.contact[static_cast<std::size_t>(i)]) = x(component * n + i);
    return field;
  };
  unknowns.pressure = scatter(0);
  if (components_ > 1) unknowns.shear_x = scatter(1);
  if (components_ > 2) unknowns.shear_y = scatter(2);
  Eigen::Index at = components_ * n;
  unknowns.approach = approach_unknown_ ? x(at++) * influence_.self_normal() : 0;
  unknowns.rotation_ratio = rotation_unknown_ ? x(at) * influence_.self_slip() : 0;
  return unknowns;
}

Vector NewtonSystem::rows_from(const ContactUnknowns& increment, const Displacements& moved) const {
  Vector rows(unknowns());
  const Eigen::Index n = contacts();
  const int columns = problem_.grid.columns;
  const double per_normal = 1 / influence_.self_normal();
  const double per_slip = 1 / influence_.self_slip(), friction = problem_.scene.friction_coefficient;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto c = static_cast<std::size_t>(i);
    const Eigen::Index node = laws_.contact[c];
    const Eigen::Index row = node / columns, at = row * (columns + 1) + node % columns;
    rows(i) = -(moved.w(at) + increment.approach) * per_normal;
    if (components_ == 1) continue;
    const double slip_x = (moved.u(at + 1) - moved.u(at)) / problem_.grid.spacing_x -
                          problem_.rolling_radius(node) * increment.rotation_ratio;
    const double slip_y = components_ > 2 ? (moved.v(at + 1) - moved.v(at)) / problem_.grid.spacing_x : 0;
    const double tx = increment.shear_x(node), ty = components_ > 2 ? increment.shear_y(node) : 0;
    double row_x, row_y;
    if (laws_.zone[c] == Zone::stick) {
      row_x = -slip_x * per_slip;
      row_y = -slip_y * per_slip;
    } else {
      const double nx = laws_.direction_x(i), ny = laws_.direction_y(i), beta = laws_.beta(i);
      const double qx = tx + slip_x * per_slip, qy = ty + slip_y * per_slip, along = nx * qx + ny * qy;
      row_x = tx - friction * nx * increment.pressure(node) - beta * (qx - nx * along);
      row_y = ty - friction * ny * increment.pressure(node) - beta * (qy - ny * along);
    }
    rows(n + i) = row_x;
    // On the axis of symmetry tau_y vanishes.
    if (components_ > 2) rows(2 * n + i) = problem_.grid.first_row + row == 0 ? ty : row_y;
  }
  Eigen::Index at = components_ * n;
  const Vector none = Vector::Zero(problem_.grid.size());
  const Vector& shear = components_ > 1 ? increment.shear_x : none;
  if (approach_unknown_) rows(at++) = problem_.load(increment.pressure, shear) / force_scale_;
  if (rotation_unknown_) rows(at) = problem_.drive(increment.pressure, shear) / force_scale_;
  return rows;
}

Vector NewtonSystem::apply(const Vector& x) const {
  const ContactUnknowns increment = unpack(x);
  return rows_from(increment, influence_.apply(increment.pressure, increment.shear_x, increment.shear_y));
}

LinearStep NewtonSystem::solve_dense(const InfluenceTable& table, const LawResiduals& residuals) const {
  const Eigen::Index n = contacts(), size = unknowns();
  const SurfaceGrid& grid = problem_.grid;
  const double area = grid.cell_area();
  Eigen::MatrixXd matrix(size, size);
  ContactUnknowns unit;
  unit.pressure = Vector::Zero(grid.size());
  if (components_ > 1) unit.shear_x = unit.pressure;
  if (components_ > 2) unit.shear_y = unit.pressure;
  Displacements moved;
  const Eigen::Index outputs = static_cast<Eigen::Index>(grid.columns + 1) * grid.rows;
  moved.w = Vector::Zero(outputs);
  if (components_ > 1) moved.u = moved.w;
  if (components_ > 2) moved.v = moved.w;

  using enum Direction;
  for (Eigen::Index component = 0; component < components_; ++component) {
    const Direction force = component == 0 ? w : component == 1 ? u : v;
    const double strength = component == 0 ? -area : area;  // pressure pushes down
    const double parity = component == 2 ? -1 : 1;          // of the mirror image at y < 0
    Vector& traction = component == 0 ? unit.pressure : component == 1 ? unit.shear_x : unit.shear_y;
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::Index source = laws_.contact[static_cast<std::size_t>(j)];
      const int source_column = static_cast<int>(source % grid.columns);
      const int source_row = static_cast<int>(source / grid.columns);
      const bool image = problem_.sphere && source_row > 0;
      const auto response = [&](Direction displacement, int column, int row) {
        double value = table(displacement, force, column - source_column, row - source_row);
        if (image) value += parity * table(displacement, force, column - source_column, row + source_row);
        return strength * value;
      };
      for (const Eigen::Index node : laws_.contact) {
        const int column = static_cast<int>(node % grid.columns), row = static_cast<int>(node / grid.columns);
        const Eigen::Index at = static_cast<Eigen::Index>(row) * (grid.columns + 1) + column;
        moved.w(at) = response(w, column, row);
        for (int next = 0; next < 2; ++next) {
          if (components_ > 1) moved.u(at + next) = response(u, column + next, row);
          if (components_ > 2) moved.v(at + next) = response(v, column + next, row);
        }
      }
      traction(source) = 1;
      matrix.col(component * n + j) = rows_from(unit, moved);
      traction(source) = 0;
    }
  }
  // Columns of d and omega.
  for (Vector* field : {&moved.w, &moved.u, &moved.v}) field->setZero();
  for (Eigen::Index b = 0; b < border_; ++b) {
    Vector x = Vector::Zero(size);
    x(components_ * n + b) = 1;
    matrix.col(components_ * n + b) = rows_from(unpack(x), moved);
  }
  LinearStep result;
  const Vector x = Eigen::PartialPivLU<Eigen::MatrixXd>(matrix).solve(pack(residuals));
  result.solved = x.allFinite();
  if (result.solved) result.step = unpack(x);
  return result;
}

Vector NewtonSystem::precondition_laws(const Vector& right_side) const {
  const Eigen::Index n = contacts(), size = problem_.grid.size();
  Vector lowered = Vector::Zero(size);
  Vector slip_x = components_ > 1 ? Vector(Vector::Zero(size)) : Vector();
  Vector slip_y = components_ > 2 ? Vector(Vector::Zero(size)) : Vector();
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto c = static_cast<std::size_t>(i);
    const Eigen::Index node = laws_.contact[c];
    lowered(node) = right_side(i) * influence_.self_normal();
    if (components_ == 1 || laws_.zone[c] != Zone::stick) continue;
    slip_x(node) = right_side(n + i) * influence_.self_slip();
    if (components_ > 2) slip_y(node) = right_side(2 * n + i) * influence_.self_slip();
  }
  const Tractions tractions = influence_.approximate_inverse(lowered, slip_x, slip_y);

  Vector x = Vector::Zero(unknowns());
  const double friction = problem_.scene.friction_coefficient;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto c = static_cast<std::size_t>(i);
    const Eigen::Index node = laws_.contact[c];
    x(i) = tractions.pressure(node);
    if (components_ == 1) continue;
    const bool stick = laws_.zone[c] == Zone::stick;
    x(n + i) = stick ? tractions.shear_x(node) : right_side(n + i) + friction * laws_.direction_x(i) * x(i);
    if (components_ == 2) continue;
    const bool axis = problem_.grid.first_row + node / problem_.grid.columns == 0;
    x(2 * n + i) = axis    ? right_side(2 * n + i)
                   : stick ? tractions.shear_y(node)
                           : right_side(2 * n + i) + friction * laws_.direction_y(i) * x(i);
  }
  return x;
}

Vector NewtonSystem::precondition(const Vector& right_side) const {
  Vector x = precondition_laws(right_side);
  if (border_ == 0) return x;
  const Eigen::Index first = components_ * contacts();
  // Rows of load and drive on what the laws alone would give; the border's unknowns make up the difference.
  const Vector rows = rows_from(unpack(x), {Vector::Zero((problem_.grid.columns + 1) * problem_.grid.rows),
                                            Vector::Zero((problem_.grid.columns + 1) * problem_.grid.rows),
                                            Vector::Zero((problem_.grid.columns + 1) * problem_.grid.rows)});
  const Vector border = border_schur_ * (right_side.tail(border_) - rows.tail(border_));
  x -= border_response_ * border;
  x.segment(first, border_) = border;
  return x;
}

LinearStep NewtonSystem::solve_krylov(const LawResiduals& residuals, double tolerance, int most_iterations) const {
  const Eigen::Index first = components_ * contacts();
  if (border_ > 0) {
    const Eigen::Index outputs = static_cast<Eigen::Index>(problem_.grid.columns + 1) * problem_.grid.rows;
    const Displacements still{Vector::Zero(outputs), Vector::Zero(outputs), Vector::Zero(outputs)};
    border_response_ = Eigen::MatrixXd::Zero(unknowns(), border_);
    Eigen::MatrixXd schur(border_, border_);
    for (Eigen::Index b = 0; b < border_; ++b) {
      Vector x = Vector::Zero(unknowns());
      x(first + b) = 1;
      border_response_.col(b) = precondition_laws(rows_from(unpack(x), still));
      schur.col(b) = -rows_from(unpack(border_response_.col(b)), still).tail(border_);
    }
    border_schur_ = schur.completeOrthogonalDecomposition().pseudoInverse();
  }
  const KrylovResult krylov =
      gmres([&](const Vector& x) { return apply(x); }, [&](const Vector& x) { return precondition(x); },
            pack(residuals), tolerance, most_iterations);
  LinearStep result;
  result.iterations = krylov.iterations;
  result.solved = krylov.x.allFinite() && krylov.relative_residual < 0.1;
  if (result.solved) result.step = unpack(krylov.x);
  return result;
}

}  // namespace rollres
