#pragma once

/// Values of scenes and solutions as cells of a table: [SI], names for choices; what is absent (NaN, not given, an
/// empty list) is an absent cell.

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/scene/scene.hpp"
#include "db/queries/table.hpp"

namespace rollres {

Cell cell_of(double value);
Cell cell_of(const std::optional<double>& value);
Cell cell_of(const std::vector<double>& list);
Cell cell_of(const BondedLayers& layers);
Cell cell_of(const std::string& text);
template <class Value>
requires std::is_integral_v<Value> Cell cell_of(Value count) { return static_cast<std::int64_t>(count); }
template <class Choice>
requires std::is_enum_v<Choice> Cell cell_of(Choice choice) { return std::string(name_of(choice)); }

/// One input of a scene.
Cell input_of(const RollingScene& scene, std::string_view key);

/// All inputs, in the order of input_keys().
std::vector<Cell> input_cells(const RollingScene& scene);

}  // namespace rollres
