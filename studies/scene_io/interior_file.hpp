#pragma once

/// What goes on inside the layers, as files for other programs.

#include <filesystem>
#include <string>
#include <vector>

#include "core/interior/interior_summary.hpp"

namespace rollres {

/// A table of sections, upright ones or faces: x, y of faces, z, layer ("layer", "coating [0]"), displacements,
/// stresses, strains, density of loss.
std::string interior_csv(const std::vector<InteriorSection>& sections);

/// One section as a VTK rectilinear grid in the plane x-z or x-y.
std::string interior_vtr(const InteriorSection& section);

/// Where power is lost, line by line from the contact away: layer, z, loss per depth, its share summed so far, strain
/// amplitude; and what bonds bear. Losses are those of the scene's body: of its width, or of a metre.
std::string losses_csv(const InteriorSummary& summary, const RollingScene& scene);
std::string bonds_csv(const InteriorSummary& summary, Indenter indenter);

/// Loss, share, amplitudes of each layer, and its bond, as a table in words.
std::string interior_text(const InteriorSummary& summary, const RollingScene& scene);

/// Whether the inside of the layers can be told: of a single passage at small strains.
bool has_interior(const RollingScene& scene, const RollingSolution& solution);

/// Writes inside.csv, inside.vtr (coating.vtr for the layers on the body), losses.csv and bonds.csv; of a sphere also
/// faces.csv and face_0.vtr, face_1.vtr, ... (coating_face_0.vtr, ...): the surface and the bonds.
/// @throws std::runtime_error naming the file that could not be written
void write_interior(const std::filesystem::path& directory, const RollingScene& scene, const RollingSolution& solution);

}  // namespace rollres
