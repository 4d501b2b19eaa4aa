#include "core/spectral/sliding_base.hpp"

#include <cmath>

#include "core/numerics/quadrature.hpp"
#include "tests/catch.hpp"

using namespace rollres;

namespace {

const SpectralEdges edges{{-1.2, 0.8}, {{-0.7, -0.4}, {-0.1, 0.5}}};
const SlipPattern pattern{.shear = true, .slips = {-1, 1, -1}};

/// int p m h dx over the contact in many panels, p = sqrt(1 - t^2) U_n(t).
template <class Smooth>
double integral(const SlidingBase& base, int n, const Smooth& h) {
  const QuadratureRule rule = gauss_legendre(20);
  const double borders[] = {-1.2, -0.7, -0.4, -0.1, 0.5, 0.8};
  double sum = 0;
  for (int zone = 0; zone < 5; ++zone) {
    const double middle = 0.5 * (borders[zone] + borders[zone + 1]), half = 0.5 * (borders[zone + 1] - borders[zone]);
    constexpr int panels = 400;
    for (int panel = 0; panel < panels; ++panel)
      for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
        const double angle = M_PI * (panel + rule.nodes[q]) / panels, x = middle + half * std::cos(angle);
        const double place = std::acos((x - edges.contact.centre()) / edges.contact.half_length());
        sum += M_PI / panels * rule.weights[q] * half * std::sin(angle) * std::sin((n + 1) * place) *
               base.direction(x) * h(x);
      }
  }
  return sum;
}

}  // namespace

TEST_CASE("the shear of sliding in turns meets each zone's direction and is continuous", "[core][sliding_base]") {
  const SlidingBase base(pattern, edges, 6, 12);
  CHECK(base.direction(-1) == -1);
  CHECK(base.direction(-0.3) == 1);
  CHECK(base.direction(0.7) == -1);
  CHECK(base.direction(0.2) == Approx(0).margin(1e-15));
  for (const double border : {-0.7, -0.4, -0.1, 0.5})
    CHECK(base.direction(border - 1e-10) == Approx(base.direction(border + 1e-10)).margin(1e-4));
}

TEST_CASE("smooth functions are integrated against the sliding shear by its nodes", "[core][sliding_base]") {
  const SlidingBase base(pattern, edges, 6, 12);
  for (int n = 0; n < 6; ++n) {
    const double sum = base.densities().col(n).dot(Eigen::VectorXd(base.nodes().array().exp()));
    CHECK(sum == Approx(integral(base, n, [](double x) { return std::exp(x); })).epsilon(1e-11).margin(1e-11));
  }
}

TEST_CASE("the slope of a half-space under the sliding shear is its Cauchy integral", "[core][sliding_base]") {
  for (const int order : {6, 20}) {
    const SlidingBase base(pattern, edges, order, 16);
    for (const double x : {-2.0, -1.3, -0.95, -0.55, -0.2, 0.13, 0.49, 0.6, 0.9, 3.0}) {
      const Eigen::RowVectorXd slope = base.slope(x);
      for (const int n : {0, 1, 5}) {
        // The jump of the integrand is taken out and put back as a principal value.
        const bool inside = x > -1.2 && x < 0.8;
        const double t = (x - edges.contact.centre()) / edges.contact.half_length();
        const double there = inside ? std::sin((n + 1) * std::acos(t)) * base.direction(x) : 0;
        const QuadratureRule rule = gauss_legendre(20);
        double sum = there * (inside ? std::log((x + 1.2) / (0.8 - x)) : 0);
        const double borders[] = {-1.2, -0.7, -0.4, -0.1, 0.5, 0.8};
        for (int zone = 0; zone < 5; ++zone) {
          const double middle = 0.5 * (borders[zone] + borders[zone + 1]);
          const double half = 0.5 * (borders[zone + 1] - borders[zone]);
          for (int panel = 0; panel < 600; ++panel)
            for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
              const double angle = M_PI * (panel + rule.nodes[q]) / 600, y = middle + half * std::cos(angle);
              const double place = std::acos((y - edges.contact.centre()) / edges.contact.half_length());
              sum += M_PI / 600 * rule.weights[q] * half * std::sin(angle) *
                     (std::sin((n + 1) * place) * base.direction(y) - there) / (x - y);
            }
        }
        CAPTURE(order, x, n);
        // Rounding of the difference quotient next to x.
        CHECK(slope(n) == Approx(-sum / (2 * M_PI)).margin(2e-9));
      }
    }
  }
}
