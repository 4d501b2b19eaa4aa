#pragma once

/// The rigid body that rolls: its shape, and what tractions on it do to it. What kind of body it is, is decided here
/// and in the grid alone.
///
/// The body touches the surface first at (0, 0). With q(x, y) the height of its centre above its lower surface, its
/// profile is B = R - q, with slopes b = -grad q: a cylinder has q^2 = R^2 - x^2, a sphere R^2 - x^2 - y^2, a roller
/// that of roller_body.hpp, which touches first where its outline is lowest.
///
/// The layer feels the vertical pressure p and the shear (tau_x, tau_y) on each unit of its undeformed area; it moves
/// by w, u, v. Load P, driving force Q and torque T are integrals of lever arms times p, tau_x and tau_y; the slip of
/// the body relative to the layer, over V, at omega = R Omega/V, is
///   s = forward + d(u, v)/dx - omega turning,   vectors along x and y.
///
/// `consistent`. The shear lies in the body's surface, whose slope is b: its vertical part b . tau belongs to the
/// layer's vertical traction, the pressure normal to the body is p + b . tau, and the slip is the velocity conjugate
/// to tau of the body less that of a layer that runs along it. With the axle's direction e, the pivot about z over the
/// path, e_x the travel and M = 1 + b b^T,
///   forward = M (e_x + pivot (-y, x)),   turning = M (e_y q + e_z y, -e_x q - e_z x)/R
///   P: 1   Q: b_x, M e_x   F_y: b_y, M e_y   T: 0, -R turning   (of p, of tau)
///   m_z: x b_y - y b_x, M (-y, x)   m_x: q b_y - y, q M e_y   about the middle of the axle
/// A straight cylinder has forward = 1 + b_x^2, turning = (R^2 - y^2)/(R q) along x. A skewed one, in the frame of its
/// axle, has -tan a along y. Q + omega T/R + pivot m_z is the integral of p b_x - tau . d(u, v)/dx + tau . s, and w_x =
/// b_x in the contact: what the drive gives goes into the layer and into friction. To second order in the slope and
/// near omega = 1 a cylinder's slip is 1 + du/dx + b_x^2/2 - omega: the surface is longer by the arc.
///
/// With a coating the surface between body and layers has the slope w_x = b_x - c_x, c_x that of the coating's part of
/// w, and the coating flows at R Omega. The pressure acts along the normal of that surface. It therefore adds what
/// multiples of the integral M of p c_x (core/newton/README.md, (N3b)) add to the arms above:
///   Q: -M   T: R (M - N), N of a ring alone, whose shear acts at the radius that pressure leaves (N3e)
///   slip: s_x = forward + du/dx - omega turning + (omega - 1) times the coating's part of du/dx
/// On a rigid plane all shear acts along it, at one height: forward = turning = 1. In between, with the coating's share
/// k of b_x = w_x + c_x taken as one number (`coating_share`),
///   forward = 1 + (1 - k) b_x^2,   turning = k + (1 - k) (R^2 - y^2)/(R q),   along y (1 - k) times the above
///
/// A cover that is a ring is measured along its face, at the arc x = R phi. There its height above a plane is R (1 -
/// cos phi), so that with the coating's share k, in both kinematics,
///   B = (1 - k) (R - q) + k R (1 - cos(x/R)),   b_x = (1 - k) x/q + k sin(x/R)
/// Pressed flat, it turns by x/R against its core and would be longer by half the square of that; the pressure, which
/// stays vertical, shortens it by as much on the mean. Both are left out: one alone is worse than none
/// (finite_strain/README.md).
///
/// `printed` (Zehil and Gavin 2013, eqs. 12, 15, 17, 19, 21, 25, 26, 37): a cylinder's pressure and shear act normal to
/// and along its arc, a sphere's vertically and horizontally, and the slip is that on a flat surface,
///              P                    Q                    T                forward   turning
///   cylinder   (q p - x tau_x)/R    (x p + q tau_x)/R    -R tau_x         1         1
///   sphere     p                    tau_x                x p - q tau_x    1         sqrt(R^2 - y^2)/R
/// The power is off by terms of second order in the slope (`unbalanced_power`).

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/model/contact_model.hpp"
#include "core/model/roller_body.hpp"

namespace rollres {

/// What a unit of each traction gives.
struct LeverArm {
  double of_pressure = 0, of_shear_x = 0, of_shear_y = 0;  // [1] for a force, [m] for a torque
  double operator()(double pressure, double shear_x) const { return of_pressure * pressure + of_shear_x * shear_x; }
};

/// The slip where nothing moves along itself: forward - omega turning, along x and along y [1].
struct RigidSlip {
  double forward = 1, turning = 1;
  double forward_y = 0, turning_y = 0;
};

class IndenterShape {
 public:
  /// @param coating_share of the coating in what yields, for its terms of second order, 0 to 1
  explicit IndenterShape(const ContactModel& model, double coating_share = 0)
      : radius_(model.radius),
        flat_in_y_(model.dimension == 2),
        kinematics_(model.kinematics),
        share_(kinematics_ == Kinematics::consistent ? coating_share : 0),
        bent_(model.ring() ? coating_share : 0),
        sideways_(model.skewed() ? -model.skew : 0),
        pivot_(model.pivot),
        axle_(flat_in_y_ ? std::array{0.0, 1.0, 0.0} : model.axle()) {
    if (model.outline) roller_.emplace(*model.outline, axle_);
  }

  double radius() const { return radius_; }  // R [m]
  /// Whether there is a lower surface above this place.
  bool covers(double x, double y) const { return roller_ ? roller_->covers(x, y) : fallen(x, y) < radius_ * radius_; }
  /// The lowest point of the body, below its middle but for a roller whose crown or profile is lowest elsewhere [m].
  std::array<double, 2> lowest() const {
    return roller_ ? std::array{roller_->lowest().x, roller_->lowest().y} : std::array{0.0, 0.0};
  }
  /// q(x, y), held at R/100 beyond the body so that grids may be wider [m].
  double height(double x, double y = 0) const {
    if (roller_) return roller_->depth(x, y);
    return std::sqrt(std::max(radius_ * radius_ - fallen(x, y), 1e-4 * radius_ * radius_));
  }
  /// Height of the lower surface above its lowest point, without the cancellation of R - q [m].
  double profile(double x, double y = 0) const {
    if (roller_) return roller_->profile(x, y);
    const double flat = (1 - bent_) * fallen(x, y) / (radius_ + height(x, y)), sine = std::sin(0.5 * x / radius_);
    return bent_ == 0 ? flat : flat + bent_ * 2 * radius_ * sine * sine;
  }
  /// Its derivative along x [1].
  double slope(double x, double y = 0) const {
    if (roller_) return roller_->slopes(x, y)[0];
    const double flat = (1 - bent_) * x / height(x, y);
    return bent_ == 0 ? flat : flat + bent_ * std::sin(x / radius_);
  }

  LeverArm load(double x, double y = 0) const;           // P
  LeverArm driving_force(double x, double y = 0) const;  // Q
  LeverArm torque(double x, double y = 0) const;         // T
  /// What the motion resists with: Q + pivot m_z, and of a skewed cylinder what its axial force does.
  LeverArm resisting_force(double x, double y = 0) const;
  LeverArm side_force(double x, double y = 0) const;  // F_y, of a cylinder along its axle
  LeverArm spin_moment(double x, double y) const;     // m_z, about the middle of the axle
  LeverArm overturning(double x, double y) const;     // m_x, likewise
  RigidSlip slip(double x, double y = 0) const;
  /// What M adds to T/R, and takes from Q [1]: 0 for a printed sphere, whose pressure is taken to act vertically.
  double of_coating() const { return kinematics_ == Kinematics::consistent || flat_in_y_ ? 1 : 0; }

  /// The law of friction as methods impose it, s/m = law_slip.forward + d(u, v)/dx - law_ratio law_slip.turning, with
  /// the coating's part of d(u, v)/dx taken as the share k of it, m = 1 + k (omega - 1): exact where either side is
  /// rigid.
  RigidSlip law_slip(double x, double y = 0) const;
  /// omega from the ratio of the law, 1 + (omega - 1)/m, and back. Of a body that slides all over, m is at least a
  /// tenth: it only tells the direction.
  double rotation_ratio(double law_ratio) const {
    return share_ == 0 ? law_ratio : 1 + (law_ratio - 1) / (1 - share_ * (law_ratio - 1));
  }
  double law_ratio(double omega) const {
    return share_ == 0 ? omega : 1 + (omega - 1) / std::max(1 + share_ * (omega - 1), 0.1);
  }
  /// Derivative of the slope along x [1/m].
  double curvature(double x, double y = 0) const;
  /// Derivative along x of what a unit of pressure resists with where the body rolls, Q + T/R [1/m].
  double resisting_curvature(double x, double y = 0) const {
    return kinematics_ == Kinematics::printed ? 1 / radius_ : curvature(x, y);
  }
  /// Whether that is the same at every place.
  bool slips_evenly() const { return kinematics_ == Kinematics::printed && flat_in_y_; }
  /// Power over V that the resultants at rotation ratio omega, Q + omega T/R, put in beyond what goes into the moving
  /// surface and into slip (core/newton/README.md, (N23)): 0 for consistent kinematics.
  LeverArm unbalanced_power(double omega, double x, double y = 0) const;

 private:
  /// Of a consistent body's surface: (1 + (1 - k) b b^T) times a horizontal vector.
  std::array<double, 2> along_surface(double x, double y, double of_x, double of_y) const;
  double slope_across(double x, double y) const {  // b_y
    return flat_in_y_ ? 0 : roller_ ? roller_->slopes(x, y)[1] : y / height(x, y);
  }
  /// R^2 - q^2 [m2]
  double fallen(double x, double y) const { return flat_in_y_ ? x * x : x * x + y * y; }

  double radius_;
  bool flat_in_y_;
  Kinematics kinematics_;
  double share_;  // of the coating in what yields, 0 to 1
  double bent_;   // the same where the coating is a ring, else 0
  std::optional<RollerBody> roller_;
  double sideways_, pivot_;     // rigid slip along the axle of a skewed cylinder [1]; of a sphere about z [1/m]
  std::array<double, 3> axle_;  // its direction
};

/// The row of the drive, from torques and driving forces (numbers or rows of a system): T/R, less Q if a force at the
/// top drives. It shall be `drive_target`; unused with drive "rotation".
template <class Value>
Value drive_row(const ContactModel& model, const Value& torque, const Value& driving_force) {
  if (model.drive != Drive::top_force) return torque / model.radius;
  return torque / model.radius - driving_force;
}
/// What the tractions on a coating add to the resultants beyond the arms above [N] (per metre for a cylinder).
struct CoatingMoments {
  double pressed = 0;  ///< M
  double sheared = 0;  ///< N of a ring, core/newton/README.md, (N3e)

  double in_torque() const { return pressed - sheared; }  ///< what they add to T/R
};
/// What they add to that row, for the bodies whose resultants have them (`IndenterShape::of_coating`).
inline double coating_in_drive(const ContactModel& model, const CoatingMoments& moments) {
  if (model.coating.empty() || IndenterShape(model).of_coating() == 0) return 0;
  return drive_row(model, model.radius * moments.in_torque(), -moments.pressed);
}
inline double drive_target(const ContactModel& model) {
  return model.drive == Drive::torque ? *model.driving_torque / model.radius : 0;
}

}  // namespace rollres
