#pragma once

/// The readers of this program, each as a function of arbitrary bytes.

#include <span>
#include <string_view>

namespace rollres {

struct FuzzTarget {
  std::string_view name;  ///< also that of its folder in corpus/
  /// Reads the bytes as a file of its kind. What it refuses is std::invalid_argument or std::runtime_error.
  void (*read)(std::string_view bytes);
};

std::span<const FuzzTarget> fuzz_targets();

/// Reads the bytes and takes refusals for answers. @throws whatever no reader may throw
void try_reading(const FuzzTarget& target, std::string_view bytes);

}  // namespace rollres
