#pragma once

/// The convolution that a grid asks for: of fields that are even or odd in y on a folded grid or a line, else of any.

#include <optional>

#include "core/convolution/plane_convolution.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// An object serves one thread at a time.
template <class Real>
class SurfaceConvolution {
 public:
  using Fields = typename PaddedConvolution<Real>::Fields;
  using Results = typename PaddedConvolution<Real>::Results;

  SurfaceConvolution(PaddedSize size, const SurfaceGrid& grid) {
    if (grid.folded || size.rows == 1)
      folded_.emplace(size);
    else
      plane_.emplace(size);
  }

  /// As padded_convolution.hpp has it.
  template <class Map>
  void convolve(const Fields& in, const Map& map, const Results& out) {
    if (plane_)
      plane_->convolve(in, map, out);
    else
      folded_->convolve(in, map, out);
  }

 private:
  std::optional<PaddedConvolution<Real>> folded_;
  std::optional<PlaneConvolution<Real>> plane_;
};

}  // namespace rollres
