#pragma once

/// Thin layer over FFTW in double and single precision: aligned buffers, transforms of lines, and the
/// real one of two-dimensional arrays (x running fastest). All are unnormalised. The planner of FFTW is not thread-safe
/// and is guarded; executing plans is.

#include <fftw3.h>

#include <complex>
#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

namespace rollres {

/// Zero-initialised array aligned for FFTW.
template <class Value>
class FftBuffer {
 public:
  FftBuffer() = default;
  explicit FftBuffer(std::size_t size) : data_(static_cast<Value*>(fftw_malloc(size * sizeof(Value)))), size_(size) {
    if (!data_) throw std::bad_alloc();
    std::memset(static_cast<void*>(data_), 0, size * sizeof(Value));
  }
  FftBuffer(FftBuffer&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  FftBuffer& operator=(FftBuffer&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~FftBuffer() { fftw_free(data_); }

  Value& operator[](std::size_t i) { return data_[i]; }
  const Value& operator[](std::size_t i) const { return data_[i]; }
  Value* data() { return data_; }
  const Value* data() const { return data_; }
  std::size_t size() const { return size_; }

 private:
  Value* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Transforms of lines of `length` values to as many complex ones and back, or of real values, even in number, to
/// length/2 + 1 complex ones. Both places are aligned for FFTW or a multiple of two complex values from there. The
/// inverse may destroy its input.
template <class Value>
class FftLine {
 public:
  using Complex = std::complex<decltype(std::abs(Value()))>;

  explicit FftLine(int length);
  ~FftLine();
  FftLine(const FftLine&) = delete;
  FftLine& operator=(const FftLine&) = delete;

  void forward(Value* from, Complex* to) const;
  void inverse(Complex* from, Value* to) const;

 private:
  using Plan = std::conditional_t<std::is_same_v<Complex, std::complex<double>>, fftw_plan, fftwf_plan>;
  Plan forward_, inverse_;
};

/// The plans for a length, made once.
template <class Value>
const FftLine<Value>& shared_fft_line(int length);

/// Real array of `columns` by `rows` from its spectrum of (columns/2 + 1) by rows, which is destroyed.
void inverse_plane(int columns, int rows, FftBuffer<std::complex<double>>& spectrum, FftBuffer<double>& field);

/// The size from `size` to twice that whose transform is the fastest: few, small and mostly even prime factors.
int good_fft_size(int size);

}  // namespace rollres
