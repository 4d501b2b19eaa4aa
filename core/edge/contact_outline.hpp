#pragma once

/// Where a contact on a grid ends, and how large its pressure is, between the nodes, each with an error of its own
/// (core/newton/README.md, section 10).

#include "core/model/contact_model.hpp"
#include "core/numerics/vector.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

struct ContactOutline {
  double leading = 0, trailing = 0;  ///< edges along x [m]
  double half_width = 0;             ///< of a sphere's contact across x [m]
  double edge_error = 0;             ///< estimated, of any of these [m]
  double area = 0, area_error = 0;   ///< [m2]; of a cylinder the length [m]
  double peak = 0, peak_error = 0;   ///< largest pressure [Pa]
};

/// The nodes themselves where the scene asks for the paper's contact, or nodes adhere and pull at the edge.
/// @param grid of a whole one each side of y = 0 by itself   @param pressure on it [Pa], > 0 at some node
ContactOutline contact_outline(const ContactModel& model, const SurfaceGrid& grid, const Vector& pressure);

}  // namespace rollres
