#include "core/fft.hpp"

#include <map>
#include <mutex>

namespace rollres {

namespace {

fftw_complex* fftw(std::complex<double>* data) { return reinterpret_cast<fftw_complex*>(data); }

}  // namespace

std::mutex& fftw_planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

FftPlan::FftPlan(int columns, int rows) {
  FftBuffer<double> field(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  FftBuffer<std::complex<double>> spectrum(static_cast<std::size_t>(columns / 2 + 1) * static_cast<std::size_t>(rows));
  const std::lock_guard lock(fftw_planner_mutex());
  forward_ = fftw_plan_dft_r2c_2d(rows, columns, field.data(), fftw(spectrum.data()), FFTW_ESTIMATE);
  inverse_ = fftw_plan_dft_c2r_2d(rows, columns, fftw(spectrum.data()), field.data(), FFTW_ESTIMATE);
}

FftPlan::~FftPlan() {
  const std::lock_guard lock(fftw_planner_mutex());
  if (forward_) fftw_destroy_plan(forward_);
  if (inverse_) fftw_destroy_plan(inverse_);
}

void FftPlan::forward(FftBuffer<double>& field, FftBuffer<std::complex<double>>& spectrum) const {
  fftw_execute_dft_r2c(forward_, field.data(), fftw(spectrum.data()));
}

void FftPlan::inverse(FftBuffer<std::complex<double>>& spectrum, FftBuffer<double>& field) const {
  fftw_execute_dft_c2r(inverse_, fftw(spectrum.data()), field.data());
}

std::shared_ptr<const FftPlan> shared_fft_plan(int columns, int rows) {
  static std::mutex mutex;
  static std::map<std::pair<int, int>, std::shared_ptr<const FftPlan>> plans;
  const std::lock_guard lock(mutex);
  std::shared_ptr<const FftPlan>& plan = plans[{columns, rows}];
  if (!plan) plan = std::make_shared<const FftPlan>(columns, rows);
  return plan;
}

int good_fft_size(int size) {
  const int step = size > 64 ? 8 : 4;
  for (size = (size + step - 1) / step * step;; size += step) {
    int rest = size;
    for (const int prime : {2, 3, 5})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return size;
  }
}

}  // namespace rollres
