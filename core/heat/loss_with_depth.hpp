#pragma once

/// Where in the warmed layers an answer loses its power.

#include <vector>

#include "core/heat/temperature_profile.hpp"
#include "core/model/contact_model.hpp"

namespace rollres {

/// All of a metre of a cylinder's length; the sum is R_r V [W/m].
struct LossWithDepth {
  std::vector<LossPanel> panels;  ///< inside the warmed layers
  double at_face = 0;             ///< by friction, all of which warms them
  double elsewhere = 0;           ///< in layers under a covered body
};

enum class LossDetail {
  full,
  rough  ///< shares of the layers to about 1e-3, for a quarter of the work
};

/// By the sums over the inside of the layers (interior/interior_field.hpp), which are multiplied by what makes their
/// sum R_r V less the loss to friction: the sum itself is that to about 1e-4.
/// @param model of a single passage of a cylinder, with what the answer decided   @param solution per metre
LossWithDepth loss_with_depth(const ContactModel& model, const RollingSolution& solution,
                              LossDetail detail = LossDetail::full);

}  // namespace rollres
