#include "core/finite_strain/flowing_layer.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/finite_strain/point_shapes.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Nodes = PointShapes::Nodes;

}  // namespace

FlowingLayer::FlowingLayer(LayerMesh mesh, std::vector<FlowingMaterial> materials, int extra)
    : mesh_(std::move(mesh)),
      materials_(std::move(materials)),
      numbering_{mesh_.free_rows(), extra, mesh_.columns()},
      forces_(Vector::Zero(numbering_.size())) {
  const std::size_t cells =
      static_cast<std::size_t>(mesh_.cells_along()) * static_cast<std::size_t>(mesh_.cells_down());
  require_memory(static_cast<double>(cells) * sizeof(Cell), "the mesh");
  cells_.resize(cells);
  for (const FlowingMaterial& solid : materials_) {
    auto& terms = memories_.emplace_back();
    for (const FlowingMaterial::Term& term : solid.terms) {
      auto& along = terms.emplace_back();
      for (int e = 0; e < mesh_.cells_along(); ++e) along.push_back(cell_memory(mesh_.length(e) / term.memory_length));
    }
  }
}

Eigen::Matrix<double, 18, 1> FlowingLayer::gathered(const Vector& all, int r, int e) const {
  Eigen::Matrix<double, 18, 1> part = Eigen::Matrix<double, 18, 1>::Zero();
  const bool base = r + 1 == mesh_.cells_down();
  for (int i = 0; i < 3; ++i)
    part.segment(6 * i, base ? 4 : 6) = all.segment(numbering_.node(2 * e + i, 2 * r), base ? 4 : 6);
  return part;
}

void FlowingLayer::scatter(const Eigen::Matrix<double, 18, 1>& part, int r, int e, Vector& all) const {
  const bool base = r + 1 == mesh_.cells_down();
  for (int i = 0; i < 3; ++i)
    if (!is_held(2 * e + i))
      all.segment(numbering_.node(2 * e + i, 2 * r), base ? 4 : 6) += part.segment(6 * i, base ? 4 : 6);
}

bool FlowingLayer::evaluate(const Vector& displacements, const Eigen::Matrix3Xd& pressures) {
  forces_.setZero();
  bool whole = true;
  for (int r = 0; r < mesh_.cells_down(); ++r) whole = evaluate_row(r, displacements, pressures) && whole;
  return whole;
}

/// What the points of one cell have by themselves.
struct FlowingLayer::CellPoints {
  std::array<Hyperelastic, 9> solid;
  Eigen::Matrix<double, 4, 9> own;  // stress and pressure by unit modulus
  std::array<Nodes, 9> slope_x, slope_z;
};

/// Stress with memory, and its derivatives by the points of the cell: A of (H6).
struct FlowingLayer::RememberedStress {
  Eigen::Matrix<double, 4, 9> total;
  Matrix3d within, pressure_within;
};

bool FlowingLayer::evaluate_row(int r, const Vector& displacements, const Eigen::Matrix3Xd& pressures) {
  require_time();
  const FlowingMaterial& solid = material(r);
  // What flows in: mean stresses and pressure at the three lines of points, for each term.
  std::vector<Eigen::Matrix<double, 4, 3>> inflow(solid.terms.size(), Eigen::Matrix<double, 4, 3>::Zero());
  CellPoints points;
  for (int e = 0; e < mesh_.cells_along(); ++e) {
    if (!deform(r, e, gathered(displacements, r, e), pressures.col(r * mesh_.cells_along() + e), points)) return false;
    assemble(r, e, points, remembered(r, e, points, inflow));
  }
  return true;
}

/// Strains and stresses of the points of a cell. @return whether none of them is turned inside out
bool FlowingLayer::deform(int r, int e, const Eigen::Matrix<double, 18, 1>& moved, const Vector3d& pressure,
                          CellPoints& points) {
  const PointShapes& shapes = point_shapes();
  const FlowingMaterial& solid = material(r);
  Cell& at = cell(r, e);
  at.length = mesh_.length(e);
  at.height = mesh_.height(r);
  const double area = at.length * at.height;
  for (std::size_t k = 0; k < 3; ++k)
    at.shortening[k] = mesh_.shortening(mesh_.z[static_cast<std::size_t>(r)] - gauss_places[k] * at.height);
  bool whole = true;
  at.lack = -area * pressure_masses.cwiseProduct(pressure) / solid.bulk_ratio;
  for (std::size_t g = 0; g < 9; ++g) {
    const auto i = static_cast<Eigen::Index>(g);
    points.slope_x[g] = -shapes.along[g] / (at.length * at.shortening[g % 3]);
    points.slope_z[g] = -shapes.down[g] / at.height;
    const double place = mesh_.x[static_cast<std::size_t>(e)] - gauss_places[g / 3] * at.length;
    at.gradient[g] = mesh_.frame(place) + gradient_of(moved, points.slope_x[g], points.slope_z[g]);
    const Hyperelastic& here = points.solid[g] = hyperelastic(at.gradient[g], solid.yeoh);
    whole = whole && here.volume > 0;
    at.strain.middleRows<3>(3 * i) = strain_rows(at.gradient[g], points.slope_x[g], points.slope_z[g]);
    at.own_stress.middleRows<3>(3 * i).noalias() = here.tangent * at.strain.middleRows<3>(3 * i);
    at.dilatation.segment<3>(3 * i) = here.dilatation;
    points.own.col(i) << here.stress, shapes.pressure[g].dot(pressure);
    at.lack += area * shapes.weight[g] * (here.volume - 1) * shapes.pressure[g];
  }
  return whole;
}

/// @param inflow  what flows into the cell; what flows out of it afterwards
FlowingLayer::RememberedStress FlowingLayer::remembered(int r, int e, const CellPoints& points,
                                                        std::vector<Eigen::Matrix<double, 4, 3>>& inflow) const {
  const FlowingMaterial& solid = material(r);
  RememberedStress stress{solid.modulus * points.own, solid.modulus * Matrix3d::Identity(), Matrix3d()};
  for (std::size_t j = 0; j < solid.terms.size(); ++j) {
    const CellMemory& past = memory(r, e, j);
    const double modulus = solid.terms[j].modulus;
    stress.within -= modulus * past.weight;
    for (int k = 0; k < 3; ++k) {
      const auto line = [&](int i) { return points.own.col(3 * i + k); };
      for (int i = 0; i < 3; ++i)
        stress.total.col(3 * i + k) -= modulus * (past.decay(i) * inflow[j].col(k) + past.weight(i, 0) * line(0) +
                                                  past.weight(i, 1) * line(1) + past.weight(i, 2) * line(2));
      inflow[j].col(k) =
          past.through * inflow[j].col(k) + past.out(0) * line(0) + past.out(1) * line(1) + past.out(2) * line(2);
    }
  }
  stress.pressure_within = solid.bulk_relaxes ? stress.within : Matrix3d(solid.modulus * Matrix3d::Identity());
  if (!solid.bulk_relaxes) stress.total.row(3) = solid.modulus * points.own.row(3);
  return stress;
}

/// Forces of a cell and their derivatives by its displacements and pressures.
void FlowingLayer::assemble(int r, int e, const CellPoints& points, const RememberedStress& remembered) {
  const PointShapes& shapes = point_shapes();
  const auto& [total, within, pressure_within] = remembered;
  Cell& at = cell(r, e);
  const double area = at.length * at.height;
  Eigen::Matrix<double, 18, 1> force = Eigen::Matrix<double, 18, 1>::Zero();
  at.local.setZero();
  at.of_pressure.setZero();
  at.volume.setZero();
  for (int g = 0; g < 9; ++g) {
    const auto point = static_cast<std::size_t>(g);
    const int i = g / 3, k = g % 3;
    const double measure = area * shapes.weight[point], weight = measure * at.shortening[point % 3];
    const Vector3d v = points.solid[point].dilatation;
    const Vector3d stress = total.col(g).head<3>() + total(3, g) * v;
    const auto strain = at.strain.middleRows<3>(3 * g);
    at.total.segment<3>(3 * g) = stress;
    force.noalias() += weight * strain.transpose() * stress;
    Eigen::Matrix<double, 3, 18> change = total(3, g) * points.solid[point].of_pressure * strain;
    Vector3d of_pressure = Vector3d::Zero();
    for (int n = 0; n < 3; ++n) {
      if (within(i, n) != 0) change.noalias() += within(i, n) * at.own_stress.middleRows<3>(3 * (3 * n + k));
      of_pressure += pressure_within(i, n) * shapes.pressure[static_cast<std::size_t>(3 * n + k)];
    }
    at.local.noalias() += weight * strain.transpose() * change;
    const Eigen::Matrix<double, 18, 1> widened = strain.transpose() * v;
    at.of_pressure.noalias() += weight * widened * of_pressure.transpose();
    at.volume.noalias() += measure * shapes.pressure[point] * widened.transpose();
    const Nodes &x = points.slope_x[point], &z = points.slope_z[point];
    const Nodes along = stress(0) * x + stress(2) * z, down = stress(2) * x + stress(1) * z;
    for (int n = 0; n < 9; ++n)
      for (int m = 0; m < 9; ++m) {
        const double geometric = weight * (x(m) * along(n) + z(m) * down(n));
        at.local(2 * m, 2 * n) += geometric;
        at.local(2 * m + 1, 2 * n + 1) += geometric;
      }
  }
  const Vector3d compliance = material(r).bulk_ratio / area * pressure_masses.cwiseInverse();
  at.local.noalias() += at.of_pressure * compliance.asDiagonal() * at.volume;
  scatter(force, r, e, forces_);
}

Vector3d FlowingLayer::pressure_change(const Cell& at, const Eigen::Matrix<double, 18, 1>& moved, double bulk,
                                       bool with_lack) const {
  Vector3d widened = at.volume * moved;
  if (with_lack) widened += at.lack;
  return bulk / (at.length * at.height) * widened.cwiseQuotient(pressure_masses);
}

Eigen::Matrix3Xd FlowingLayer::pressure_change(const Vector& change) const {
  Eigen::Matrix3Xd changes(3, cells());
  for (int r = 0; r < mesh_.cells_down(); ++r)
    for (int e = 0; e < mesh_.cells_along(); ++e)
      changes.col(r * mesh_.cells_along() + e) =
          pressure_change(cell(r, e), gathered(change, r, e), material(r).bulk_ratio, true);
  return changes;
}

double FlowingLayer::volume_defect() const {
  double worst = 0;
  for (const Cell& at : cells_) worst = std::max(worst, at.lack.cwiseAbs().maxCoeff() / (at.length * at.height));
  return worst;
}

Vector FlowingLayer::sweep(const Vector& change, bool with_lack) const {
  require_time();
  const PointShapes& shapes = point_shapes();
  Vector forces = Vector::Zero(numbering_.size());
  for (int r = 0; r < mesh_.cells_down(); ++r) {
    const FlowingMaterial& solid = material(r);
    std::vector<Eigen::Matrix<double, 4, 3>> inflow(solid.terms.size(), Eigen::Matrix<double, 4, 3>::Zero());
    for (int e = 0; e < mesh_.cells_along(); ++e) {
      const Cell& at = cell(r, e);
      const Eigen::Matrix<double, 18, 1> moved = gathered(change, r, e);
      Eigen::Matrix<double, 18, 1> force = at.local * moved;
      if (with_lack) force += at.of_pressure * pressure_change(at, 0 * moved, solid.bulk_ratio, true);
      if (!solid.terms.empty()) {
        Eigen::Matrix<double, 27, 1> remembered = Eigen::Matrix<double, 27, 1>::Zero();
        const Eigen::Matrix<double, 27, 1> stress = at.own_stress * moved;
        Vector3d pressure = Vector3d::Zero();
        if (solid.bulk_relaxes) pressure = pressure_change(at, moved, solid.bulk_ratio, with_lack);
        for (int k = 0; k < 3; ++k) {
          Eigen::Matrix<double, 4, 3> line;
          for (int i = 0; i < 3; ++i)
            line.col(i) << stress.segment<3>(3 * (3 * i + k)),
                shapes.pressure[static_cast<std::size_t>(3 * i + k)].dot(pressure);
          Eigen::Matrix<double, 4, 3> past = Eigen::Matrix<double, 4, 3>::Zero();
          for (std::size_t j = 0; j < solid.terms.size(); ++j) {
            const CellMemory& of_cell = memory(r, e, j);
            past.noalias() += solid.terms[j].modulus * inflow[j].col(k) * of_cell.decay.transpose();
            inflow[j].col(k) = of_cell.through * inflow[j].col(k) + line * of_cell.out;
          }
          for (int i = 0; i < 3; ++i) {
            const int g = 3 * i + k;
            const double weight = at.length * at.height * shapes.weight[static_cast<std::size_t>(g)] *
                                  at.shortening[static_cast<std::size_t>(k)];
            remembered.segment<3>(3 * g) =
                weight * (past.col(i).head<3>() + past(3, i) * at.dilatation.segment<3>(3 * g));
          }
        }
        force.noalias() -= at.strain.transpose() * remembered;
      }
      scatter(force, r, e, forces);
    }
  }
  return forces;
}

void FlowingLayer::add_local(BlockTridiagonal& matrix) const {
  for (int r = 0; r < mesh_.cells_down(); ++r) {
    const int rows = r + 1 == mesh_.cells_down() ? 2 : 3;
    for (int e = 0; e < mesh_.cells_along(); ++e) {
      const Cell& at = cell(r, e);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          for (int a = 0; a < 2 * rows && !is_held(2 * e + i) && !is_held(2 * e + j); ++a)
            for (int b = 0; b < 2 * rows; ++b)
              matrix.add(numbering_.node(2 * e + i, 2 * r) + a, numbering_.node(2 * e + j, 2 * r) + b,
                         at.local(6 * i + a, 6 * j + b));
    }
  }
  for (int column = 0; column < numbering_.columns; ++column)
    for (int k = 0; k < 2 * numbering_.free_rows && is_held(column); ++k)
      matrix.add(numbering_.node(column, 0) + k, numbering_.node(column, 0) + k, 1);
}

FlowingLayer::Folding FlowingLayer::folding(const Vector& change) const {
  const PointShapes& shapes = point_shapes();
  Folding found;
  for (int r = 0; r < mesh_.cells_down(); ++r)
    for (int e = 0; e < mesh_.cells_along(); ++e) {
      const Cell& at = cell(r, e);
      const Eigen::Matrix<double, 18, 1> moved = gathered(change, r, e);
      for (std::size_t g = 0; g < 9; ++g) {
        const Matrix2d& f = at.gradient[g];
        const Matrix2d after =
            f + gradient_of(moved, -shapes.along[g] / (at.length * at.shortening[g % 3]), -shapes.down[g] / at.height);
        const double ratio = after.determinant() / f.determinant();
        found.largest = std::max(found.largest, ratio);
        if (ratio >= found.least) continue;
        found.least = ratio;
        found.x = mesh_.node_x(2 * e + 1);
        found.z = mesh_.node_z(2 * r + 1);
      }
    }
  return found;
}

double FlowingLayer::taken_power() const {
  double power = 0;
  for (int r = 0; r < mesh_.cells_down(); ++r)
    for (int k = 0; k < 3; ++k) {
      double line = 0;
      Vector3d last_strain = Vector3d::Zero(), last_stress = Vector3d::Zero();
      for (int e = 0; e < mesh_.cells_along(); ++e) {
        const Cell& at = cell(r, e);
        std::array<Vector3d, 3> strain, stress;
        for (int i = 0; i < 3; ++i) {
          const int g = 3 * i + k;
          const auto n = static_cast<std::size_t>(i);
          const Matrix2d& f = at.gradient[static_cast<std::size_t>(g)];
          const Matrix2d c = f.transpose() * f;
          strain[n] = {0.5 * (c(0, 0) - 1), 0.5 * (c(1, 1) - 1), c(0, 1)};
          stress[n] = at.total.segment<3>(3 * g);
        }
        if (e == 0 && mesh_.curvature > 0) {  // around the body it comes in as it has left
          last_strain = strain[0];
          last_stress = stress[0];
        }
        // Quadratics between the cell's points, straight lines between cells.
        const Vector3d rise = 0.5 * (strain[2] - strain[0]), bend = strain[2] - 2 * strain[1] + strain[0];
        line += 0.5 * (stress[0] + last_stress).dot(strain[0] - last_strain) + 2 * stress[1].dot(rise) +
                ((stress[2] - stress[0]).dot(bend) + (stress[2] - 2 * stress[1] + stress[0]).dot(rise)) / 3;
        last_strain = strain[2];
        last_stress = stress[2];
      }
      power += mesh_.height(r) * gauss_weights[k] * cell(r, 0).shortening[static_cast<std::size_t>(k)] * line;
    }
  return power;
}

}  // namespace rollres
