#pragma once

/// A model in words: what is solved, what was left out, and on which numbers that rests.

#include <string>
#include <vector>

#include "core/model/contact_model.hpp"

namespace rollres {

struct ModelStatement {
  std::string about;  ///< "body", "layer 1", "inertia"
  std::string text;
};

/// One statement each on the body, the motion, the layers from the contact away, inertia, method, errors and every
/// simplification.
std::vector<ModelStatement> model_in_words(const ContactModel& model);

}  // namespace rollres
