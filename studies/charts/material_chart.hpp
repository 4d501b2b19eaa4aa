#pragma once

/// Pictures of a material: moduli against frequency with the rows of its table, and creep and relaxation against time.

#include <filesystem>
#include <vector>

#include "core/scene/material_inputs.hpp"

namespace rollres {

/// Draws NAME_moduli and NAME_creep, each as SVG and PNG beside its script and data; returns the SVG files.
/// @throws as draw_chart
std::vector<std::filesystem::path> draw_material(const MaterialInputs& layer, const std::filesystem::path& name);

}  // namespace rollres
