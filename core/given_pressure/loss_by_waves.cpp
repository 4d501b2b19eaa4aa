#include "core/given_pressure/loss_by_waves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/model/contact_surface.hpp"
#include "core/numerics/quadrature.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

using std::numbers::pi;

double square(double value) { return value * value; }

/// A transform's square, the mean of it over many oscillations, and a place where those end evenly: at such places and
/// whole multiples of pi/2 beyond, what follows cancels to second order.
struct Transform {
  double (*squared)(double z);
  double (*mean)(double z);
  double even_place;
};

constexpr Transform of_disc{[](double z) { return square(2 * ::j1(z) / z); },
                            [](double z) { return 4 / (pi * z * z * z); }, pi / 4};
constexpr Transform of_ball{
    [](double z) { return square(z < 0.05 ? 1 - z * z / 10 : 3 * (std::sin(z) - z * std::cos(z)) / (z * z * z)); },
    [](double z) { return 4.5 * (1 + z * z) / std::pow(z, 6); }, 0};
constexpr Transform of_strip{[](double z) { return square(std::sin(z) / z); }, [](double z) { return 0.5 / (z * z); },
                             0};

struct WeightedPlace {
  double place, weight;
};

/// Places and weights for an integral from 0 to infinity with a transform's square.
std::vector<WeightedPlace> places_for(const Transform& transform, int order) {
  std::vector<WeightedPlace> all;
  const QuadratureRule& rule = gauss_rule(order);
  const auto add = [&](double from, double to, double (*weighted)(double)) {
    for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
      const double z = from + (to - from) * rule.nodes[q];
      all.push_back({z, (to - from) * rule.weights[q] * weighted(z)});
    }
  };
  constexpr std::array<double, 7> rising{0, 1e-4, 1e-3, 1e-2, 0.1, 0.4, 1};
  for (std::size_t i = 0; i + 1 < rising.size(); ++i) add(rising[i], rising[i + 1], transform.squared);
  const double last = transform.even_place + 2 * pi * order;
  for (double from = rising.back(); from < last; from += pi / 2)
    add(from, std::min(from + pi / 2, last), transform.squared);
  constexpr double farthest = 1e8, wider = 4;
  for (double from = last; from < farthest; from *= wider) add(from, wider * from, transform.mean);
  return all;
}

/// Angles from the motion to across it, and their weights: long memories tell waves nearly across it apart.
std::vector<WeightedPlace> angles_for(int order) {
  constexpr std::array<double, 8> ends{0, 0.4, 0.7, 0.88, 0.96, 0.99, 0.999, 1};
  std::vector<WeightedPlace> all;
  const QuadratureRule& rule = gauss_rule(order);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    for (std::size_t q = 0; q < rule.nodes.size(); ++q)
      all.push_back({pi / 2 * (ends[i] + (ends[i + 1] - ends[i]) * rule.nodes[q]),
                     pi / 2 * (ends[i + 1] - ends[i]) * rule.weights[q]});
  return all;
}

class Loss {
 public:
  explicit Loss(const ContactModel& model) : area_(*model.loaded), surface_(steady_surface(model)) {}

  /// Integral over a quarter of the waves, of phi^2 and what a wave loses [1/N].
  double operator()(int order) const {
    return area_.shape == PressureShape::rectangle ? of_rectangle(order) : of_ellipse(order);
  }

 private:
  /// k_x times the imaginary part of the compliance.
  double of_wave(const SteadySurface::Moduli& moduli, double along, double across) const {
    const SurfaceCompliance c = surface_(moduli, along, across);
    double lost = c.normal.imag();
    if (area_.traction != 0) {
      const double whole = along * along + across * across;
      lost += square(area_.traction) * (along * along * c.longitudinal.imag() + across * across * c.transverse.imag()) /
              whole;
    }
    return along * lost;
  }

  double of_ellipse(int order) const {
    const bool uniform = area_.distribution == PressureDistribution::uniform;
    const std::vector<WeightedPlace> angles = angles_for(order);
    double sum = 0;
    for (const WeightedPlace& z : places_for(uniform ? of_disc : of_ball, order)) {
      require_time();
      for (const WeightedPlace& angle : angles) {
        const double along = z.place * std::cos(angle.place) / area_.half_length,
                     across = z.place * std::sin(angle.place) / area_.half_width;
        sum += z.weight * z.place * angle.weight * of_wave(surface_.moduli(along), along, across);
      }
    }
    return sum / (area_.half_length * area_.half_width);
  }

  double of_rectangle(int order) const {
    const bool uniform = area_.distribution == PressureDistribution::uniform;
    const std::vector<WeightedPlace> sideways = places_for(of_strip, order);
    double sum = 0;
    for (const WeightedPlace& forwards : places_for(uniform ? of_strip : of_disc, order)) {
      require_time();
      const double along = forwards.place / area_.half_length;
      const SteadySurface::Moduli moduli = surface_.moduli(along);
      double row = 0;
      for (const WeightedPlace& aside : sideways)
        row += aside.weight * of_wave(moduli, along, aside.place / area_.half_width);
      sum += forwards.weight * row;
    }
    return sum / (area_.half_length * area_.half_width);
  }

  const LoadedArea& area_;
  SteadySurface surface_;
};

}  // namespace

LossByWaves loss_by_waves(const ContactModel& model, double wanted) {
  constexpr std::array<int, 5> orders{4, 6, 9, 13, 19};
  const Loss loss(model);
  const double factor = square(*model.load / pi);  // four quarters
  LossByWaves found{factor * loss(orders[0]), INFINITY};
  for (std::size_t i = 1; i < orders.size(); ++i) {
    const double next = factor * loss(orders[i]);
    found = {next, std::abs(next - found.resistance)};
    if (found.error <= wanted * std::abs(next)) break;
  }
  return found;
}

}  // namespace rollres
