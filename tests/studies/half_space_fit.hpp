#pragma once

#include <nlohmann/json.hpp>

/// The definition of a fit of three parameters on a half-space to the rows of `table.csv`.
inline nlohmann::json half_space_fit() {
  using nlohmann::json;
  return {{"fit", "half space"},
          {"scene",
           {{"radius", 0.1},
            {"layer_thickness", "infinite"},
            {"static_shear_modulus", 1e6},
            {"stiffening", 2},
            {"creep_time", 0.1},
            {"speed", 1},
            {"load", 1e4}}},
          {"data", "table.csv"},
          {"parameters", {{"static_shear_modulus", "2 MPa"}, {"stiffening", json::object()}, {"creep_time", "30 ms"}}}};
}
