#pragma once

/// Rows of a padded grid are transformed along x some at a time, as many as the cache holds.

#include "core/convolution/padded_convolution.hpp"

namespace rollres {

constexpr int batch = 8;  // rows
inline int batches(int rows) { return (rows + batch - 1) / batch; }

/// Room of a transformed real line, an even number of values to keep the alignment.
inline int line_room(PaddedSize size) { return (size.columns / 2 + 2) / 2 * 2; }

}  // namespace rollres
