#include "fitting/descent/least_squares.hpp"

#include <dlfcn.h>
#include <stdlib.h>

#include <stdexcept>

namespace rollres {

namespace {

/// From the folders that the program names (RPATH). Never unloaded: a fit may run in any thread till the end.
MinimiseByCeres load_ceres() {
  // Its linear algebra (OpenBLAS) would start threads as it is loaded. Fits have small matrices and need none, and one
  // that gets no memory spins for ever.
  ::setenv("OPENBLAS_NUM_THREADS", "1", 0);
  void* const library = dlopen("librollres_ceres.so", RTLD_NOW | RTLD_LOCAL);
  void* const function = library ? dlsym(library, "rollres_minimise_by_ceres") : nullptr;
  if (!function)
    throw std::runtime_error(std::string(dlerror()) +
                             ": a fit needs this part of rollres; install it beside the program");
  return reinterpret_cast<MinimiseByCeres>(function);
}

}  // namespace

LeastSquaresEnd minimise(LeastSquares& problem) {
  static const MinimiseByCeres by_ceres = load_ceres();
  LeastSquaresEnd end;
  by_ceres(problem, end);
  return end;
}

}  // namespace rollres
