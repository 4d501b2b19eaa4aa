#include "core/numerics/fft.hpp"

#include <map>
#include <mutex>

namespace rollres {

namespace {

std::mutex& planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

template <class Real>
struct Fftw;

template <>
struct Fftw<double> {
  using Plan = fftw_plan;
  using Complex = fftw_complex;
  static constexpr auto plan = fftw_plan_dft_1d;
  static constexpr auto plan_forward = fftw_plan_dft_r2c_1d;
  static constexpr auto plan_inverse = fftw_plan_dft_c2r_1d;
  static constexpr auto execute = fftw_execute_dft;
  static constexpr auto execute_forward = fftw_execute_dft_r2c;
  static constexpr auto execute_inverse = fftw_execute_dft_c2r;
  static constexpr auto destroy = fftw_destroy_plan;
};

template <>
struct Fftw<float> {
  using Plan = fftwf_plan;
  using Complex = fftwf_complex;
  static constexpr auto plan = fftwf_plan_dft_1d;
  static constexpr auto plan_forward = fftwf_plan_dft_r2c_1d;
  static constexpr auto plan_inverse = fftwf_plan_dft_c2r_1d;
  static constexpr auto execute = fftwf_execute_dft;
  static constexpr auto execute_forward = fftwf_execute_dft_r2c;
  static constexpr auto execute_inverse = fftwf_execute_dft_c2r;
  static constexpr auto destroy = fftwf_destroy_plan;
};

template <class Real>
typename Fftw<Real>::Complex* fftw(std::complex<Real>* data) {
  return reinterpret_cast<typename Fftw<Real>::Complex*>(data);
}

template <class Real>
void destroy(typename Fftw<Real>::Plan forward, typename Fftw<Real>::Plan inverse) {
  const std::lock_guard lock(planner_mutex());
  Fftw<Real>::destroy(forward);
  Fftw<Real>::destroy(inverse);
}

}  // namespace

template <class Real>
struct FftLine<Real>::Plans {
  typename Fftw<Real>::Plan forward, inverse;
  ~Plans() { destroy<Real>(forward, inverse); }
};

template <class Real>
FftLine<Real>::FftLine(int length) : plans_(std::make_unique<Plans>()) {
  FftBuffer<std::complex<Real>> from(static_cast<std::size_t>(length)), to(static_cast<std::size_t>(length));
  const std::lock_guard lock(planner_mutex());
  plans_->forward = Fftw<Real>::plan(length, fftw(from.data()), fftw(to.data()), FFTW_FORWARD, FFTW_ESTIMATE);
  plans_->inverse = Fftw<Real>::plan(length, fftw(from.data()), fftw(to.data()), FFTW_BACKWARD, FFTW_ESTIMATE);
}

template <class Real>
FftLine<Real>::~FftLine() = default;

template <class Real>
void FftLine<Real>::forward(std::complex<Real>* from, std::complex<Real>* to) const {
  Fftw<Real>::execute(plans_->forward, fftw(from), fftw(to));
}

template <class Real>
void FftLine<Real>::inverse(std::complex<Real>* from, std::complex<Real>* to) const {
  Fftw<Real>::execute(plans_->inverse, fftw(from), fftw(to));
}

template <class Real>
struct RealFftLine<Real>::Plans {
  typename Fftw<Real>::Plan forward, inverse;
  ~Plans() { destroy<Real>(forward, inverse); }
};

template <class Real>
RealFftLine<Real>::RealFftLine(int length) : plans_(std::make_unique<Plans>()) {
  FftBuffer<Real> field(static_cast<std::size_t>(length));
  FftBuffer<std::complex<Real>> spectrum(static_cast<std::size_t>(length / 2 + 1));
  const std::lock_guard lock(planner_mutex());
  plans_->forward = Fftw<Real>::plan_forward(length, field.data(), fftw(spectrum.data()), FFTW_ESTIMATE);
  plans_->inverse = Fftw<Real>::plan_inverse(length, fftw(spectrum.data()), field.data(), FFTW_ESTIMATE);
}

template <class Real>
RealFftLine<Real>::~RealFftLine() = default;

template <class Real>
void RealFftLine<Real>::forward(Real* from, std::complex<Real>* to) const {
  Fftw<Real>::execute_forward(plans_->forward, from, fftw(to));
}

template <class Real>
void RealFftLine<Real>::inverse(std::complex<Real>* from, Real* to) const {
  Fftw<Real>::execute_inverse(plans_->inverse, fftw(from), to);
}

FftPlan::FftPlan(int columns, int rows) {
  FftBuffer<double> field(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  FftBuffer<std::complex<double>> spectrum(static_cast<std::size_t>(columns / 2 + 1) * static_cast<std::size_t>(rows));
  const std::lock_guard lock(planner_mutex());
  inverse_ = fftw_plan_dft_c2r_2d(rows, columns, fftw(spectrum.data()), field.data(), FFTW_ESTIMATE);
}

FftPlan::~FftPlan() {
  const std::lock_guard lock(planner_mutex());
  fftw_destroy_plan(inverse_);
}

void FftPlan::inverse(FftBuffer<std::complex<double>>& spectrum, FftBuffer<double>& field) const {
  fftw_execute_dft_c2r(inverse_, fftw(spectrum.data()), field.data());
}

namespace {

template <class Line>
const Line& shared_line(int length) {
  static std::mutex mutex;
  static std::map<int, std::unique_ptr<const Line>> kept;
  const std::lock_guard lock(mutex);
  std::unique_ptr<const Line>& line = kept[length];
  if (!line) line = std::make_unique<const Line>(length);
  return *line;
}

}  // namespace

template <class Real>
const FftLine<Real>& shared_fft_line(int length) {
  return shared_line<FftLine<Real>>(length);
}

template <class Real>
const RealFftLine<Real>& shared_real_fft_line(int length) {
  return shared_line<RealFftLine<Real>>(length);
}

template class FftLine<double>;
template class FftLine<float>;
template class RealFftLine<double>;
template class RealFftLine<float>;
template const FftLine<double>& shared_fft_line(int);
template const FftLine<float>& shared_fft_line(int);
template const RealFftLine<double>& shared_real_fft_line(int);
template const RealFftLine<float>& shared_real_fft_line(int);

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
