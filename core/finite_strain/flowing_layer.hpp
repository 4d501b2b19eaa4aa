#pragma once

/// Viscoelastic layers at finite strain that flow through a mesh at rest (core/finite_strain/README.md, sections 1 to
/// 3): forces on the nodes, their exact derivative, and the part of it that joins neighbouring cells alone.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/algebra/block_tridiagonal.hpp"
#include "core/finite_strain/hyperelastic.hpp"
#include "core/finite_strain/layer_mesh.hpp"
#include "core/finite_strain/line_memory.hpp"
#include "core/numerics/vector.hpp"

namespace rollres {

/// G* = modulus - sum_j modulus_j / (1 + i omega theta_j), bulk modulus over shear modulus `bulk_ratio`.
struct FlowingMaterial {
  struct Term {
    double modulus, memory_length;  // [Pa], V theta [m]
  };
  double modulus = 1;         // at once [Pa]
  std::vector<Term> terms;    // none: elastic
  double bulk_ratio = 1;      // [1]
  bool bulk_relaxes = false;  // nu < 1/2: the bulk modulus is proportional to G*
  YeohRatios yeoh = {};       // of the elastic stress and of what is remembered of it
};

/// Places of unknowns: for each column of nodes from the leading end, the displacements (x, z) of its nodes from the
/// surface down, then `extra` unknowns of the contact.
struct Numbering {
  int free_rows = 0, extra = 0, columns = 0;
  Eigen::Index stride() const { return 2 * free_rows + extra; }
  Eigen::Index size() const { return columns * stride(); }
  Eigen::Index node(int column, int row) const { return column * stride() + 2 * row; }
  Eigen::Index surface(int column, int which) const { return column * stride() + 2 * free_rows + which; }
};

class FlowingLayer {
 public:
  /// @param materials  one for each of the mesh's layers
  FlowingLayer(LayerMesh mesh, std::vector<FlowingMaterial> materials, int extra);

  const LayerMesh& mesh() const { return mesh_; }
  const Numbering& numbering() const { return numbering_; }
  Eigen::Index cells() const { return static_cast<Eigen::Index>(cells_.size()); }

  /// Takes displacements and, for each cell, the coefficients of its pressure 1, xi, eta.
  /// @return false if a cell is folded
  bool evaluate(const Vector& displacements, const Eigen::Matrix3Xd& pressures);

  /// Columns of nodes that are held: the leading one, and the last one of a cover, which meets it behind.
  bool is_held(int column) const { return column == 0 || (mesh_.curvature > 0 && column + 1 == numbering_.columns); }

  /// Internal forces; 0 in the rows of the contact and of held columns.
  const Vector& forces() const { return forces_; }
  /// Change of the internal forces with displacements, the pressures following; 0 in the same rows.
  Vector apply(const Vector& change) const { return sweep(change, false); }
  /// Change of the internal forces by what the pressures still lack at no change of displacements.
  Vector pressure_defect() const { return sweep(Vector::Zero(numbering_.size()), true); }
  /// Change of the pressures that goes with one of displacements.
  Eigen::Matrix3Xd pressure_change(const Vector& change) const;
  /// Largest |lack| of volume in a cell, by its volume.
  double volume_defect() const;
  /// Adds the derivative without what a cell remembers of the cells before it.
  void add_local(BlockTridiagonal& matrix) const;

  struct Folding {
    double least = 1, largest = 1;  // of the ratios of volumes after and before a change
    double x = 0, z = 0;            // where it is least
  };
  Folding folding(const Vector& change) const;

  /// int S : dE/ds over the mesh, s downstream along the surface: what the flow through it takes, over its speed at
  /// the surface [N/m].
  double taken_power() const;

 private:
  using Strains = Eigen::Matrix<double, 27, 18>;  // three components at each of nine points
  struct Cell {
    Eigen::Matrix<double, 18, 18> local;      // pressure condensed
    Strains strain;                           // dE of each point
    Strains own_stress;                       // D dE by unit modulus
    Eigen::Matrix<double, 27, 1> total;       // stress with memory and pressure
    Eigen::Matrix<double, 27, 1> dilatation;  // V
    Eigen::Matrix<double, 18, 3> of_pressure;
    Eigen::Matrix<double, 3, 18> volume;
    Eigen::Vector3d lack;  // int psi (J - 1) - M p / bulk
    double length, height;
    std::array<double, 3> shortening;         // of the lines of flow through it
    std::array<Eigen::Matrix2d, 9> gradient;  // F
  };

  const Cell& cell(int r, int e) const { return cells_[static_cast<std::size_t>(r * mesh_.cells_along() + e)]; }
  Cell& cell(int r, int e) { return cells_[static_cast<std::size_t>(r * mesh_.cells_along() + e)]; }
  const FlowingMaterial& material(int r) const {
    return materials_[static_cast<std::size_t>(mesh_.layer[static_cast<std::size_t>(r)])];
  }
  const CellMemory& memory(int r, int e, std::size_t term) const {
    return memories_[static_cast<std::size_t>(mesh_.layer[static_cast<std::size_t>(r)])][term]
                    [static_cast<std::size_t>(e)];
  }
  Eigen::Matrix<double, 18, 1> gathered(const Vector& all, int r, int e) const;
  void scatter(const Eigen::Matrix<double, 18, 1>& part, int r, int e, Vector& all) const;
  Eigen::Vector3d pressure_change(const Cell& at, const Eigen::Matrix<double, 18, 1>& moved, double bulk,
                                  bool with_lack) const;
  struct CellPoints;
  struct RememberedStress;
  bool deform(int r, int e, const Eigen::Matrix<double, 18, 1>& moved, const Eigen::Vector3d& pressure,
              CellPoints& points);
  RememberedStress remembered(int r, int e, const CellPoints& points,
                              std::vector<Eigen::Matrix<double, 4, 3>>& inflow) const;
  void assemble(int r, int e, const CellPoints& points, const RememberedStress& remembered);
  bool evaluate_row(int r, const Vector& displacements, const Eigen::Matrix3Xd& pressures);
  Vector sweep(const Vector& change, bool with_lack) const;

  LayerMesh mesh_;
  std::vector<FlowingMaterial> materials_;
  Numbering numbering_;
  std::vector<std::vector<std::vector<CellMemory>>> memories_;  // of a layer, a term, a column of cells
  std::vector<Cell> cells_;
  Vector forces_;
};

}  // namespace rollres
