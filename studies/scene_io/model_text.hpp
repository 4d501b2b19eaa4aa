#pragma once

/// The model of a scene, before anything is solved, for people and for programs.

#include <string>

#include "core/model/contact_model.hpp"

namespace rollres {

/// The model that solves a scene, a statement a line, aligned; why there is none where its estimates fail.
/// @throws std::invalid_argument naming key, value and rule if the scene breaks one
std::string model_text(const RollingScene& scene);

/// One JSON object: what the model holds under the names of ContactModel, numbers in SI, "infinite" thicknesses, layers
/// as a list of objects, and the statements of the text under "words".
/// @throws as above, and std::domain_error where its estimates fail
std::string model_json(const RollingScene& scene);

}  // namespace rollres
