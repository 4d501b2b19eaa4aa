#pragma once

/// What it costs that all layers that heat warms have one temperature, or each of their sublayers one.

#include <functional>
#include <optional>
#include <vector>

#include "core/estimate/composite_estimate.hpp"
#include "core/heat/temperature_profile.hpp"
#include "core/model/contact_model.hpp"

namespace rollres {

/// A warm answer and how its model is made.
struct WarmAnswer {
  const RollingScene& scene;
  const RollingSolution& solution;  ///< per metre
  const TemperatureProfile& profile;
  std::vector<double> temperatures;                                            ///< of its own sublayers [K]
  std::function<ContactModel(const std::vector<double>& temperatures)> model;  ///< of sublayers, as many in each layer
};

/// The change of R_r by finer sublayers that are as warm as the profile that they make: under the tractions of the
/// answer, with the power by the estimate of its change (ResistanceChange), whose scatter it has.
/// @param in_each finer sublayers of each layer
ResistanceChange::Change change_by_sublayers(const WarmAnswer& answer, int in_each);

}  // namespace rollres
