#pragma once

#include <stdexcept>
#include <string>

namespace rollres {

/// Does `function`, and puts the place (a file, an option) in front of its refusal.
template <class Function>
auto refusing_at(const std::string& place, Function function) {
  try {
    return function();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(place + ": " + error.what());
  }
}

}  // namespace rollres
