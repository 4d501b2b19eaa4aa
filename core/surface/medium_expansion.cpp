#include "core/surface/medium_expansion.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/dense_algebra.hpp"
#include "core/material/prony_series.hpp"
#include "core/messages/message_text.hpp"
#include "core/numerics/bracketed_root.hpp"
#include "core/numerics/chebyshev.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

using complex = std::complex<double>;
using Eigen::Index;
using Symbols = Eigen::Array<complex, 4, 1>;

constexpr int coefficients = 12;   // of a panel
constexpr double panel_ratio = 2;  // of the wavenumbers at a panel's ends
// Rayleigh waves of an incompressible half-space need rho V^2/G = 0.9126, of a compressible one less.
constexpr double incompressible_rayleigh_number = 0.9126;

Symbols scaled(const SurfaceCompliance& c, double wavenumber) {
  return wavenumber * Symbols(c.normal, c.longitudinal, c.transverse, c.cross);
}

/// k c of the half-space of one layer's material, the same at any wavenumber.
Symbols half_space(const MediumLayer& layer, complex modulus, double wave_speed) {
  return scaled(half_space_compliance(layer, modulus, wave_speed), 1);
}

/// Waves in a layer decay like e^{-k beta z}, slowest at rest.
double slowest_decay(const MediumLayer& layer, double wave_speed) {
  const double number = layer.density * wave_speed * wave_speed * layer.material.at_rest();
  return std::sqrt(1 - std::min(number, incompressible_rayleigh_number));
}

struct TimeRange {
  double shortest = INFINITY, longest = 0;
  std::vector<double> exact;  // creep times of the layers
};

/// The time at which G has fallen to what waves of this speed need: longer than any creep time of the layer. At it the
/// response of a layer with inertia has its last pole.
double slowest_time(const MediumLayer& layer, double longest_creep_time, double wave_speed) {
  if (layer.density * wave_speed == 0) return longest_creep_time;
  const double enough = incompressible_rayleigh_number / (layer.density * wave_speed * wave_speed);
  const auto excess = [&](double share) {  // at the rate -share / time
    double compliance = layer.material.instantaneous;
    for (const CreepSpectrum::Term& term : layer.material.terms)
      compliance += term.compliance / (1 - share * term.time / longest_creep_time);
    return std::min(compliance, 2 * enough) - enough;
  };
  if (!(enough < INFINITY && excess(0) < 0 && excess(1) > 0)) return longest_creep_time;
  return longest_creep_time / bracketed_root(excess, 0, 1);
}

TimeRange time_range(const LayeredMedium& medium, double wave_speed) {
  TimeRange range;
  for (const MediumLayer& layer : medium) {
    if (layer.material.terms.empty()) continue;
    for (const RelaxationSpectrum::Term& term : relaxation_spectrum(layer.material).terms)
      range.shortest = std::min(range.shortest, term.time);
    for (const CreepSpectrum::Term& term : layer.material.terms) range.exact.push_back(term.time);
    range.longest = std::max(range.longest, slowest_time(layer, layer.material.terms.back().time, wave_speed));
  }
  std::sort(range.exact.begin(), range.exact.end());
  return range;
}

/// The exact times, and between them and the ends of the range as many as make `per_decade`.
std::vector<double> retardation_times(const TimeRange& range, double per_decade) {
  std::vector<double> times{0}, fixed{range.shortest};
  for (const double time : range.exact)
    if (time > 1.0001 * fixed.back()) fixed.push_back(time);
  if (range.longest > 1.0001 * fixed.back()) fixed.push_back(range.longest);
  times.push_back(fixed.front());
  for (std::size_t i = 1; i < fixed.size(); ++i) {
    const double ratio = fixed[i] / fixed[i - 1];
    const int parts = std::max(1, checked_count(std::ceil(std::log10(ratio) * per_decade), "retardation times"));
    for (int part = 1; part <= parts; ++part) times.push_back(fixed[i - 1] * std::pow(ratio, double(part) / parts));
  }
  return times;
}

/// Three frequencies for each retardation time, and beyond the ends.
std::vector<double> frequencies_for(const std::vector<double>& times, double offset) {
  std::vector<double> frequencies;
  const double from = std::log(1 / times.back()), to = std::log(1 / times[1]);
  constexpr double least = 0.1;  // of the range; times that coincide need no more frequencies than one
  const double step = std::min(0.25, std::max(to - from, least) / (3 * static_cast<double>(times.size())) + 1e-9);
  for (double at = from - 3.5 + offset * step; at < to + 3.5; at += step) frequencies.push_back(std::exp(at));
  return frequencies;
}

/// 1/(1 + i omega t) of all retardation times at all frequencies and, in the last two rows, of the glassy state: real
/// and imaginary parts below each other, each times the weight of its frequency.
Eigen::MatrixXd weighted_system(const std::vector<double>& frequencies, const std::vector<double>& times,
                                const Eigen::VectorXd& weights) {
  const auto rows = weights.size(), columns = static_cast<Index>(times.size());
  Eigen::MatrixXd system(2 * rows, columns);
  for (Index i = 0; i < rows; ++i)
    for (Index m = 0; m < columns; ++m) {
      const double time = times[static_cast<std::size_t>(m)];
      const complex value =
          i + 1 == rows ? (m == 0 ? 1.0 : 0.0) : 1.0 / complex(1, frequencies[static_cast<std::size_t>(i)] * time);
      system(2 * i, m) = weights(i) * value.real();
      system(2 * i + 1, m) = weights(i) * value.imag();
    }
  return system;
}

}  // namespace

MediumExpansion::MediumExpansion(const LayeredMedium& medium, double wave_speed, double per_decade) {
  if (const double finite = finite_thickness(medium); finite > 0) {
    highest_ = decayed / (medium.front().thickness * slowest_decay(medium.front(), wave_speed));
    lowest_ = 1e-3 / finite;
    const int panels =
        checked_count(std::ceil(std::log(highest_ / lowest_) / std::log(panel_ratio)), "panels of wavenumbers");
    for (int i = 0; i <= panels; ++i) borders_.push_back(std::log(lowest_) + std::log(highest_ / lowest_) * i / panels);
  }
  const TimeRange range = time_range(medium, wave_speed);
  for (;; per_decade += denser) {
    fit(medium, wave_speed, range.exact.empty() ? std::vector<double>{0} : retardation_times(range, per_decade));
    error_ = measured_error(medium, wave_speed);
    per_decade_ = per_decade;
    if (!(error_ > wanted_error) || per_decade + denser > most_per_decade) break;
  }
}

MediumExpansion::MediumExpansion(const LayeredMedium& medium, double wave_speed, const MediumExpansion& of_faster)
    : lowest_(of_faster.lowest_), highest_(of_faster.highest_), borders_(of_faster.borders_) {
  std::vector<double> times;
  for (const MediumTerm& term : of_faster.terms_) times.push_back(term.time);
  fit(medium, wave_speed, times);
  error_ = measured_error(medium, wave_speed);
}

void MediumExpansion::fit(const LayeredMedium& medium, double wave_speed, const std::vector<double>& times) {
  std::vector<double> frequencies{0};
  if (times.size() > 1) {
    frequencies = frequencies_for(times, 0);
    frequencies.push_back(0);
  }
  std::vector<std::vector<complex>> moduli;
  for (const double omega : frequencies) moduli.push_back(moduli_at(medium, omega));
  moduli.push_back({});  // the glassy state
  for (const MediumLayer& layer : medium) moduli.back().push_back(1 / layer.material.instantaneous);

  // Errors count relative to the most compliant layer at each frequency.
  const auto rows = static_cast<Index>(moduli.size()), columns = static_cast<Index>(times.size());
  require_memory(6 * 16.0 * static_cast<double>(rows) * static_cast<double>(columns),
                 message_text("the layers' response with ", columns, " retardation times"));
  Eigen::VectorXd weights = Eigen::VectorXd::Constant(rows, INFINITY);
  for (Index i = 0; i < rows; ++i)
    for (const complex& modulus : moduli[static_cast<std::size_t>(i)])
      weights(i) = std::min(weights(i), std::abs(modulus));
  // Times close together would get weights a thousand times the compliance that cancel, and with them the rounding of
  // their passages would count.
  constexpr double told_apart = 1e-10;
  const Eigen::MatrixXd inverse = pseudo_inverse(weighted_system(frequencies, times, weights), told_apart);
  const auto fitted = [&](const auto& symbols_at) {
    Eigen::MatrixX4d values(2 * rows, 4);
    for (Index i = 0; i < rows; ++i) {
      const Symbols symbols = symbols_at(moduli[static_cast<std::size_t>(i)]) * weights(i);
      values.row(2 * i) = symbols.real().matrix().transpose();
      values.row(2 * i + 1) = symbols.imag().matrix().transpose();
    }
    return Corrections((inverse * values).transpose().array());
  };
  const auto as_symbols = [](const Corrections& all, Index m) {
    return LayerSymbols{.normal = all(0, m), .longitudinal = all(1, m), .cross = all(3, m), .transverse = all(2, m)};
  };

  const Corrections deep = fitted([&](const auto& at) { return half_space(medium.front(), at.front(), wave_speed); });
  Corrections base = Corrections::Zero(4, columns);
  if (std::isinf(medium.back().thickness))
    base = fitted([&](const auto& at) { return half_space(medium.back(), at.back(), wave_speed); });
  terms_.clear();
  for (Index m = 0; m < columns; ++m)
    terms_.push_back({times[static_cast<std::size_t>(m)], as_symbols(deep, m), as_symbols(base, m)});

  coefficients_.clear();
  for (std::size_t panel = 0; panel + 1 < borders_.size(); ++panel) {
    const std::vector<Corrections> c = chebyshev_fit(coefficients).series<Corrections>([&](double t) {
      const double k = std::exp(borders_[panel] + 0.5 * (borders_[panel + 1] - borders_[panel]) * (1 + t));
      return fitted([&](const auto& at) -> Symbols {
        return scaled(surface_compliance(medium, at, k, wave_speed), k) -
               half_space(medium.front(), at.front(), wave_speed);
      });
    });
    coefficients_.insert(coefficients_.end(), c.begin(), c.end());
  }
}

MediumExpansion::Corrections MediumExpansion::correction(double wavenumber) const {
  if (wavenumber < lowest_) {  // linear to the limit of long waves
    const double share = wavenumber / lowest_;
    Corrections values = share * correction(lowest_);
    for (std::size_t m = 0; m < terms_.size(); ++m) {
      const LayerSymbols &deep = terms_[m].deep, &base = terms_[m].base;
      values.col(static_cast<Index>(m)) +=
          (1 - share) * Eigen::Array4d(base.normal - deep.normal, base.longitudinal - deep.longitudinal,
                                       base.transverse - deep.transverse, base.cross - deep.cross);
    }
    return values;
  }
  const double at = std::min(std::log(wavenumber), borders_.back()), step = borders_[1] - borders_[0];
  const auto panel =
      std::min(static_cast<std::size_t>(std::max(0.0, (at - borders_.front()) / step)), borders_.size() - 2);
  const double t = 2 * (at - borders_[panel]) / step - 1;
  const Corrections* c = &coefficients_[panel * coefficients];
  Corrections b1 = Corrections::Zero(4, c[0].cols()), b2 = b1;
  for (int i = coefficients - 1; i > 0; --i) {
    Corrections b0 = c[i] + 2 * t * b1 - b2;
    b2.swap(b1);
    b1.swap(b0);
  }
  return c[0] + t * b1 - b2;
}

double MediumExpansion::measured_error(const LayeredMedium& medium, double wave_speed) const {
  if (terms_.size() == 1) return 0;
  std::vector<double> times;
  for (const MediumTerm& term : terms_) times.push_back(term.time);
  std::vector<std::vector<complex>> moduli;
  const std::vector<double> frequencies = frequencies_for(times, 0.5);
  for (const double omega : frequencies) moduli.push_back(moduli_at(medium, omega));
  const bool layered = !borders_.empty();
  std::vector<double> wavenumbers{layered ? highest_ : 1};
  for (double k = 50 * lowest_; k < highest_ / 6; k *= 2) wavenumbers.push_back(k);
  double largest = 0;
  for (const double k : wavenumbers) {
    const Corrections values =
        layered ? correction(k) : Corrections(Corrections::Zero(4, static_cast<Index>(times.size())));
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
      const Symbols exact = scaled(surface_compliance(medium, moduli[i], k, wave_speed), k);
      Symbols sum = Symbols::Zero();
      for (std::size_t m = 0; m < terms_.size(); ++m) {
        const LayerSymbols& deep = terms_[m].deep;
        sum += (values.col(static_cast<Index>(m)) +
                Eigen::Array4d(deep.normal, deep.longitudinal, deep.transverse, deep.cross)) /
               complex(1, frequencies[i] * times[m]);
      }
      largest = std::max(largest, (sum - exact).abs().maxCoeff() / exact.abs().maxCoeff());
    }
  }
  return largest;
}

}  // namespace rollres
