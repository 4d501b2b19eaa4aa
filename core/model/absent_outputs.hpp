#pragma once

/// Which outputs the answer to a scene has not, and why.

#include <string>
#include <string_view>

#include "core/model/contact_model.hpp"

namespace rollres {

/// Why an output is absent from every answer to such a scene, as the approach of a cylinder on a half-space is; empty
/// if it is not.
std::string why_absent(const RollingScene& scene, std::string_view output);
std::string why_absent(const ContactModel& model, std::string_view output);

}  // namespace rollres
