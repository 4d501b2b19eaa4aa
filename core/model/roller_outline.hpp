#pragma once

/// The outline of a body of revolution: its radius rho at a place along its axle, counted from the middle O to its left
/// end.
///
///   circle    rho = R - R_t + sqrt(R_t^2 - y^2)
///   ellipse   rho = R sqrt(1 - y^2/(R R_t))
///   profile   rho = R - B(y), B a piecewise cubic through heights over the smallest of them. Between two points
///   it
///             is monotone, so that it has no bulge that the points do not have (Fritsch and Butland 1984)

#include <optional>
#include <vector>

#include "core/scene/scene.hpp"

namespace rollres {

class RollerOutline {
 public:
  /// A crown. @param radius R   @param transverse R_t [m]
  RollerOutline(double radius, double transverse, Crown crown);
  /// A profile. @param places rising   @param heights of the same number, at least two, from 0 to below R [m]
  RollerOutline(double radius, std::vector<double> places, const std::vector<double>& heights);

  double radius() const { return radius_; }                 // R [m]
  double transverse_radius() const { return transverse_; }  // R_t of a crown [m]
  Crown crown() const { return crown_; }
  /// R^2 - rho^2, without the cancellation [m2]. Beyond its ends a profile goes on as it ends.
  double fallen_square(double along) const;
  double squared_radius(double along) const { return radius_ * radius_ - fallen_square(along); }  // rho^2 [m2]
  double half_slope(double along) const;                                                          // (rho^2)'/2 [m]
  /// Whether the body reaches so far.
  bool reaches(double along) const;
  /// The place whose point is lowest where the axle rises by a sine, and how deep it lies below O [m].
  struct Lowest {
    double along, depth;
  };
  Lowest lowest(double sine) const;
  /// The shortest flank of a profile's hollows that are so deep; infinite: there is none [m].
  double shortest_flank(double rise) const;
  bool is_profile() const { return !pieces_.empty(); }
  /// Whether it is its own mirror image.
  bool even() const { return even_; }
  /// A place of a profile that stands before what lies between it and the lowest point, seen from below where the axle
  /// rises by a sine.
  std::optional<double> hidden_place(double sine) const;
  /// How far it reaches to either side, at most [m].
  double reach() const;

 private:
  /// Height over the lowest point between two places: height + t (slope + t (bend + t turn)), t from the first.
  struct Piece {
    double from, to, height, slope, bend, turn;
    double value(double along) const;
    double derivative(double along) const;
  };
  const Piece& piece_at(double along) const;
  Lowest lowest_of_profile(double sine, double cosine) const;

  double radius_, transverse_ = 0;  // [m]
  Crown crown_ = Crown::circle;
  std::vector<Piece> pieces_;
  bool even_ = true;
};

/// Whether the contact of a body in 3D is its own mirror image in y: of a ball without friction whatever turns it, else
/// of straight motion and an outline that is its own mirror image. @param outline of a roller, none of a sphere
inline bool has_mirror(bool friction, bool straight, const std::optional<RollerOutline>& outline) {
  if (!outline) return straight || !friction;
  return straight && outline->even();
}

}  // namespace rollres
