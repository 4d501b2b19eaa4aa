#include "core/fft.hpp"

#include <mutex>

namespace rollres {

namespace {

std::mutex& planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

fftw_complex* fftw(std::complex<double>* data) { return reinterpret_cast<fftw_complex*>(data); }

}  // namespace

FftPlan::FftPlan(int columns, int rows) {
  FftBuffer<double> field(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  FftBuffer<std::complex<double>> spectrum(static_cast<std::size_t>(columns / 2 + 1) * static_cast<std::size_t>(rows));
  const std::lock_guard lock(planner_mutex());
  forward_ = fftw_plan_dft_r2c_2d(rows, columns, field.data(), fftw(spectrum.data()), FFTW_ESTIMATE);
  inverse_ = fftw_plan_dft_c2r_2d(rows, columns, fftw(spectrum.data()), field.data(), FFTW_ESTIMATE);
}

FftPlan::~FftPlan() {
  const std::lock_guard lock(planner_mutex());
  if (forward_) fftw_destroy_plan(forward_);
  if (inverse_) fftw_destroy_plan(inverse_);
}

void FftPlan::forward(FftBuffer<double>& field, FftBuffer<std::complex<double>>& spectrum) const {
  fftw_execute_dft_r2c(forward_, field.data(), fftw(spectrum.data()));
}

void FftPlan::inverse(FftBuffer<std::complex<double>>& spectrum, FftBuffer<double>& field) const {
  fftw_execute_dft_c2r(inverse_, fftw(spectrum.data()), field.data());
}

int good_fft_size(int size) {
  for (;; ++size) {
    int rest = size;
    for (const int prime : {2, 3, 5, 7})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return size;
  }
}

void inverse_fft(FftBuffer<std::complex<double>>& spectrum, FftBuffer<double>& field, int columns, int rows) {
  FftPlan(columns, rows).inverse(spectrum, field);
}

}  // namespace rollres
