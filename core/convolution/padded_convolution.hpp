#pragma once

/// Convolution of surface fields on a zero-padded grid by fast Fourier transform, three fields at once.
///
/// Two fields even in y (p, q) and one odd in y (o), given for y >= 0, make one complex field
///   z = (p + o) + i q   mirrored to y < 0,
/// whose transform holds all three: with a, b, c the values of Z at (kx, ky), (kx, -ky), (-kx, ky) and d at (-kx, -ky),
///   P = (a + conj c)/2,   O = (a - b)/2,   Q = (a - conj d)/(2i),
/// for kx, ky >= 0 (P and Q even, O odd in ky; negative kx by conjugation). Only rows that are not zero are transformed
/// along x, and only those wanted on the way back. Along y a pair of columns +-kx is transformed, multiplied and
/// transformed back at once, while it is in the cache.
///
/// A single field even in y (EvenTransform) takes half of that. Large grids are shared out to threads (threads.hpp).

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "core/numerics/fft.hpp"
#include "core/numerics/threads.hpp"

namespace rollres {

/// Complex values at the wavenumbers kx, ky >= 0 of a padded grid, ky running fastest: index = kx * (rows/2 + 1) + ky.
template <class Real>
struct Spectrum {
  std::vector<Real> re, im;
};

/// The transforms of three fields at `count` consecutive wavenumbers from index `first` of a Spectrum.
template <class Real>
struct WavenumberBlock {
  std::size_t first = 0;
  int count = 0;
  Real *even_re = nullptr, *even_im = nullptr;      // P
  Real *odd_re = nullptr, *odd_im = nullptr;        // O
  Real *second_re = nullptr, *second_im = nullptr;  // Q
};

/// Size of the padded grid; rows = 1 for a line.
struct PaddedSize {
  int columns = 0, rows = 0;
  std::size_t quarter_rows() const { return static_cast<std::size_t>(rows / 2 + 1); }
  std::size_t quarter_size() const { return static_cast<std::size_t>(columns / 2 + 1) * quarter_rows(); }
  double points() const { return static_cast<double>(columns) * rows; }
};

/// Large enough that a convolution of fields of columns * rows values of the whole grid does not wrap around within
/// `more_columns` beyond them.
PaddedSize padded_size(int columns, int rows, int more_columns);

/// An object serves one thread at a time (it keeps work space).
template <class Real>
class PaddedConvolution {
 public:
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  /// Rows y >= 0 of fields of `columns` values each; an empty vector is zero (in) or not wanted (null, out).
  struct Fields {
    const Vector *even, *odd, *second_even;
    int columns, rows;
  };
  struct Results {
    Vector *even, *odd, *second_even;
    int columns, rows;
  };

  explicit PaddedConvolution(PaddedSize size);

  PaddedSize size() const { return size_; }

  /// Transforms, lets `map(block)` replace the values at all wavenumbers, block by block, and transforms back
  /// (unnormalised). On a line there is no odd field.
  template <class Map>
  void convolve(const Fields& in, const Map& map, const Results& out) {
    load(in, 0);
    pass_wavenumbers(in.rows, map, &out);
    unload(out);
  }

  /// Transforms only and shows the values to `visit(block)`; column i of the fields stands at x = first_column + i,
  /// wrapped around the padded grid.
  template <class Visit>
  void transform(const Fields& in, int first_column, const Visit& visit) {
    load(in, first_column);
    pass_wavenumbers(in.rows, visit, nullptr);
  }

 private:
  using complex = std::complex<Real>;
  complex* column(int kx) {
    return spectrum_.data() + static_cast<std::size_t>(kx) * static_cast<std::size_t>(size_.rows);
  }
  /// Whether a column is its own partner at -kx.
  bool single(int kx) const { return kx == 0 || 2 * kx == size_.columns; }
  struct Work {
    FftBuffer<complex> lines, transformed;  // some rows
    FftBuffer<complex> columns;             // a pair of transformed columns
    FftBuffer<Real> block;
  };
  static WavenumberBlock<Real> block_of(Work& work, std::size_t first, std::size_t count) {
    Real* const at = work.block.data();
    return {first,          static_cast<int>(count), at, at + count, at + 2 * count, at + 3 * count,
            at + 4 * count, at + 5 * count};
  }
  int threads() const { return static_cast<int>(work_.size()); }
  void load(const Fields& in, int first_column);
  void unload(const Results& out);
  void unload_rows(Work& work, int row, const Results& out);
  void unload_odd_rows(Work& work, int row, const Results& out);
  void split(const Work& work, int kx, const WavenumberBlock<Real>& block);
  void join(Work& work, int kx, const WavenumberBlock<Real>& block);
  void split_line(const WavenumberBlock<Real>& block);
  void join_line(const WavenumberBlock<Real>& block);
  void transform_columns(Work& work, int kx, int rows);
  void transform_columns_back(Work& work, int kx, const Results& out);

  template <class Map>
  void pass_wavenumbers(int rows, const Map& map, const Results* out) {
    if (size_.rows == 1) {
      const WavenumberBlock<Real> block = block_of(work_[0], 0, size_.quarter_size());
      split_line(block);
      map(block);
      if (out) join_line(block);
      return;
    }
    const std::size_t count = size_.quarter_rows();
    share_out(size_.columns / 2 + 1, threads(), [&](int kx, int slot) {
      Work& work = work_[static_cast<std::size_t>(slot)];
      const WavenumberBlock<Real> block = block_of(work, static_cast<std::size_t>(kx) * count, count);
      transform_columns(work, kx, rows);
      split(work, kx, block);
      map(block);
      if (!out) return;
      join(work, kx, block);
      transform_columns_back(work, kx, *out);
    });
  }

  PaddedSize size_;
  const FftLine<complex>&along_x_, &along_y_;
  std::vector<Work> work_;       // of each thread
  FftBuffer<complex> spectrum_;  // y running fastest
};

/// The same for a single field and a kernel that is even in y. The field is even in y, too, and given for y >= 0, or it
/// is any, and given whole.
template <class Real>
class EvenTransform {
 public:
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

  EvenTransform(PaddedSize size, bool folded);

  PaddedSize size() const { return size_; }

  /// Convolves `in` (columns * rows values) with the kernel, given by its transform, into `out`
  /// (out_columns * rows values); unnormalised.
  void convolve(const Vector& in, int columns, int rows, const Spectrum<Real>& kernel, Vector& out, int out_columns);

 private:
  using complex = std::complex<Real>;
  PaddedSize size_;
  bool folded_;
  const FftLine<Real>& along_x_;
  const FftLine<complex>& along_y_;
  struct Work {
    FftBuffer<Real> lines;
    FftBuffer<complex> transformed, column;
  };
  std::vector<Work> work_;       // of each thread
  FftBuffer<complex> spectrum_;  // y running fastest
};

}  // namespace rollres
