#include "core/corner_function.hpp"

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

/// x asinh(y/|x|), odd in both.
double x_asinh_of(double x, double y) { return x == 0 ? 0 : x * std::asinh(y / std::abs(x)); }
double x_atan_of(double x, double y) { return x == 0 ? 0 : x * std::atan(y / x); }

}  // namespace

Harmonics response_harmonics(const Harmonics& symbols) {
  Harmonics response = symbols / (2 * M_PI);
  for (Index n = 0; n < symbols.cols(); ++n) {
    response.col(n).head<4>() *= sign_of(n);
    response.col(n).tail<2>() *= -sign_of(n);
  }
  return response;
}

Coefficients harmonic_sum(const Harmonics& harmonics, double x, double y) {
  const double r = std::sqrt(x * x + y * y);
  const std::complex<double> direction(x / r, y / r), twice = direction * direction;
  std::complex<double> even = 1;
  Coefficients sum = Coefficients::Zero();
  for (Index n = 0; n < harmonics.cols(); ++n) {
    const std::complex<double> odd = even * direction;
    Coefficients wave;
    wave << even.real(), even.real(), even.real(), even.imag(), odd.real(), odd.imag();
    sum += harmonics.col(n) * wave;
    even *= twice;
  }
  return sum;
}

CornerFunction::CornerFunction(const Harmonics& response)
    : response_(response), series_(Harmonics::Zero(6, response.cols())) {
  const Index count = response.cols();
  for (const Index c : {ww, uu, vv, uw, vw})
    for (Index n = 0; n < count; ++n) {
      along_(c) += sign_of(n) * response(c, n);
      across_(c) += response(c, n);
    }
  for (const Index c : {ww, uu, vv, uv}) {
    const TailSums tails(response.row(c), even_share);
    for (Index l = 0; l < count; ++l)
      series_(c, l) = c == uv ? -0.5 * (tails.alternating_pair(l) - tails.plain_step(l))
                              : 0.5 * (tails.alternating_pair(l) - tails.plain_step(l));
  }
  // vw is uw with x and y exchanged.
  Row exchanged = response.row(vw);
  for (Index n = 0; n < count; ++n) exchanged(n) *= sign_of(n);
  const TailSums along(response.row(uw), odd_share), across(exchanged, odd_share);
  for (Index l = 0; l < count; ++l) {
    series_(uw, l) = 0.5 * (along.alternating_pair(l) - along.plain_step(l));
    series_(vw, l) = 0.5 * sign_of(l) * (across.alternating_pair(l) - across.plain_step(l));
  }
}

Coefficients CornerFunction::operator()(double x, double y) const {
  const double square = x * x + y * y;
  if (square == 0) return Coefficients::Zero();
  const double r = std::sqrt(square), log_r = 0.5 * std::log(square);
  // F/r has sines where K has cosines of even order, and the reverse.
  const std::complex<double> direction(x / r, y / r), twice = direction * direction;
  std::complex<double> even = 1;
  Coefficients sum = Coefficients::Zero();
  for (Index n = 0; n < series_.cols(); ++n) {
    const std::complex<double> odd = even * direction;
    Coefficients wave;
    wave << even.imag(), even.imag(), even.imag(), even.real(), odd.imag(), odd.real();
    sum += series_.col(n) * wave;
    even *= twice;
  }
  sum *= r;
  const double a = x_asinh_of(x, y), b = x_asinh_of(y, x);
  sum.head<3>() += along_.head<3>() * a + across_.head<3>() * b;
  sum(uw) += along_(uw) * x_atan_of(x, y) + across_(uw) * y * log_r;
  sum(vw) += along_(vw) * x * log_r + across_(vw) * x_atan_of(y, x);
  return sum;
}

Coefficients CornerFunction::average(double x, double y, double cell_x, double cell_y) const {
  constexpr double far = 1000;  // cells, where F has lost six digits
  const double half_x = 0.5 * cell_x, half_y = 0.5 * cell_y;
  if (std::max(std::abs(x) / cell_x, std::abs(y) / cell_y) < far) {
    const CornerFunction& corner = *this;
    return (corner(x + half_x, y + half_y) - corner(x + half_x, y - half_y) - corner(x - half_x, y + half_y) +
            corner(x - half_x, y - half_y)) /
           (cell_x * cell_y);
  }
  constexpr double gauss = 0.57735026918962576;
  Coefficients sum = Coefficients::Zero();
  for (const double px : {x - gauss * half_x, x + gauss * half_x})
    for (const double py : {y - gauss * half_y, y + gauss * half_y})
      sum += harmonic_sum(response_, px, py) / (4 * std::sqrt(px * px + py * py));
  return sum;
}

}  // namespace rollres
