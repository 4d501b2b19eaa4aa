#pragma once

/// The fields on the layer's surface as files for other programs.

#include <filesystem>
#include <string>

#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// One line for each node, x running fastest, under a header with units: x, y [m], displacements w, u, v [m], tractions
/// on the layer sigma_z, tau_xz, tau_yz [Pa], slip velocities of the body relative to the layer slip_x, slip_y [m/s],
/// zone (free, stick, slip). For a cylinder without what belongs to y. Unknown numbers are empty.
std::string fields_csv(const RollingScene& scene, const SurfaceFields& fields, const RollingSolution& solution);

/// The same as VTK XML image data, as ParaView opens it: each column under its name, "sigma_z [Pa]", zone as 0, 1, 2,
/// and the vectors "displacement [m]" to warp by, "traction [Pa]" on the layer, "velocity [m/s]" of its surface in the
/// horizontal (surface_window.hpp) and "body [m]", which warps the grid to the body's lower surface. A column with
/// unknown numbers is left out; in a vector they are zero. As data of the whole field: the scene, what the zones'
/// numbers mean, and the solution's numbers. A cylinder's line of nodes stands twice, as a strip a quarter as wide as
/// long.
/// @param solution  its numbers; what is absent is left out
std::string fields_vti(const RollingScene& scene, const SurfaceFields& fields, const RollingSolution& solution);

/// Writes fields.csv and fields.vti into a directory, which is created if need be.
/// @throws std::runtime_error naming the path that cannot be written
void write_fields(const std::filesystem::path& directory, const RollingScene& scene, const SurfaceFields& fields,
                  const RollingSolution& solution);

}  // namespace rollres
