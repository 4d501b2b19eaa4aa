#pragma once

/// Values beside their errors, for people; defined in readable_number.cpp.

#include <string>
#include <string_view>

namespace rollres {

/// A value and its error in one unit, both to two digits of the error; the value with five digits at most.
struct ValueAndError {
  std::string value, error;
};
ValueAndError value_and_error(double value, double error, std::string_view unit);

}  // namespace rollres
