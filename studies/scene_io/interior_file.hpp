#pragma once

/// What goes on inside the layers of a cylinder's contact, as files for other programs.

#include <filesystem>
#include <string>
#include <vector>

#include "core/interior/interior_summary.hpp"

namespace rollres {

/// A table of sections: x, z, layer ("layer", "coating [0]"), displacements, stresses, strains, density of loss.
std::string interior_csv(const std::vector<InteriorSection>& sections);

/// One section as a VTK rectilinear grid in the plane x-z, y being 0.
std::string interior_vtr(const InteriorSection& section);

/// Where power is lost, line by line from the contact away: layer, z, loss per depth, its share summed so far, strain
/// amplitude; and what bonds bear.
std::string losses_csv(const InteriorSummary& summary);
std::string bonds_csv(const InteriorSummary& summary);

/// Loss, share, amplitudes of each layer, and its bond, as a table in words.
std::string interior_text(const InteriorSummary& summary);

/// Whether the inside of the layers can be told: of a cylinder, a single passage at small strains.
bool has_interior(const RollingScene& scene, const RollingSolution& solution);

/// Writes inside.csv, inside.vtr (coating.vtr for the layers on the body), losses.csv and bonds.csv.
/// @throws std::runtime_error naming the file that could not be written
void write_interior(const std::filesystem::path& directory, const RollingScene& scene, const RollingSolution& solution);

}  // namespace rollres
