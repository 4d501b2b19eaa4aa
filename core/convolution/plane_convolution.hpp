#pragma once

/// Convolution of any three surface fields of a whole grid with kernels that are even or odd in y, as
/// padded_convolution.hpp has it of fields that are so themselves.
///
/// The kernels are known by their transforms at ky >= 0. At (kx, -ky) those odd in y change sign, which is as if the
/// second of the three fields did: so what multiplies a block of wavenumbers does it for both signs of ky.

#include <array>

#include "core/convolution/padded_convolution.hpp"

namespace rollres {

/// An object serves one thread at a time (it keeps work space).
template <class Real>
class PlaneConvolution {
 public:
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  using Fields = typename PaddedConvolution<Real>::Fields;    // all rows of the whole grid
  using Results = typename PaddedConvolution<Real>::Results;  // likewise

  explicit PlaneConvolution(PaddedSize size);

  /// Transforms, lets `map(block)` replace the values at all wavenumbers, block by block, and transforms back
  /// (unnormalised).
  template <class Map>
  void convolve(const Fields& in, const Map& map, const Results& out) {
    load(in);
    const std::size_t count = size_.quarter_rows();
    share_out(size_.columns / 2 + 1, static_cast<int>(work_.size()), [&](int kx, int slot) {
      Work& work = work_[static_cast<std::size_t>(slot)];
      transform_columns(work, kx, in.rows);
      const std::size_t first = static_cast<std::size_t>(kx) * count;
      const std::array blocks{take(work, first, false), take(work, first, true)};
      for (const WavenumberBlock<Real>& block : blocks) map(block);
      put(blocks[0], false, work);
      put(blocks[1], true, work);
      transform_columns_back(work, kx, out);
    });
    unload(out);
  }

 private:
  using complex = std::complex<Real>;
  static constexpr std::size_t fields = 3;
  struct Work {
    FftBuffer<Real> lines;           // some rows
    FftBuffer<complex> transformed;  // these
    std::array<FftBuffer<complex>, fields> columns;
    std::array<FftBuffer<Real>, 2> blocks;  // of ky >= 0 and of -ky
  };
  complex* column(std::size_t field, int kx) {
    return spectra_[field].data() + static_cast<std::ptrdiff_t>(kx) * size_.rows;
  }
  void load(const Fields& in);
  void unload(const Results& out);
  void transform_columns(Work& work, int kx, int rows);
  void transform_columns_back(Work& work, int kx, const Results& out);
  WavenumberBlock<Real> take(Work& work, std::size_t first, bool negative) const;
  void put(const WavenumberBlock<Real>& block, bool negative, Work& work) const;

  PaddedSize size_;
  const FftLine<Real>& along_x_;
  const FftLine<complex>& along_y_;
  std::vector<Work> work_;                          // of each thread
  std::array<FftBuffer<complex>, fields> spectra_;  // y running fastest
  std::array<bool, fields> given_{};                // of the fields loaded last: else zero
};

}  // namespace rollres
