#include "core/numerics/fft.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace rollres;

namespace {

/// e^{-c i} for i = 0 ... length - 1, whose transform is a geometric series.
template <class Value>
FftBuffer<Value> geometric(int length, double c) {
  FftBuffer<Value> values(static_cast<std::size_t>(length));
  for (int i = 0; i < length; ++i)
    values[static_cast<std::size_t>(i)] = static_cast<decltype(std::abs(Value()))>(std::exp(-c * i));
  return values;
}

std::complex<double> geometric_transform(int length, double c, int k) {
  const std::complex<double> ratio = std::exp(std::complex<double>(-c, -2 * M_PI * k / length));
  return (1.0 - std::exp(-c * length)) / (1.0 - ratio);
}

/// Transforms there, compares, and back. @param margin some roundings of a value; a sum of 48 of them takes as many
template <class Value>
void check_line(int length, int wavenumbers, double margin) {
  const double c = 0.1;
  FftBuffer<Value> values = geometric<Value>(length, c), back(static_cast<std::size_t>(length));
  FftBuffer<typename FftLine<Value>::Complex> spectrum(static_cast<std::size_t>(length));
  const FftLine<Value>& line = shared_fft_line<Value>(length);
  CHECK(&line == &shared_fft_line<Value>(length));
  line.forward(values.data(), spectrum.data());
  for (int k = 0; k < wavenumbers; ++k)
    CHECK(std::abs(std::complex<double>(spectrum[static_cast<std::size_t>(k)]) - geometric_transform(length, c, k)) <
          48 * margin);
  line.inverse(spectrum.data(), back.data());
  for (int i = 0; i < length; ++i)
    CHECK(std::abs(std::complex<double>(back[static_cast<std::size_t>(i)]) / double(length) - std::exp(-c * i)) <
          margin);
}

}  // namespace

TEST_CASE("a line of a geometric series has the transform of one, in either precision", "[core][fft]") {
  check_line<std::complex<double>>(48, 48, 1e-15);
  check_line<std::complex<float>>(48, 48, 1e-6);
  check_line<double>(48, 25, 1e-15);
  check_line<float>(48, 25, 1e-6);
}

TEST_CASE("a plane is the sum of its waves, x running fastest", "[core][fft]") {
  const int columns = 12, rows = 10, kx = 2, ky = 3;
  FftBuffer<std::complex<double>> spectrum(static_cast<std::size_t>((columns / 2 + 1) * rows));
  FftBuffer<double> field(static_cast<std::size_t>(columns * rows));
  spectrum[static_cast<std::size_t>(ky * (columns / 2 + 1) + kx)] = {0, 1};
  inverse_plane(columns, rows, spectrum, field);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      CHECK(field[static_cast<std::size_t>(y * columns + x)] ==
            Approx(-2 * std::sin(2 * M_PI * (double(kx) * x / columns + double(ky) * y / rows))).margin(1e-14));
}

TEST_CASE("a size for transforms is at least the one wanted and has small factors only", "[core][fft]") {
  for (const int wanted : {1, 7, 31, 97, 1000, 4097}) {
    const int size = good_fft_size(wanted);
    CHECK(size >= wanted);
    CHECK(size % 4 == 0);
    int rest = size;
    for (const int prime : {2, 3, 5})
      while (rest % prime == 0) rest /= prime;
    CHECK(rest == 1);
  }
}
