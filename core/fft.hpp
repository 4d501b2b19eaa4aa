#pragma once

/// Thin layer over FFTW: aligned buffers and real transforms of two-dimensional arrays (x running fastest). The
/// planner of FFTW is not thread-safe and is guarded; executing plans is.

#include <fftw3.h>

#include <complex>
#include <cstddef>
#include <cstring>
#include <memory>
#include <mutex>
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

/// Guards the planner of FFTW.
std::mutex& fftw_planner_mutex();

/// Plans for real arrays of `columns` by `rows` and spectra of (columns/2 + 1) by rows; usable from many threads.
class FftPlan {
 public:
  FftPlan() = default;
  FftPlan(int columns, int rows);
  FftPlan(FftPlan&& other) noexcept { *this = std::move(other); }
  FftPlan& operator=(FftPlan&& other) noexcept {
    std::swap(forward_, other.forward_);
    std::swap(inverse_, other.inverse_);
    return *this;
  }
  ~FftPlan();

  /// Both transforms are unnormalised; `inverse` destroys its input.
  void forward(FftBuffer<double>& field, FftBuffer<std::complex<double>>& spectrum) const;
  void inverse(FftBuffer<std::complex<double>>& spectrum, FftBuffer<double>& field) const;

 private:
  fftw_plan forward_ = nullptr, inverse_ = nullptr;
};

/// The plan for a size, made once and shared by all threads.
std::shared_ptr<const FftPlan> shared_fft_plan(int columns, int rows);

/// Smallest size >= `size` that transforms fast: only prime factors 2, 3 and 5, a multiple of 4 (of 8 above 64).
int good_fft_size(int size);

}  // namespace rollres
