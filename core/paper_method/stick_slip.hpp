#pragma once

/// The stick-slip subroutine of Zehil and Gavin (2013, sections 3.2 and 4.2).
///
/// For a given contact area and normal forces F_W it finds the nodes that slip, the shear forces and the rotation. The
/// slip velocity of the body relative to the layer, over V, is
///     s_x = 1 + du/dx - (R(y)/R) R Omega/V,   s_y = dv/dx,   R(y) = sqrt(R^2 - y^2)  (cylinder: R)   (15, 25, 26)
/// (with consistent kinematics the body's rigid slip as indenter_shape.hpp has it, along y, too)
/// and vanishes where the body sticks; where it slips, the friction on the layer is mu |F_W| along s.
///
/// The linear systems. A sticking node i obeys the forward difference (u(i+1) - u(i))/a = (R(y)/R) R Omega/V - 1 (and
/// v(i+1) = v(i)): these are the rows of (16), or of (35) and (36), each minus the row of its neighbour ahead, and
/// (18), or (27)-(30), for the leading node. For the leading node of a stick zone the neighbour ahead slips (case A)
/// or lies outside the contact (case B); its force is then known, limiting friction or zero. The unknowns u_ref
/// drop out, every matrix element depends on the offset of two nodes only, and so one decomposition serves all
/// sets. Where the stick zone of a row of nodes is in one piece the solution is that of the printed systems; where it
/// is in several, each has its own reference displacement (the printed systems give them one, which forbids any
/// slip between them in sum). The last row is the balance of moments, eq. (17), (19) or (37); it and Omega are left
/// out if the rotation is given.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/influence/influence.hpp"
#include "core/model/indenter_shape.hpp"
#include "core/paper_method/offset_kernel.hpp"
#include "core/paper_method/subset_solver.hpp"
#include "core/scene/friction_law.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

struct StickSlip {
  Eigen::VectorXd force_x, force_y;  // F_U, F_V at every node of the grid [N; cylinder: N/m]; F_V empty for a cylinder
  std::vector<Zone> zone;            // at every node of the grid
  double rotation_ratio = 0;         // R Omega / V [1]
  int iterations = 0;                // linear systems solved
  Status status = Status::not_converged;
  std::string reason;
  double friction_needed = RollingSolution::absent;  // with no_steady_state, at these normal forces
};

/// What both subroutines share: the slip at a node for unit forces, the limit of friction, the balance of moments.
class TangentialProblem {
 public:
  TangentialProblem(const ContactModel& model, const InfluenceTable& table, const SurfaceGrid& grid);

  /// Takes over the contact area and its normal forces. @param coating what one adds to the drive's row [N]
  void set_normal(const std::vector<int>& contact, const Eigen::VectorXd& normal_force, double coating);

  /// s_x (component 0) or s_y (1) over V at the nodes, without the rotation, by the scene's difference or the forward
  /// one. Call it with the forces F_U, F_V of the nodes listed in `loaded`.
  Eigen::VectorXd slip(int component, const std::vector<int>& nodes, const std::vector<int>& loaded,
                       const Eigen::VectorXd& force_x, const Eigen::VectorXd& force_y, bool forward) const;

  /// Element of the matrix of slip for unit forces; indices 0 to size - 1 are F_U and s_x, size to 2 size - 1 are F_V
  /// and s_y, `rotation_index()` is R Omega / V and the balance of moments.
  double element(int row, int column) const;
  int rotation_index() const { return components * grid.size(); }

  /// Solves the bordered system for the sticking nodes; the forces of the slipping ones are in `state`. Sets the forces
  /// of the sticking nodes and the rotation. False if the system is singular.
  bool solve_sticking(SubsetSolver& system, const std::vector<int>& stick, const std::vector<int>& slip_nodes,
                      StickSlip& state) const;

  /// If limiting friction at every node cannot bear the moment: the friction coefficient that could, at these normal
  /// forces.
  std::optional<double> friction_needed() const;
  /// Limiting friction everywhere in the direction that the moment asks for.
  StickSlip all_sliding(double needed) const;

  int components = 1;  // of the shear force at a node: F_U; F_V
  SurfaceGrid grid;
  FrictionLaw law;
  double slip_threshold = 0;
  std::optional<double> given_rotation;  // R Omega / V, as the law of friction takes it (indenter_shape.hpp)
  std::vector<int> contact;
  Eigen::VectorXd limit;                     // of friction at every node, also in tension
  Eigen::VectorXd moment_arm, moment_arm_y;  // at every node, over R: sum(moment_arm F_U + moment_arm_y F_V) = moment
  double moment = 0;                         // of the drive's row [N; cylinder: N/m]
  Eigen::VectorXd turning, turning_y;        // of the slip, at every node (indenter_shape.hpp)
  double scale = 1;                          // the change of s_x at a node with its own F_U

 private:
  Eigen::VectorXd normal_force_;
  double drive_target_ = 0;
  Eigen::VectorXd forward_slip_[2];            // s_x, s_y at every node, without displacements and rotation
  Eigen::VectorXd normal_arm_;                 // of every node, in the drive's row, over R
  OffsetKernel forward_[2][3], chosen_[2][3];  // slope of u, v (first index) for F_W, F_U, F_V (second)
};

/// The cylinder's subroutine (section 3.2): all nodes stick at first; then sticking nodes with |F_U| > mu |F_W| slip in
/// the direction of that force. With `resticking` on, slipping nodes whose friction opposes the slip (by more than
/// slip_threshold, slip by the scene's slip_stencil) stick again, and the zones of the last call are the start of
/// the next. When the number of nodes that break a law no longer falls, single nodes change (Judice and Pires 1994).
/// With `resticking` off, as printed, a state that ends with friction against the slip is reported as not converged.
class LineStickSlip {
 public:
  LineStickSlip(const ContactModel& model, const InfluenceTable& table, const SurfaceGrid& grid);
  LineStickSlip(const LineStickSlip&) = delete;
  LineStickSlip& operator=(const LineStickSlip&) = delete;

  /// @param tolerance unused: once the zones are found, the answer is exact   @param coating what one adds to the
  /// drive's row [N/m]
  StickSlip solve(const std::vector<int>& contact, const Eigen::VectorXd& normal_force, double tolerance = 0,
                  double coating = 0);
  const SubsetSolver& system() const { return system_; }

 private:
  bool let_one_stick(StickSlip& state);

  TangentialProblem problem_;
  bool resticking_;
  std::vector<int> sense_;  // at every node: 0 sticks, +1 or -1 slips with friction that way
  SubsetSolver system_;
};

/// The sphere's subroutine (section 4.2). After each linear system the scene's `slip_rule` changes the zones and turns
/// the friction, with the slip s by the scene's slip_stencil:
///
/// printed    A sticking node slips if |F| > mu |F_W| and |s| > slip_threshold (38), a slipping node sticks if
///            |s| < slip_threshold (39), friction takes the direction of s at once. All nodes stick at first. With the
///            forward difference no sticking node has any slip, so none is let go; with the others the direction of
///            friction oscillates on most scenes. Such runs are reported as not converged.
/// projected  A sticking node slips if |F| > mu |F_W|, in the direction of F. At a slipping node friction turns towards
///            F + c s, c = weight / |change of s_x with the node's own F_U|, and the node sticks if F + c s lies inside
///            the disc of radius mu |F_W|, that is if its friction opposes the slip. (c -> infinity is the printed
///            redirection.) The weight begins at 0.5 and falls whenever the change stops falling.
class SurfaceStickSlip {
 public:
  SurfaceStickSlip(const ContactModel& model, const InfluenceTable& table, const SurfaceGrid& grid);
  SurfaceStickSlip(const SurfaceStickSlip&) = delete;
  SurfaceStickSlip& operator=(const SurfaceStickSlip&) = delete;

  /// @param tolerance largest change of friction at a node, relative to the largest limit, that counts as none
  /// @param coating what one adds to the drive's row [N]
  StickSlip solve(const std::vector<int>& contact, const Eigen::VectorXd& normal_force, double tolerance,
                  double coating = 0);
  const SubsetSolver& system() const { return system_; }

 private:
  struct Change {
    int released = 0, caught = 0, beyond_limit = 0;
    double largest = 0;  // change of friction at a node over the largest limit
  };
  Change projected_rule(const std::vector<int>& stick, const std::vector<int>& slip_nodes, const StickSlip& state);
  Change printed_rule(const std::vector<int>& stick, const std::vector<int>& slip_nodes, const StickSlip& state);
  void turn(int node, double along_x, double along_y, Change& change);
  void slip_of(const std::vector<int>& nodes, const StickSlip& state, Eigen::VectorXd& slip_x,
               Eigen::VectorXd& slip_y) const;
  void balance_rotation(const std::vector<int>& slip_nodes, StickSlip& state);

  TangentialProblem problem_;
  SlipRule rule_;
  double largest_limit_ = 0, weight_ = 0;
  std::vector<char> slips_;            // at every node, from the last call
  Eigen::VectorXd along_x_, along_y_;  // direction of the friction at every node
  SubsetSolver system_;
};

}  // namespace rollres
