#pragma once

/// Thin layer over FFTW in double and single precision: aligned buffers, transforms of lines, and real
/// transforms of two-dimensional arrays (x running fastest). All are unnormalised. The planner of FFTW is not
/// thread-safe and is guarded; executing plans is. Plans are made once for each size and shared by all threads.

#include <fftw3.h>

#include <complex>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
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

/// Transforms of lines of `length` complex values from one place to another, both aligned for FFTW or a multiple of two
/// complex values from there. The inverse may destroy its input.
template <class Real>
class FftLine {
 public:
  explicit FftLine(int length);
  ~FftLine();
  FftLine(const FftLine&) = delete;
  FftLine& operator=(const FftLine&) = delete;

  void forward(std::complex<Real>* from, std::complex<Real>* to) const;
  void inverse(std::complex<Real>* from, std::complex<Real>* to) const;

 private:
  struct Plans;
  std::unique_ptr<Plans> plans_;
};

/// The same from `length` (even) real values to length/2 + 1 complex ones and back.
template <class Real>
class RealFftLine {
 public:
  explicit RealFftLine(int length);
  ~RealFftLine();
  RealFftLine(const RealFftLine&) = delete;
  RealFftLine& operator=(const RealFftLine&) = delete;

  void forward(Real* from, std::complex<Real>* to) const;
  void inverse(std::complex<Real>* from, Real* to) const;

 private:
  struct Plans;
  std::unique_ptr<Plans> plans_;
};

/// Plans for real arrays of `columns` by `rows` and spectra of (columns/2 + 1) by rows.
class FftPlan {
 public:
  FftPlan(int columns, int rows);
  ~FftPlan();
  FftPlan(const FftPlan&) = delete;
  FftPlan& operator=(const FftPlan&) = delete;

  /// `inverse` destroys its input.
  void inverse(FftBuffer<std::complex<double>>& spectrum, FftBuffer<double>& field) const;

 private:
  fftw_plan inverse_ = nullptr;
};

/// The plans for a length, made once.
template <class Real>
const FftLine<Real>& shared_fft_line(int length);
template <class Real>
const RealFftLine<Real>& shared_real_fft_line(int length);

/// The size from `size` to twice that whose transform is the fastest: few, small and mostly even prime factors.
int good_fft_size(int size);

}  // namespace rollres
