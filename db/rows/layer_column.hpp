#pragma once

/// Inputs of a scene's further layers as columns: values out of the lists that the database holds as text
/// (layer_list.hpp).

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "db/rows/schema.hpp"

namespace rollres {

/// The type of a quantity's column.
template <class Value>
std::string column_type(const Value&) {
  if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::optional<double>>)
    return "REAL";
  else if constexpr (std::is_same_v<Value, int>)
    return "INTEGER";
  else
    return "TEXT";
}

/// The column of a key "coating_layers[0].layer_thickness", NULL where a scene has not that layer or its layer not that
/// input; nullptr if no layer has such an input. It lives as long as the program.
const QuantityColumn* layer_column(std::string_view key);

}  // namespace rollres
