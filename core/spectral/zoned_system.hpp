#pragma once

/// What the linear problem inside given edges has whatever stands for the tractions: the places of its unknowns, the
/// rows of memories, prescribed slopes and drive, and the state that its solution is. For sources only.

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "core/model/indenter_shape.hpp"
#include "core/spectral/spectral_system.hpp"

namespace rollres {

/// Unknowns: those of the pressure, the slack and the amplitudes of its memories, the same for each zone of stick, and
/// last, where something sticks, the rotation.
class ZonedSystem {
 public:
  ZonedSystem(const ZonedSystem&) = delete;
  ZonedSystem& operator=(const ZonedSystem&) = delete;

 protected:
  using Index = Eigen::Index;

  /// A zone of stick with the places of its unknowns.
  struct Stick {
    Interval interval;
    Index first, count;
    Index slack() const { return first + count; }
    Index amplitude() const { return slack() + 1; }
  };

  ZonedSystem(const SpectralProblem& problem, const SlipPattern& pattern, const SpectralEdges& edges);
  virtual ~ZonedSystem() = default;

  /// @param contact, in_sticks  unknowns of the pressure, and of the shear in each zone of stick
  void place_unknowns(Index contact, const std::vector<Index>& in_sticks);

  /// A lever arm's sum over the tractions, by unknown.
  virtual Eigen::RowVectorXd resultant(LeverArm (IndenterShape::*arm)(double, double) const) const = 0;
  /// By how much the shear at the leading end of a stick has a root of the distance, where slip lies ahead [Pa].
  virtual double root_at_leading_end(std::size_t stick) const = 0;

  /// Left sides of (S8) and (S14): Z_j + g_j sum_m F_jm R_{T_m} g.
  void remember(Index amplitude, const Eigen::MatrixXd& means);
  /// Right sides of (S7) and (S8) at points of the contact: the body's slope.
  void prescribe_contact(const Eigen::VectorXd& points);
  /// What (S14) and (S16) have of the strain u' = (omega - 1) turning + turning - forward that stick prescribes.
  void prescribe_stick(const Stick& stick, const Eigen::VectorXd& points);
  /// The row of the rotation.
  void drive();

  /// (S23). @param of_unit_modulus  elastic displacement at the leading edge [Pa m]
  double approach(double of_unit_modulus) const;
  /// The solution with all but sources and forces.
  SpectralState state(double approach) const;

  const SpectralProblem& problem_;
  const SlipPattern pattern_;
  const SpectralEdges edges_;
  const double friction_;
  const Index terms_;
  Index slack_ = 0, amplitude_ = 0, rotation_ = 0, size_ = 0;  // places of unknowns after those of the pressure
  std::vector<Stick> sticks_;
  Eigen::MatrixXd matrix_, means_;
  Eigen::VectorXd right_, solution_;

 private:
  /// What the drive asks of the tractions, and how much (S18).
  std::pair<Eigen::RowVectorXd, double> drive_row() const;
};

}  // namespace rollres
