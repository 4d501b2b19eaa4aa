#include "core/surface/deep_medium.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/messages/message_text.hpp"
#include "core/numerics/bracketed_root.hpp"
#include "core/numerics/quadrature.hpp"
#include "core/surface/layered_medium.hpp"

namespace rollres {

namespace {

using complex = std::complex<double>;
using Ratios = Eigen::Array3cd;

/// The half-space next to the contact at rates s per length: J = J_inf + sum C/(1 + s T).
class DeepMedium {
 public:
  /// @param lengths ascending, V time of the terms of the shear compliance J
  DeepMedium(const MediumLayer& layer, double speed, double instantaneous, std::vector<double> lengths,
             std::vector<double> compliances)
      : layer_(layer),
        speed_(speed),
        share_(2 * (1 - layer.poisson_ratio)),
        instantaneous_(instantaneous),
        lengths_(std::move(lengths)),
        compliances_(std::move(compliances)) {
    layer_.thickness = INFINITY;
  }

  template <class Number>
  Number compliance(const Number& s) const {
    Number sum = instantaneous_;
    for (std::size_t m = 0; m < lengths_.size(); ++m) sum += compliances_[m] / (1.0 + s * lengths_[m]);
    return sum;
  }
  double instantaneous() const { return instantaneous_; }
  const std::vector<double>& lengths() const { return lengths_; }
  double density() const { return layer_.density; }

  Ratios at_compliance(const complex& j) const {
    const SurfaceCompliance c = half_space_compliance(layer_, 1.0 / j, speed_);
    const complex d = share_ * j;
    return {2.0 * c.normal / d, 2.0 * c.longitudinal / d, c.cross / d};
  }
  double share() const { return share_; }

  /// J at which shear waves, waves of pressure and Rayleigh waves are as fast as the body; infinite: none.
  double shear_wave() const { return 1 / (layer_.density * speed_ * speed_); }
  double pressure_wave() const { return shear_wave() * share_ / (1 - 2 * layer_.poisson_ratio); }
  double rayleigh_wave() const {
    const auto stiffness = [&](double part) {
      return (1.0 / half_space_compliance(layer_, 1 / (part * shear_wave()), speed_).normal).real();
    };
    return shear_wave() * bracketed_root(stiffness, 0.3, 1 - 1e-12);
  }

  /// The s between -1/T of a term and that of the next longer where J has a value; nothing where that is -1/T itself to
  /// `nearest`, since the term hardly yields or the body is slow.
  /// @throws std::domain_error if it is that of the next longer one
  std::optional<double> rate_of(std::size_t term, double value, double nearest) const {
    // With y = 1/(1 + s T) the compliance rises from one pole to the other.
    const double length = lengths_[term];
    const auto rate = [&](double y) { return (1 / y - 1) / length; };
    double low = 1;
    if (term + 1 < lengths_.size()) low = (1 + 1e-13) / (1 - length / lengths_[term + 1]);
    const auto excess = [&](double y) { return compliance(rate(y)) - value; };
    if (!(excess(low) < 0))
      throw std::domain_error(message_text(
          "inertia: the waves of the half-space at the contact were not found below the retardation time of ",
          length / speed_,
          " s, since the next longer one hardly yields; leave out what is so weak in its material, or ",
          "give \"inertia\": \"off\""));
    double high = 2 * low;
    while (excess(high) < 0 && high * nearest < 1) high *= 2;
    const std::optional<double> found = root_between(excess, low, high);
    return found ? std::optional(rate(*found)) : std::nullopt;
  }

 private:
  MediumLayer layer_;
  double speed_, share_, instantaneous_;
  std::vector<double> lengths_, compliances_;
};

/// Makes the sum of `values`, a function of J that is analytic in s but for the poles and cuts of the medium's waves.
template <class Values>
class WaveSum {
 public:
  /// @param grows  whether the values go to infinity with J: then they have fewer digits the nearer the waves' rates
  /// are to the memory's, and where these cannot be told apart the memory itself is left. What else is there does as
  /// little as it is apart.
  WaveSum(const DeepMedium& medium, bool grows, Values values)
      : medium_(medium), grows_(grows), nearest_(grows ? 1e-5 : 1e-12), values_(std::move(values)) {}

  RetardedSum made() {
    sum_.at_once = values_(medium_.instantaneous()).real();
    if (!(medium_.density() > 0)) return std::move(sum_);
    double before = -INFINITY;  // last rate of the waves of shorter memories
    for (std::size_t m = 0; m < medium_.lengths().size(); ++m) before = add_waves_of(m, before);
    return std::move(sum_);
  }

 private:
  /// @return their last rate
  double add_waves_of(std::size_t m, double before) {
    const std::optional<double> shear = medium_.rate_of(m, medium_.shear_wave(), nearest_),
                                rayleigh = medium_.rate_of(m, medium_.rayleigh_wave(), nearest_);
    const double pole = -1 / medium_.lengths()[m];
    if (!shear || !rayleigh) {
      const double after = m + 1 < medium_.lengths().size() ? -1 / medium_.lengths()[m + 1] : 0;
      if (grows_) add_as_one(pole, 0.5 * std::min(pole - before, after - pole));
      return pole;
    }
    sum_.add(*rayleigh, within(*rayleigh, 0.5 * (*rayleigh - *shear)).first);
    if (std::isfinite(medium_.pressure_wave())) {
      const double pressure = medium_.rate_of(m, medium_.pressure_wave(), nearest_).value_or(pole);
      if (pressure > pole) add_cut(pole, pressure);
      add_cut(pressure, *shear);
    } else {
      add_cut(pole, *shear);
    }
    return *rayleigh;
  }

  /// Residue and first moment of the values within a circle.
  std::pair<Eigen::Array3d, Eigen::Array3d> within(double centre, double radius) const {
    constexpr int around = 48;
    std::pair<Eigen::Array3d, Eigen::Array3d> found{Eigen::Array3d::Zero(), Eigen::Array3d::Zero()};
    for (int k = 0; k < around; ++k) {
      const complex arm = std::polar(radius, 2 * M_PI * (k + 0.5) / around);
      const Ratios part = values_(medium_.compliance(centre + arm)) * arm / static_cast<double>(around);
      found.first += part.real();
      found.second += (part * arm).real();
    }
    return found;
  }

  /// Waves so near to each other that one rate stands for them, of each component its own.
  void add_as_one(double centre, double radius) {
    const auto [residue, moment] = within(centre, radius);
    for (Eigen::Index i = 0; i < residue.size(); ++i) {
      Eigen::Array3d alone = Eigen::Array3d::Zero();
      alone(i) = residue(i);
      const double apart = moment(i) / residue(i);
      sum_.add(std::abs(apart) < 0.1 * radius ? centre + apart : centre, alone);  // else nothing but rounding
    }
  }

  /// A cut, whose density is smooth in the angle. Many points, for zeros of Rayleigh's function lie near it on the
  /// other sheet; what stands for them at a distance is smooth along it, and needs few.
  void add_cut(double from, double to) {
    constexpr int fine = 64;
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from), apart = -middle / half;
    const double rate = apart + std::sqrt(apart * apart - 1);
    const int few = std::clamp(2 + static_cast<int>(28 / std::log(rate)), 3, fine);  // to rate^-few = 1e-12
    Eigen::Array3Xd series = Eigen::Array3Xd::Zero(3, few);                          // sums with T_k along the cut
    const QuadratureRule& rule = gauss_rule(fine);
    for (std::size_t j = 0; j < fine; ++j) {
      const double angle = M_PI * rule.nodes[j];
      const complex on_cut(medium_.compliance(middle + half * std::cos(angle)), 0);
      const Eigen::Array3d density = values_(on_cut * complex(1, -1e-40)).imag();
      for (int k = 0; k < few; ++k)
        series.col(k) -= density * (half * std::sin(angle) * rule.weights[j] * std::cos(k * angle));
    }
    for (int i = 0; i < few; ++i) {
      const double angle = M_PI * (i + 0.5) / few;
      Eigen::Array3d part = series.col(0) / few;
      for (int k = 1; k < few; ++k) part += series.col(k) * (2 * std::cos(k * angle) / few);
      sum_.add(middle + half * std::cos(angle), part);
    }
  }

  const DeepMedium& medium_;
  bool grows_;
  double nearest_;
  Values values_;
  RetardedSum sum_;
};

}  // namespace

std::vector<HalfSpaceTerm> half_space_terms(const MediumLayer& layer, double speed) {
  CreepSpectrum creep = layer.material;
  std::sort(creep.terms.begin(), creep.terms.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  std::vector<double> lengths, compliances;
  for (const CreepSpectrum::Term& term : creep.terms) {
    constexpr double apart = 1.001;
    if (!(term.compliance > 0) || !(term.time > 0)) continue;
    if (!lengths.empty() && speed * term.time < apart * lengths.back()) return {};
    lengths.push_back(speed * term.time);
    compliances.push_back(term.compliance);
  }
  const DeepMedium medium(layer, speed, creep.instantaneous, lengths, compliances);
  constexpr double nearly = 0.98;
  if (layer.density > 0 && medium.compliance(0.0) > nearly * medium.rayleigh_wave()) return {};
  const auto compliances_at = [&](const complex& j) -> Ratios {
    const Ratios ratios = medium.at_compliance(j);
    const complex deep = medium.share() * j;
    return {0.5 * deep * ratios(0), 0.5 * deep * ratios(1), deep * ratios(2)};
  };
  const RetardedSum sum = WaveSum(medium, true, compliances_at).made();
  std::vector<HalfSpaceTerm> terms{{0, sum.at_once}};
  for (std::size_t c = 0; c < sum.lengths.size(); ++c) terms.push_back({sum.lengths[c], sum.weights[c]});
  return terms;
}

RetardedSum half_space_ratios(const MediumLayer& layer, double speed, double instantaneous,
                              const std::vector<double>& lengths, const std::vector<double>& compliances) {
  const DeepMedium medium(layer, speed, instantaneous, lengths, compliances);
  return WaveSum(medium, false, [&](const complex& j) { return medium.at_compliance(j); }).made();
}

}  // namespace rollres
