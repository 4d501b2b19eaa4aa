#pragma once

#include <cmath>

#include "core/material/prony_series.hpp"

namespace rollres {

/// Terms over twelve decades.
inline PronySeries wide_series(int terms) {
  PronySeries series{1e6, {}};
  for (int j = 0; j < terms; ++j)
    series.terms.push_back({1e5 * (1 + 3.0 * (j % 4)), std::pow(10.0, -9 + 12.0 * j / (terms - 1))});
  return series;
}

}  // namespace rollres
