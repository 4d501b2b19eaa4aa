#include "core/solve/torque_limit.hpp"

#include <cmath>

#include "core/estimate/grid_choice.hpp"
#include "core/messages/message_text.hpp"
#include "core/scene/indenter_shape.hpp"

namespace rollres {

// In the contact |tau_x| <= mu p and p >= 0, and its places are no farther than r from the axis, where the body's
// height q is at least q_r = sqrt(R^2 - r^2). Whatever p is,
//   consistent   |T| = |int tau_x (R^2 - y^2)/q| <= mu int p R^2/q_r = mu P R^2/q_r,   as P = int p
//   printed, sphere     |T| = |int x p - q tau_x| <= (r + mu R) P
//   printed, cylinder   |T| = |R int tau_x| <= mu R int p, and P = int (q p - x tau_x)/R >= (q_r - mu r)/R int p
double largest_torque(const RollingScene& scene) {
  if (!scene.load || scene.adhesion_threshold > 0) return INFINITY;
  const IndenterShape shape(scene);
  const double radius = scene.radius, farthest = widest_window(scene), lowest = shape.height(farthest),
               friction = scene.friction_coefficient, load = *scene.load;
  if (scene.kinematics == Kinematics::consistent) return friction * load * radius * radius / lowest;
  if (dimensions(scene) == 3) return (farthest + friction * radius) * load;
  const double carried = lowest - friction * farthest;
  return carried > 0 ? friction * load * radius * radius / carried : INFINITY;
}

std::string unbearable_torque(const RollingScene& scene) {
  if (scene.drive != Drive::torque || scene.friction_coefficient == 0) return {};
  const double asked = std::abs(*scene.driving_torque), most = largest_torque(scene);
  if (!(asked > most)) return {};
  const char* const unit = dimensions(scene) == 2 ? " N" : " N m";
  return message_text("the drive asks for more torque than friction can give: ", asked, unit, ", and ",
                      scene.friction_coefficient, " times the load gives at most ", most, unit,
                      " wherever the body touches within 0.98 R");
}

}  // namespace rollres
