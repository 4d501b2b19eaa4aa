#pragma once

/// What a result depends on: which inputs are varied, and over which ranges.

#include <filesystem>
#include <string>
#include <vector>

#include "studies/optimise/design.hpp"

namespace rollres {

/// The inputs of a scene that have a logarithmic derivative: real numbers that are present, finite and not zero.
/// Those that only steer the solver (spacing, tolerance, slip_threshold) and those without room are left out.
std::vector<InputChoice> inputs_with_elasticity(const RollingScene& scene);

/// Ranges of inputs as a problem whose goal is the formula of interest.
///
/// The file is a scene, with `ranges` as "KEY=FROM:TO" or "KEY=FROM:TO:logarithmic"; or a study: its inputs with "from"
/// and "to" under "axes" or "sample"; or the study of an optimisation: its variables, and its goal in place of an empty
/// `output`.
/// @param overrides  "KEY=VALUE", of a scene
/// @param output     formula of inputs and outputs; empty: rolling_resistance
/// @throws std::invalid_argument naming file or option, key, value and rule
/// @throws std::runtime_error if a file cannot be read
DesignProblem read_ranges(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                          const std::vector<std::string>& ranges, const std::string& output);

}  // namespace rollres
