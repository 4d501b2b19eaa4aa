#include <algorithm>
#include <iostream>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "studies/program/commands.hpp"
#include "studies/run/stop_signal.hpp"

int main(int count, char** words) {
#ifdef __GLIBC__
  // Matrices of some hundred rows are made and dropped all the time: to hand them back to the system each time costs a
  // seventh of what cylinders with inertia cost. (The library comes to these values itself once it frees 32 MB.)
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
  rollres::end_in_words_at_signals();
  return rollres::run_program({words + std::min(count, 1), words + count}, {std::cout, std::cerr, rollres::solve});
}
