#pragma once

#include <cstddef>
#include <span>

namespace rollres {

/// c_0 + c_1 T_1(t) + ... by Clenshaw's recurrence; at least one coefficient, of any type of array of fixed size.
template <class Value>
Value chebyshev_sum(std::span<const Value> c, double t) {
  Value b1 = Value::Zero(), b2 = Value::Zero();
  for (std::size_t k = c.size() - 1; k > 0; --k) {
    const Value b0 = c[k] + 2 * t * b1 - b2;
    b2 = b1;
    b1 = b0;
  }
  return c[0] + t * b1 - b2;
}

}  // namespace rollres
