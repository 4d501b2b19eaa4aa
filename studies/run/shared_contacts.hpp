#pragma once

/// Cylinders of several widths that have one contact: under the same load per metre, or at the same approach.

#include "core/solve/rolling_contact.hpp"

namespace rollres {

/// `evaluate`, which is asked once for all scenes that differ by their width alone; safe for several threads. Answers
/// are kept, without fields, as long as the function lives: for studies whose width varies.
Evaluate once_for_widths(const Evaluate& evaluate);

}  // namespace rollres
