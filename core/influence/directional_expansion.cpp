#include "core/influence/directional_expansion.hpp"

#include <algorithm>
#include <cmath>

#include "core/influence/elastic_kernel.hpp"

namespace rollres {

namespace {

using Eigen::Index;

/// Directions phi_j = pi (j + 1/2)/(2 N), j = 0 ... N - 1.
double angle(int j, int count) { return M_PI * (j + 0.5) / (2 * count); }

/// What the coefficients in direction j weigh in their harmonics.
Harmonics weights_of(int j, int count) {
  const double phi = angle(j, count);
  Harmonics weights(6, count);
  for (int n = 0; n < count; ++n) {
    const double even = (n == 0 ? 1.0 : 2.0) / count, odd = 2.0 / count;
    weights.col(n).head<3>() = even * std::cos(2 * n * phi);
    weights(coefficient::uv, n) = even * std::sin(2 * n * phi);
    weights(coefficient::uw, n) = odd * std::cos((2 * n + 1) * phi);
    weights(coefficient::vw, n) = odd * std::sin((2 * n + 1) * phi);
  }
  return weights;
}

/// The coefficients in a direction from symbols along and across the wave (K2).
Coefficients in_direction(double cosine, const LayerSymbols& c) {
  const double sine = std::sqrt(1 - cosine * cosine), along = cosine * cosine, across = sine * sine;
  Coefficients values;
  values << c.normal, along * c.longitudinal + across * c.transverse, across * c.longitudinal + along * c.transverse,
      cosine * sine * (c.longitudinal - c.transverse), cosine * c.cross, sine * c.cross;
  return values;
}

constexpr int most_harmonics = 96;
constexpr double left_out = 1e-6;  // of the largest harmonic

struct NeededHarmonics {
  int count = 0;
  double left_out = 0;
};

/// Harmonics that a half-space of the layer's material at rest needs, which is nearest to its Rayleigh waves.
NeededHarmonics harmonics_for(const MediumLayer& layer, double speed) {
  constexpr int many = 2 * most_harmonics;
  const double modulus = 1 / layer.material.at_rest();
  Harmonics all = Harmonics::Zero(6, many);
  for (int j = 0; j < many; ++j) {
    const double cosine = std::cos(angle(j, many));
    const SurfaceCompliance c = half_space_compliance(layer, modulus, speed * cosine);
    all += weights_of(j, many).colwise() *
           in_direction(cosine, {c.normal.real(), c.longitudinal.real(), c.cross.real(), c.transverse.real()});
  }
  const Eigen::ArrayXd sizes = all.abs().colwise().maxCoeff().transpose() / all.abs().maxCoeff();
  int count = most_harmonics;
  while (count > 2 && sizes(count - 1) < left_out) --count;
  return {count + 1, sizes(count + 1)};
}

}  // namespace

int order_of_harmonic(Index coefficient, int n) {
  return coefficient == coefficient::uw || coefficient == coefficient::vw ? 2 * n + 1 : 2 * n;
}

DirectionalExpansion::DirectionalExpansion(const LayeredMedium& medium, double wave_speed) {
  int count = 0;
  for (const MediumLayer& layer : medium) {
    const NeededHarmonics needed = harmonics_for(layer, wave_speed);
    count = std::max(count, needed.count);
    left_out_ = std::max(left_out_, needed.left_out);
  }
  for (int j = 0; j < count; ++j) {
    cosines_.push_back(std::cos(angle(j, count)));
    weights_.push_back(weights_of(j, count));
  }
  // Each time takes as many responses as there are directions.
  using Expansion = MediumExpansion;
  for (double per_decade = 1; per_decade <= Expansion::most_per_decade; per_decade += Expansion::denser) {
    expansions_.clear();
    expansions_.emplace_back(medium, wave_speed, per_decade);
    for (const double cosine : cosines_) {
      if (wave_speed == 0)
        expansions_.push_back(MediumExpansion(fastest()));
      else
        expansions_.emplace_back(medium, wave_speed * cosine, fastest());
    }
    per_decade = fastest().per_decade();
    if (!(error() > Expansion::wanted_error + left_out_)) break;
  }
}

Harmonics DirectionalExpansion::of_half_space(int term, LayerSymbols MediumTerm::*limit) const {
  Harmonics sum = Harmonics::Zero(6, harmonics());
  for (std::size_t j = 0; j < cosines_.size(); ++j)
    sum += weights_[j].colwise() *
           in_direction(cosines_[j], expansions_[j + 1].terms()[static_cast<std::size_t>(term)].*limit);
  return sum;
}

Eigen::ArrayXXd DirectionalExpansion::correction(double wavenumber) const {
  Eigen::ArrayXXd values = Eigen::ArrayXXd::Zero(6 * harmonics(), terms());
  for (std::size_t j = 0; j < cosines_.size(); ++j) {
    const MediumExpansion::Corrections c = expansions_[j + 1].correction(wavenumber);
    for (Index m = 0; m < terms(); ++m) {
      const Coefficients at = in_direction(
          cosines_[j], {.normal = c(0, m), .longitudinal = c(1, m), .cross = c(3, m), .transverse = c(2, m)});
      Eigen::Map<Harmonics>(&values(0, m), 6, harmonics()) += weights_[j].colwise() * at;
    }
  }
  return values;
}

double DirectionalExpansion::error() const {
  double largest = left_out_;
  for (const MediumExpansion& expansion : expansions_) largest = std::max(largest, expansion.error());
  return largest;
}

}  // namespace rollres
