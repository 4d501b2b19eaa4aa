/// One target as libFuzzer wants it; ROLLRES_FUZZ_TARGET is its name.

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const rollres::FuzzTarget& target : rollres::fuzz_targets())
    if (target.name == ROLLRES_FUZZ_TARGET) rollres::try_reading(target, {reinterpret_cast<const char*>(data), size});
  return 0;
}
