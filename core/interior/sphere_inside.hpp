#pragma once

/// The inside of the layers of a sphere's contact: interior_summary.hpp in three dimensions.

#include <vector>

#include "core/interior/interior_summary.hpp"

namespace rollres {

InteriorSummary sphere_summary(const ContactModel& model, const SurfaceFields& fields, InteriorField::Detail detail);
std::vector<InteriorSection> sphere_sections(const ContactModel& model, const SurfaceFields& fields);

}  // namespace rollres
