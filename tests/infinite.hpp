#pragma once

#include <limits>

inline constexpr double infinite = std::numeric_limits<double>::infinity();
