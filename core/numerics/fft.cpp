#include "core/numerics/fft.hpp"

#include <map>
#include <mutex>

namespace rollres {

namespace {

std::mutex& planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

template <class Complex>
struct Fftw;

template <>
struct Fftw<std::complex<double>> {
  using Pointer = fftw_complex*;
  static constexpr auto plan = fftw_plan_dft_1d;
  static constexpr auto plan_forward = fftw_plan_dft_r2c_1d;
  static constexpr auto plan_inverse = fftw_plan_dft_c2r_1d;
  static constexpr auto execute = fftw_execute_dft;
  static constexpr auto execute_forward = fftw_execute_dft_r2c;
  static constexpr auto execute_inverse = fftw_execute_dft_c2r;
  static constexpr auto destroy = fftw_destroy_plan;
};

template <>
struct Fftw<std::complex<float>> {
  using Pointer = fftwf_complex*;
  static constexpr auto plan = fftwf_plan_dft_1d;
  static constexpr auto plan_forward = fftwf_plan_dft_r2c_1d;
  static constexpr auto plan_inverse = fftwf_plan_dft_c2r_1d;
  static constexpr auto execute = fftwf_execute_dft;
  static constexpr auto execute_forward = fftwf_execute_dft_r2c;
  static constexpr auto execute_inverse = fftwf_execute_dft_c2r;
  static constexpr auto destroy = fftwf_destroy_plan;
};

template <class Complex>
typename Fftw<Complex>::Pointer fftw(Complex* data) {
  return reinterpret_cast<typename Fftw<Complex>::Pointer>(data);
}

}  // namespace

template <class Value>
FftLine<Value>::FftLine(int length) {
  using Library = Fftw<Complex>;
  FftBuffer<Value> values(static_cast<std::size_t>(length));
  FftBuffer<Complex> spectrum(static_cast<std::size_t>(length));
  const auto from = values.data();
  const auto to = fftw(spectrum.data());
  const std::lock_guard lock(planner_mutex());
  if constexpr (std::is_same_v<Value, Complex>) {
    forward_ = Library::plan(length, fftw(from), to, FFTW_FORWARD, FFTW_ESTIMATE);
    inverse_ = Library::plan(length, fftw(from), to, FFTW_BACKWARD, FFTW_ESTIMATE);
  } else {
    forward_ = Library::plan_forward(length, from, to, FFTW_ESTIMATE);
    inverse_ = Library::plan_inverse(length, to, from, FFTW_ESTIMATE);
  }
}

template <class Value>
FftLine<Value>::~FftLine() {
  const std::lock_guard lock(planner_mutex());
  Fftw<Complex>::destroy(forward_);
  Fftw<Complex>::destroy(inverse_);
}

template <class Value>
void FftLine<Value>::forward(Value* from, Complex* to) const {
  if constexpr (std::is_same_v<Value, Complex>)
    Fftw<Complex>::execute(forward_, fftw(from), fftw(to));
  else
    Fftw<Complex>::execute_forward(forward_, from, fftw(to));
}

template <class Value>
void FftLine<Value>::inverse(Complex* from, Value* to) const {
  if constexpr (std::is_same_v<Value, Complex>)
    Fftw<Complex>::execute(inverse_, fftw(from), fftw(to));
  else
    Fftw<Complex>::execute_inverse(inverse_, fftw(from), to);
}

template <class Value>
const FftLine<Value>& shared_fft_line(int length) {
  static std::mutex mutex;
  static std::map<int, FftLine<Value>> kept;
  const std::lock_guard lock(mutex);
  return kept.try_emplace(length, length).first->second;
}

template class FftLine<double>;
template class FftLine<float>;
template class FftLine<std::complex<double>>;
template class FftLine<std::complex<float>>;
template const FftLine<double>& shared_fft_line(int);
template const FftLine<float>& shared_fft_line(int);
template const FftLine<std::complex<double>>& shared_fft_line(int);
template const FftLine<std::complex<float>>& shared_fft_line(int);

void inverse_plane(int columns, int rows, FftBuffer<std::complex<double>>& spectrum, FftBuffer<double>& field) {
  std::unique_lock lock(planner_mutex());
  const fftw_plan plan = fftw_plan_dft_c2r_2d(rows, columns, fftw(spectrum.data()), field.data(), FFTW_ESTIMATE);
  lock.unlock();
  fftw_execute(plan);
  lock.lock();
  fftw_destroy_plan(plan);
}

int good_fft_size(int size) {
  // Time per point as measured with FFTW 3.3.10, relative to a power of two.
  const auto slowness = [](int candidate) {
    int odd = candidate;
    while (odd % 2 == 0) odd /= 2;
    int rest = odd;
    for (const int prime : {3, 5})
      while (rest % prime == 0) rest /= prime;
    if (rest != 1) return 10.0;
    const bool vectorised = candidate % 16 == 0;
    return vectorised && odd <= 5 ? 1.0 : vectorised && odd <= 25 ? 1.25 : 1.6;
  };
  const int first = (size + 3) / 4 * 4;
  int best = first;
  double least = slowness(first) * first;
  for (int candidate = first + 4; candidate <= 2 * first; candidate += 4)
    if (slowness(candidate) * candidate < least) {
      best = candidate;
      least = slowness(candidate) * candidate;
    }
  return best;
}

}  // namespace rollres
