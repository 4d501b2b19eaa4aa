#include "core/solve/torque_limit.hpp"

#include <cmath>

#include "core/estimate/grid_choice.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/indenter_shape.hpp"
#include "core/newton/friction_limit.hpp"
#include "core/newton/grid_series.hpp"
#include "core/scene/friction_law.hpp"

namespace rollres {

// In the contact |tau_x| <= mu p and p >= 0, and its places are no farther than r from the axis, where the body's
// height q is at least q_r = sqrt(R^2 - r^2). Whatever p is, without a coating, whose own part of T has no such bound,
//   consistent   |T| = |int tau_x (R^2 - y^2)/q| <= mu int p R^2/q_r = mu P R^2/q_r,   as P = int p
//   printed, sphere     |T| = |int x p - q tau_x| <= (r + mu R) P
//   printed, cylinder   |T| = |R int tau_x| <= mu R int p, and P = int (q p - x tau_x)/R >= (q_r - mu r)/R int p
double largest_torque(const ContactModel& model) {
  if (!model.load || model.adhesion_threshold > 0 || !model.coating.empty() || model.outline) return INFINITY;
  const IndenterShape shape(model);
  const double radius = model.radius, farthest = widest_window(model), lowest = shape.height(farthest),
               friction = friction_law(model).slope(0), load = *model.load;
  if (model.kinematics == Kinematics::consistent) return friction * load * radius * radius / lowest;
  if (model.dimension == 3) return (farthest + friction * radius) * load;
  const double carried = lowest - friction * farthest;
  return carried > 0 ? friction * load * radius * radius / carried : INFINITY;
}

namespace {

/// Sliding gives less than so many times what a partly sticking contact may, whose pressure is placed otherwise.
constexpr double beyond_doubt = 3;

/// What sliding all over gives; infinite where that is not known.
double torque_of_sliding(const ContactModel& model) {
  const GridSeries grids = fixed_grids(model, default_spacing(model));
  const double torque = sliding_torque(model, grids.first(grids.coarsest));
  return torque >= 0 ? torque : INFINITY;
}

}  // namespace

std::string unbearable_torque(const ContactModel& model) {
  const double friction = friction_law(model).slope(0);
  if (model.drive != Drive::torque || friction == 0) return {};
  const double asked = std::abs(*model.driving_torque), most = largest_torque(model);
  const char* const unit = model.told_per_metre() ? " N m/m" : " N m";
  const auto refused = [&](const auto&... gives) {
    return message_text("the drive asks for more torque than friction can give: ", model.told(asked), unit, ", and ",
                        gives...);
  };
  if (asked > most)
    return refused(friction, " times the load gives at most ", model.told(most), unit,
                   " wherever the body touches within 0.98 R");
  // The bound of printed kinematics is weak: a cylinder's friction may carry the load at the edge of the body.
  if (model.kinematics != Kinematics::printed || model.dimension == 3 || !model.load || model.adhesion_threshold > 0 ||
      asked <= beyond_doubt * friction * *model.load * model.radius)
    return {};
  const double sliding = torque_of_sliding(model);
  if (asked <= beyond_doubt * sliding) return {};
  return refused("sliding all over gives ", model.told(sliding), unit);
}

}  // namespace rollres
