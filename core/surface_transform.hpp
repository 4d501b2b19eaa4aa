#pragma once

/// Fourier transform of three surface fields at once, zero-padded for convolution.
///
/// Two fields even in y (p, q) and one odd in y (o), given for y >= 0, make one complex field
///   z = (p + o) + i q   mirrored to y < 0,
/// whose transform holds all three: with a, b, c the values of Z at (kx, ky), (kx, -ky), (-kx, ky) and d at (-kx, -ky),
///   P = (a + conj c)/2,   O = (a - b)/2,   Q = (a - conj d)/(2i),
/// for kx, ky >= 0 (P and Q even, O odd in ky; negative kx by conjugation). Only rows that are not zero are transformed
/// along x, and only rows y >= 0 on the way back.

#include <Eigen/Core>
#include <complex>
#include <memory>

#include "core/fft.hpp"

namespace rollres {

class SurfaceTransform {
 public:
  using complex = std::complex<double>;
  /// Values of the three fields' transforms at one wavenumber with kx, ky >= 0.
  struct Triple {
    complex even, odd, second_even;  // P, O, Q
  };

  /// @param columns, rows of the fields (rows y >= 0; 1 for a line)   @param more_columns read back beyond `columns`
  SurfaceTransform(int columns, int rows, int more_columns);
  ~SurfaceTransform();
  SurfaceTransform(const SurfaceTransform&) = delete;
  SurfaceTransform& operator=(const SurfaceTransform&) = delete;

  int padded_columns() const { return padded_columns_; }
  int padded_rows() const { return padded_rows_; }
  /// Wavenumbers kx, ky >= 0 in the order of `multiply`: ky running fastest.
  int quarter_columns() const { return padded_columns_ / 2 + 1; }
  int quarter_rows() const { return padded_rows_ / 2 + 1; }
  std::size_t quarter_size() const {
    return static_cast<std::size_t>(quarter_columns()) * static_cast<std::size_t>(quarter_rows());
  }

  /// Transforms fields of columns * rows values; an empty vector is zero.
  void forward(const Eigen::VectorXd& even, const Eigen::VectorXd& odd, const Eigen::VectorXd& second_even);
  /// Replaces the triple at each wavenumber by `map(index, triple)`.
  template <class Map>
  void multiply(const Map& map);
  /// Transforms back (unnormalised); null or, on a line, `odd`: not wanted.
  void inverse(int columns, Eigen::VectorXd* even, Eigen::VectorXd* odd, Eigen::VectorXd* second_even);

  /// Quarter spectrum of a real kernel on the padded grid: `at(column, row)` for offsets up to +-columns and, given for
  /// row >= 0, +-(2 rows - 2); even or odd in y.
  template <class At>
  std::vector<complex> kernel(int reach_x, int reach_y, bool odd_in_y, const At& at);

 private:
  complex& spectrum(int kx, int ky) {
    return spectrum_[static_cast<std::size_t>(kx) * static_cast<std::size_t>(padded_rows_) +
                     static_cast<std::size_t>(ky)];
  }

  int columns_, rows_, padded_columns_, padded_rows_;
  struct Plans;
  std::unique_ptr<Plans> plans_;
  FftBuffer<complex> rows_buffer_;  // rows y >= 0, then rows y < 0, each of padded_columns
  FftBuffer<complex> spectrum_;     // ky running fastest
};

template <class Map>
void SurfaceTransform::multiply(const Map& map) {
  const complex i(0, 1);
  std::size_t index = 0;
  for (int kx = 0; kx <= padded_columns_ / 2; ++kx) {
    const int minus_kx = kx == 0 ? 0 : padded_columns_ - kx;
    for (int ky = 0; ky <= padded_rows_ / 2; ++ky, ++index) {
      const int minus_ky = ky == 0 ? 0 : padded_rows_ - ky;
      complex &a = spectrum(kx, ky), &b = spectrum(kx, minus_ky);
      complex &c = spectrum(minus_kx, ky), &d = spectrum(minus_kx, minus_ky);
      const Triple in{0.5 * (a + std::conj(c)), 0.5 * (a - b), complex(0, -0.5) * (a - std::conj(d))};
      const Triple out = map(index, in);
      const complex plus = out.even + out.odd, minus = out.even - out.odd;
      const complex second = i * out.second_even, mirrored = i * std::conj(out.second_even);
      a = plus + second;
      b = minus + second;
      c = std::conj(minus) + mirrored;
      d = std::conj(plus) + mirrored;
    }
  }
}

template <class At>
std::vector<SurfaceTransform::complex> SurfaceTransform::kernel(int reach_x, int reach_y, bool odd_in_y, const At& at) {
  // All rows take part here, so the kernel is transformed on its own.
  FftBuffer<double> field(static_cast<std::size_t>(padded_columns_) * static_cast<std::size_t>(padded_rows_));
  for (int row = -reach_y; row <= reach_y; ++row)
    for (int column = -reach_x; column <= reach_x; ++column) {
      const int px = (column + padded_columns_) % padded_columns_, py = (row + padded_rows_) % padded_rows_;
      field[static_cast<std::size_t>(py) * static_cast<std::size_t>(padded_columns_) + static_cast<std::size_t>(px)] =
          (row < 0 && odd_in_y ? -1 : 1) * at(column, std::abs(row));
    }
  FftBuffer<complex> half(static_cast<std::size_t>(padded_columns_ / 2 + 1) * static_cast<std::size_t>(padded_rows_));
  shared_fft_plan(padded_columns_, padded_rows_)->forward(field, half);
  std::vector<complex> quarter;
  quarter.reserve(quarter_size());
  for (int kx = 0; kx < quarter_columns(); ++kx)
    for (int ky = 0; ky < quarter_rows(); ++ky)
      quarter.push_back(half[static_cast<std::size_t>(ky) * static_cast<std::size_t>(padded_columns_ / 2 + 1) +
                             static_cast<std::size_t>(kx)]);
  return quarter;
}

}  // namespace rollres
