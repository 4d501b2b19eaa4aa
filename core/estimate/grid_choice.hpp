#pragma once

/// Which nodes a scene needs: spacing and window, from closed-form estimates of its contact.

#include <cmath>

#include "core/estimate/contact_estimate.hpp"
#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// Contact of the model if its layer were elastic with the modulus it has at the frequency V / half-width; the model's
/// own estimate if it has one.
ContactEstimate estimate_contact(const ContactModel& model);

/// The coating's share of what that contact yields (contact_surface.hpp) [1].
double share_of_coating(const ContactModel& model);

/// Spacing for a scene that gives none: about 120 nodes along a cylinder's contact, 40 along a sphere's; with a
/// tolerance, a first spacing from which to refine.
double default_spacing(const ContactModel& model);

/// Cells that the flanks of a profile's hollows ask for on the half-width of the contact across the motion, of hollows
/// a tenth as deep as the contact or deeper; 0: no profile, or none.
double cells_for_hollows(const ContactModel& model);

/// Whether the edge of the contact is a curve that polynomials follow (edge_curve.hpp): of a profile, if one follows
/// its heights within the estimated contact.
bool has_smooth_edge(const ContactModel& model);

/// @throws BeyondLimits if a half grid of so many nodes takes more memory than the solution may (solution_limits.hpp)
void require_nodes(double columns, double rows, double spacing);

/// Folded grid in 3D, one row in 2D, with a node at the origin that covers |x|, |y| <= half_width.
SurfaceGrid window(int dimension, double spacing, double half_width);

/// Cells of a grid in 3D: squares, or as long across the motion as the estimated contact of a roller is.
enum class Cells { square, as_contact };
/// Grid over the estimated contact of a model, with a half-width along the motion: whole where the model is not
/// mirrored.
SurfaceGrid window(const ContactModel& model, double spacing, double half_width, Cells cells);

/// Largest half-width a window may have: beyond it a body of this radius has no lower surface.
inline double widest_window(const ContactModel& model) { return 0.98 * model.radius; }
/// The same across the motion.
inline double widest_across(const ContactModel& model) {
  if (!model.outline) return widest_window(model);
  // Beside a profile there is room for what shows that its end is in contact.
  return model.profiled() ? 2 * model.outline->reach() : 0.98 * model.outline->reach();
}

}  // namespace rollres
