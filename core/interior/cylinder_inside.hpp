#pragma once

/// The inside of the layers of a cylinder's contact: interior_summary.hpp in plane strain.

#include <vector>

#include "core/interior/interior_summary.hpp"

namespace rollres {

InteriorSummary cylinder_summary(const ContactModel& model, const SurfaceFields& fields, InteriorField::Detail detail);
std::vector<InteriorSection> cylinder_sections(const ContactModel& model, const SurfaceFields& fields);

}  // namespace rollres
