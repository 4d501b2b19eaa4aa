#include "core/surface_transform.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>

namespace rollres {

namespace {

fftw_complex* fftw(std::complex<double>* data) { return reinterpret_cast<fftw_complex*>(data); }

/// One-dimensional transforms of `count` lines.
fftw_plan plan_lines(int length, int count, int in_stride, int in_distance, int out_stride, int out_distance,
                     std::complex<double>* in, std::complex<double>* out, int sign) {
  return fftw_plan_many_dft(1, &length, count, fftw(in), nullptr, in_stride, in_distance, fftw(out), nullptr,
                            out_stride, out_distance, sign, FFTW_ESTIMATE | FFTW_UNALIGNED);
}

}  // namespace

struct SurfaceTransform::Plans {
  fftw_plan upper = nullptr, lower = nullptr;  // along x, rows y >= 0 and y < 0, transposing
  fftw_plan columns_forward = nullptr, columns_inverse = nullptr;
  fftw_plan rows_inverse = nullptr;   // along x, rows y >= 0 only
  fftw_plan pairs_inverse = nullptr;  // along x, half as many

  ~Plans() {
    const std::lock_guard lock(fftw_planner_mutex());
    for (const fftw_plan plan : {upper, lower, columns_forward, columns_inverse, rows_inverse, pairs_inverse})
      if (plan) fftw_destroy_plan(plan);
  }
};

SurfaceTransform::SurfaceTransform(int columns, int rows, int more_columns)
    : columns_(columns),
      rows_(rows),
      padded_columns_(good_fft_size(2 * columns + more_columns)),
      padded_rows_(rows > 1 ? good_fft_size(4 * rows - 3) : 1),
      plans_(std::make_unique<Plans>()),
      rows_buffer_(static_cast<std::size_t>(2 * rows - 1) * static_cast<std::size_t>(padded_columns_)),
      spectrum_(static_cast<std::size_t>(padded_columns_) * static_cast<std::size_t>(padded_rows_)) {
  const int n = padded_columns_, m = padded_rows_;
  complex* const in = rows_buffer_.data();
  complex* const out = spectrum_.data();
  const std::lock_guard lock(fftw_planner_mutex());
  plans_->upper = plan_lines(n, rows, 1, n, m, 1, in, out, FFTW_FORWARD);
  plans_->rows_inverse = plan_lines(n, rows, m, 1, 1, n, out, in, FFTW_BACKWARD);
  if (rows == 1) return;
  plans_->pairs_inverse = plan_lines(n, rows / 2, m, 1, 1, n, out, in, FFTW_BACKWARD);
  plans_->lower = plan_lines(n, rows - 1, 1, n, m, 1, in + rows * n, out + m - rows + 1, FFTW_FORWARD);
  plans_->columns_forward = plan_lines(m, n, 1, m, 1, m, out, out, FFTW_FORWARD);
  plans_->columns_inverse = plan_lines(m, n, 1, m, 1, m, out, out, FFTW_BACKWARD);
}

SurfaceTransform::~SurfaceTransform() = default;

void SurfaceTransform::forward(const Eigen::VectorXd& even, const Eigen::VectorXd& odd,
                               const Eigen::VectorXd& second_even) {
  const auto width = static_cast<std::size_t>(padded_columns_);
  for (int row = 0; row < rows_; ++row) {
    const Eigen::Index first = static_cast<Eigen::Index>(row) * columns_;
    complex* upper = rows_buffer_.data() + static_cast<std::size_t>(row) * width;
    // Rows y < 0 follow in ascending y: row -1 is the last of them.
    complex* lower = row == 0 ? nullptr : rows_buffer_.data() + static_cast<std::size_t>(2 * rows_ - 1 - row) * width;
    for (int column = 0; column < columns_; ++column) {
      const double p = even.size() > 0 ? even(first + column) : 0, o = odd.size() > 0 ? odd(first + column) : 0;
      const double q = second_even.size() > 0 ? second_even(first + column) : 0;
      upper[column] = {row == 0 ? p : p + o, q};
      if (lower) lower[column] = {p - o, q};
    }
    std::fill(upper + columns_, upper + width, complex());
    if (lower) std::fill(lower + columns_, lower + width, complex());
  }
  fftw_execute_dft(plans_->upper, fftw(rows_buffer_.data()), fftw(spectrum_.data()));
  if (rows_ == 1) return;
  fftw_execute_dft(plans_->lower, fftw(rows_buffer_.data() + static_cast<std::size_t>(rows_) * width),
                   fftw(spectrum_.data() + padded_rows_ - rows_ + 1));
  for (int kx = 0; kx < padded_columns_; ++kx)
    std::fill(&spectrum(kx, rows_), &spectrum(kx, padded_rows_ - rows_) + 1, complex());
  fftw_execute_dft(plans_->columns_forward, fftw(spectrum_.data()), fftw(spectrum_.data()));
}

void SurfaceTransform::inverse(int columns, Eigen::VectorXd* even, Eigen::VectorXd* odd, Eigen::VectorXd* second_even) {
  const Eigen::Index size = static_cast<Eigen::Index>(columns) * rows_;
  for (Eigen::VectorXd* field : {even, odd, second_even})
    if (field) field->resize(size);
  const auto width = static_cast<std::size_t>(padded_columns_);
  if (rows_ > 1) fftw_execute_dft(plans_->columns_inverse, fftw(spectrum_.data()), fftw(spectrum_.data()));
  const bool parted = odd && rows_ > 1;
  if (parted) {
    // (z(y) + z(-y))/2 = p + i q stays on rows y >= 0; (z(y) - z(-y))/2 = o is real.
    for (int kx = 0; kx < padded_columns_; ++kx)
      for (int row = 1; row < rows_; ++row) {
        complex &upper = spectrum(kx, row), &lower = spectrum(kx, padded_rows_ - row);
        const complex sum = 0.5 * (upper + lower), difference = 0.5 * (upper - lower);
        upper = sum;
        lower = difference;
      }
  }
  fftw_execute_dft(plans_->rows_inverse, fftw(spectrum_.data()), fftw(rows_buffer_.data()));
  for (int row = 0; row < rows_; ++row) {
    const complex* values = rows_buffer_.data() + static_cast<std::size_t>(row) * width;
    const Eigen::Index first = static_cast<Eigen::Index>(row) * columns;
    for (int column = 0; column < columns; ++column) {
      if (even) (*even)(first + column) = values[column].real();
      if (second_even) (*second_even)(first + column) = values[column].imag();
    }
  }
  if (!odd) return;
  odd->setZero();
  if (!parted) return;
  // Two rows of the real field o make one complex row.
  const complex i(0, 1);
  for (int kx = 0; kx < padded_columns_; ++kx)
    for (int pair = 0; 2 * pair + 1 < rows_; ++pair) {
      const int first = 2 * pair + 1, second = first + 1;
      complex value = spectrum(kx, padded_rows_ - first);
      if (second < rows_) value += i * spectrum(kx, padded_rows_ - second);
      spectrum(kx, pair) = value;
    }
  fftw_execute_dft(plans_->pairs_inverse, fftw(spectrum_.data()), fftw(rows_buffer_.data()));
  for (int pair = 0; 2 * pair + 1 < rows_; ++pair) {
    const complex* values = rows_buffer_.data() + static_cast<std::size_t>(pair) * width;
    for (int column = 0; column < columns; ++column) {
      (*odd)(static_cast<Eigen::Index>(2 * pair + 1) * columns + column) = values[column].real();
      if (2 * pair + 2 < rows_)
        (*odd)(static_cast<Eigen::Index>(2 * pair + 2) * columns + column) = values[column].imag();
    }
  }
}

}  // namespace rollres
