#pragma once

/// The normal-contact subroutine of Zehil and Gavin (2013, sections 3.1 and 4.1).
///
/// For given shear forces the nodes in contact follow the profile of the body, w = profile - d, press on it
/// (F_W <= adhesion threshold times the cell's area) and no free node reaches into the body.
/// Phase A adds all free nodes that reach into the body (eq. 9) until there are none; phase B then frees all nodes that
/// bear more tension than the threshold allows; a new conflict leads back to phase A. Each iteration solves the
/// system (12) of the cylinder,
///     C_WW(c,c) F_W + d = profile - C_WU(c,:) F_U,    sum(cos(phi) F_W) = -P - sum(x F_U)/R,
/// or (21) of the sphere,
///     C_WW(c,c) F_W + d = profile - C_WU(c,:) F_U - C_WV(c,:) F_V,    sum(F_W) = -P;
/// with the approach d given, without its last row and column.
///
/// With an adhesion threshold above zero many contact areas obey these laws. A body that rolls leaves its contact by
/// pulling, so the widest area is wanted: the iteration then begins with all nodes, and phase B peels, freeing only
/// nodes that bear more than half of the largest tension.
///
/// Two safeguards are added. One iteration of phase A at most doubles the extent of the contact, because a load on far
/// too few nodes sinks much deeper than it finally does. And once a set of contact nodes comes back, single nodes
/// change from then on (the last one in the grid that breaks a law; Murty 1974), which cannot cycle for a P-matrix.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/influence/influence.hpp"
#include "core/model/contact_model.hpp"
#include "core/paper_method/offset_kernel.hpp"
#include "core/paper_method/subset_solver.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

struct NormalContact {
  Eigen::VectorXd force;     // F_W at every node of the grid [N; cylinder: N/m], < 0 in compression
  std::vector<int> contact;  // nodes in contact, in ascending order
  double approach = 0;       // d [m]
  int iterations = 0;        // linear systems solved
  bool converged = false;
  std::string reason;  // why not
};

/// Keeps the matrix and its decomposition between calls.
class NormalContactSolver {
 public:
  NormalContactSolver(const ContactModel& model, const InfluenceTable& table, const SurfaceGrid& grid);
  NormalContactSolver(const NormalContactSolver&) = delete;
  NormalContactSolver& operator=(const NormalContactSolver&) = delete;

  /// @param shear_x, shear_y nodal forces F_U, F_V over the grid (shear_y empty for a cylinder)
  /// @param start contact nodes to begin with; empty: the one node under the axis, or all if there is adhesion
  NormalContact solve(const Eigen::VectorXd& shear_x, const Eigen::VectorXd& shear_y, std::vector<int> start = {});

  const SubsetSolver& system() const { return system_; }

 private:
  double element(int row, int column) const;
  std::vector<int> first_contact() const;
  /// w at every node from the shear forces.
  Eigen::VectorXd lift_of(const Eigen::VectorXd& shear_x, const Eigen::VectorXd& shear_y) const;
  /// Solves (12) or (21) for the nodes in contact. False if the system is singular.
  bool press(NormalContact& state, const Eigen::VectorXd& lift, const Eigen::VectorXd& shear_x);
  /// Free nodes that reach into the body (9), and nodes in contact that bear too much tension.
  std::vector<int> conflicts_of(const NormalContact& state, const Eigen::VectorXd& lift) const;
  std::vector<int> tense_of(const NormalContact& state) const;
  std::vector<int> one_doubling(const std::vector<int>& contact, const std::vector<int>& conflicts) const;

  SurfaceGrid grid_;
  OffsetKernel ww_, wu_, wv_;
  bool load_given_ = true;
  double load_ = 0, approach_ = 0, largest_tension_ = 0;
  Eigen::VectorXd profile_;               // at each node, infinite beyond the body [m]
  Eigen::VectorXd of_normal_, of_shear_;  // P = sum(-of_normal F_W + of_shear F_U) [1]
  double scale_ = 1;                      // C_WW(0) [m/N]
  std::vector<int> all_;                  // nodes of the grid
  SubsetSolver system_;                   // index grid.size() stands for the approach
};

}  // namespace rollres
