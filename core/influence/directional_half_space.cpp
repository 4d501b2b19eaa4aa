#include "core/influence/directional_half_space.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace rollres {

namespace {

using Eigen::Index;
using namespace coefficient;
using Row = Eigen::ArrayXd;

double sign_of(Index n) { return n % 2 == 0 ? 1 : -1; }

/// Sums over n >= j of g_n and of (-1)^{n-j} g_n, over `share(j)`; one more, 0, at the end.
struct TailSums {
  Row plain, alternating;

  template <class Share>
  TailSums(const Row& g, Share share) : plain(Row::Zero(g.size() + 1)), alternating(Row::Zero(g.size() + 1)) {
    double sum = 0, turning = 0;
    for (Index j = g.size() - 1; j > 0; --j) {
      sum += g(j);
      turning = g(j) - turning;
      plain(j) = sum / share(j);
      alternating(j) = turning / share(j);
    }
  }
  double plain_step(Index l) const { return plain(l) - plain(l + 1); }
  double alternating_pair(Index l) const { return alternating(l) + alternating(l + 1); }
};

double even_share(Index j) { return static_cast<double>(2 * j - 1) / 2; }
double odd_share(Index j) { return static_cast<double>(j); }

double x_atan_of(double x, double y) { return x == 0 ? 0 : x * std::atan(y / x); }

/// Harmonics of the direction (x, y)/r: waves of each order, or those that F has in their place.
template <class Take>
void for_each_harmonic(double x, double y, double r, Index count, const Take& take) {
  const std::complex<double> direction(x / r, y / r), twice = direction * direction;
  std::complex<double> even = 1;
  for (Index n = 0; n < count; ++n) {
    take(n, even, even * direction);
    even *= twice;
  }
}

Coefficients waves(const std::complex<double>& even, const std::complex<double>& odd) {
  Coefficients values;
  values << even.real(), even.real(), even.real(), even.imag(), odd.real(), odd.imag();
  return values;
}

/// Adds `share` times the functions F is made of.
void add_corner(double share, double x, double y, Harmonics& values) {
  const double square = x * x + y * y;
  if (square == 0) return;
  const double r = std::sqrt(square), log_r = 0.5 * std::log(square);
  const double along = share * x_asinh(x, y), across = share * x_asinh(y, x);
  values.col(0).head<3>() += along;
  values.col(1).head<3>() += across;
  values(uw, 0) += share * x_atan_of(x, y);
  values(uw, 1) += share * y * log_r;
  values(vw, 0) += share * x * log_r;
  values(vw, 1) += share * x_atan_of(y, x);
  // F/r has sines where K has cosines of even order, and the reverse.
  for_each_harmonic(x, y, r, values.cols() - 2, [&](Index n, const auto& even, const auto& odd) {
    Coefficients wave;
    wave << even.imag(), even.imag(), even.imag(), even.real(), odd.imag(), odd.real();
    values.col(n + 2) += share * r * wave;
  });
}

}  // namespace

Harmonics response_harmonics(const Harmonics& symbols) {
  Harmonics response = symbols / (2 * M_PI);
  for (Index n = 0; n < symbols.cols(); ++n) {
    response.col(n).head<4>() *= sign_of(n);
    response.col(n).tail<2>() *= -sign_of(n);
  }
  return response;
}

Harmonics direction_waves(double x, double y, Index harmonics) {
  Harmonics values(6, harmonics);
  for_each_harmonic(x, y, std::sqrt(x * x + y * y), harmonics,
                    [&](Index n, const auto& even, const auto& odd) { values.col(n) = waves(even, odd); });
  return values;
}

CellFunctions::CellFunctions(double x, double y, double cell_x, double cell_y, Index harmonics) {
  constexpr double many = 1000;  // cells, where F has lost six digits
  const double half_x = 0.5 * cell_x, half_y = 0.5 * cell_y;
  far = std::max(std::abs(x) / cell_x, std::abs(y) / cell_y) > many;
  if (!far) {
    values = Harmonics::Zero(6, harmonics + 2);
    const double share = 1 / (cell_x * cell_y);
    add_corner(share, x + half_x, y + half_y, values);
    add_corner(-share, x + half_x, y - half_y, values);
    add_corner(-share, x - half_x, y + half_y, values);
    add_corner(share, x - half_x, y - half_y, values);
    return;
  }
  constexpr double gauss = 0.57735026918962576;
  values = Harmonics::Zero(6, harmonics);
  for (const double px : {x - gauss * half_x, x + gauss * half_x})
    for (const double py : {y - gauss * half_y, y + gauss * half_y}) {
      const double r = std::sqrt(px * px + py * py);
      for_each_harmonic(px, py, r, harmonics, [&](Index n, const auto& even, const auto& odd) {
        values.col(n) += waves(even, odd) / (4 * r);
      });
    }
}

/// The coefficients h_l of (K14) and of its logarithms.
DirectionalHalfSpace::DirectionalHalfSpace(const Harmonics& response)
    : response_(response), antiderivative_(Harmonics::Zero(6, response.cols() + 2)) {
  const Index count = response.cols();
  for (const Index c : {ww, uu, vv, uw, vw})
    for (Index n = 0; n < count; ++n) {
      antiderivative_(c, 0) += sign_of(n) * response(c, n);
      antiderivative_(c, 1) += response(c, n);
    }
  auto series = antiderivative_.rightCols(count);
  for (const Index c : {ww, uu, vv, uv}) {
    const TailSums tails(response.row(c), even_share);
    for (Index l = 0; l < count; ++l)
      series(c, l) = (c == uv ? -0.5 : 0.5) * (tails.alternating_pair(l) - tails.plain_step(l));
  }
  // vw is uw with x and y exchanged.
  Row exchanged = response.row(vw);
  for (Index n = 0; n < count; ++n) exchanged(n) *= sign_of(n);
  const TailSums along(response.row(uw), odd_share), across(exchanged, odd_share);
  for (Index l = 0; l < count; ++l) {
    series(uw, l) = 0.5 * (along.alternating_pair(l) - along.plain_step(l));
    series(vw, l) = 0.5 * sign_of(l) * (across.alternating_pair(l) - across.plain_step(l));
  }
}

}  // namespace rollres
