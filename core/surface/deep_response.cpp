#include "core/surface/deep_response.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/messages/message_text.hpp"
#include "core/numerics/bracketed_root.hpp"
#include "core/numerics/memory_functions.hpp"
#include "core/numerics/quadrature.hpp"
#include "core/surface/layered_medium.hpp"

namespace rollres {

namespace {

using complex = std::complex<double>;
using Ratios = Eigen::Array3cd;

/// Of the shortest of the memories, up to where powers of the distance stand for exponentials.
constexpr double series_reach = 0.3;

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

/// A function of s as at_once + sum weights/(1 + s lengths).
struct RetardedSum {
  Eigen::Array3d at_once;
  std::vector<double> lengths;
  std::vector<Eigen::Array3d> weights;

  void add(double rate, const Eigen::Array3d& part) {  // part/(s - rate)
    lengths.push_back(-1 / rate);
    weights.push_back(-part / rate);
  }
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

DeepResponse::DeepResponse(const MediumLayer& top, double speed, double instantaneous,
                           const std::vector<double>& creep_length, const std::vector<double>& creep_compliance,
                           double length) {
  at_once_ << 1, 1, -0.25 * (1 - 2 * top.poisson_ratio) / (1 - top.poisson_ratio);
  if (top.density == 0) return;
  const double share = 2 * (1 - top.poisson_ratio);
  std::vector<double> compliances = creep_compliance;
  for (double& compliance : compliances) compliance /= share;
  const DeepMedium medium(top, speed, instantaneous / share, creep_length, compliances);
  const auto ratios_at = [&](const complex& j) { return medium.at_compliance(j); };
  const RetardedSum ratios = WaveSum(medium, false, ratios_at).made();
  at_once_ = ratios.at_once;
  lengths_ = ratios.lengths;
  const std::vector<Eigen::Array3d>& weights = ratios.weights;
  weights_.resize(3, static_cast<Eigen::Index>(weights.size()));
  for (std::size_t c = 0; c < weights.size(); ++c) weights_.col(static_cast<Eigen::Index>(c)) = weights[c];
  if (lengths_.empty()) return;
  shortest_length_ = *std::min_element(lengths_.begin(), lengths_.end());
  moments_ = Eigen::Array3Xd::Zero(3, 12);
  rests_ = Eigen::Array2Xd::Zero(2, 12);
  for (std::size_t c = 0; c < lengths_.size(); ++c) {
    Eigen::Array3d term = weights[c] / lengths_[c];
    for (Eigen::Index k = 0; k < moments_.cols(); term /= lengths_[c] * static_cast<double>(++k))
      moments_.col(k) += term;
    // R_T [1/x] = -e^y ln|x|/T + e^y [ln T - gamma - sum (-y)^i/(i i!)]/T, y = x/T.
    constexpr double euler = 0.57721566490153286;
    for (Eigen::Index k = 0; k < rests_.cols(); ++k) {
      double sum = (std::log(lengths_[c]) - euler) / std::tgamma(k + 1.0);
      for (Eigen::Index i = 1; i <= k; ++i)
        sum += (i % 2 ? 1 : -1) / (static_cast<double>(i) * std::tgamma(i + 1.0) * std::tgamma(k - i + 1.0));
      rests_.col(k) += weights[c].head<2>() * sum / std::pow(lengths_[c], k + 1.0);
    }
  }
  // Nearer, powers of the distance do; where these reach as far as the table would, there is none.
  longest_ = std::log(1e3 * length);
  shortest_ = std::log(0.99 * series_reach * shortest_length_);
  if (shortest_ >= longest_) return;
  std::vector<double> borders;
  const int panels = static_cast<int>((longest_ - shortest_) / 1.2) + 1;
  for (int i = 0; i <= panels; ++i) borders.push_back(shortest_ + (longest_ - shortest_) * i / panels);
  table_ = std::make_shared<ChebyshevTable<5>>(std::move(borders), 13, [&](double logarithm) {
    const double x = std::exp(logarithm);
    const LayerSlopes ahead = summed(x), behind = summed(-x);
    Eigen::Array<double, 5, 1> values;
    values << ahead.head<2>(), behind.head<3>();
    return Eigen::Array<double, 5, 1>(values * x);
  });
}

Eigen::Array3cd DeepResponse::at(double wavenumber) const {
  Eigen::Array3cd sum = at_once_.cast<complex>();
  for (std::size_t c = 0; c < lengths_.size(); ++c)
    sum += weights_.col(static_cast<Eigen::Index>(c)) / complex(1, -wavenumber * lengths_[c]);
  return sum;
}

LayerSlopes DeepResponse::summed(double x) const {
  LayerSlopes sum = LayerSlopes::Zero();
  for (std::size_t c = 0; c < lengths_.size(); ++c) {
    const auto weight = weights_.col(static_cast<Eigen::Index>(c));
    sum.head<2>() -= weight.head<2>() * remembered_pole(x, lengths_[c]) / (2 * M_PI);
    if (x < 0) sum(layer_slope::cross) -= weight(2) * std::exp(x / lengths_[c]) / lengths_[c];
  }
  return sum;
}

LayerSlopes DeepResponse::slope(double x) const {
  if (lengths_.empty()) return LayerSlopes::Zero();
  const double distance = std::abs(x), logarithm = std::log(distance);
  if (distance < series_reach * shortest_length_) {
    const Eigen::Array3d growing_part = growing(x);
    Eigen::Array2d sum = Eigen::Array2d::Zero();
    for (Eigen::Index k = rests_.cols() - 1; k >= 0; --k) sum = rests_.col(k) + x * sum;
    sum = (logarithm * growing_part.head<2>() - sum) / (2 * M_PI);
    return {sum(0), sum(1), x < 0 ? -growing_part(2) : 0, 0};
  }
  if (!(logarithm > shortest_ && logarithm < longest_)) return summed(x);
  const Eigen::Array<double, 5, 1> values = (*table_)(logarithm) / distance;
  return x > 0 ? LayerSlopes(values(0), values(1), 0, 0) : LayerSlopes(values(2), values(3), values(4), 0);
}

Eigen::Array3d DeepResponse::growing(double x) const {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  if (std::abs(x) < series_reach * shortest_length_) {
    for (Eigen::Index k = moments_.cols() - 1; k >= 0; --k) sum = moments_.col(k) + x * sum;
    return sum;
  }
  for (std::size_t c = 0; c < lengths_.size(); ++c)
    sum += weights_.col(static_cast<Eigen::Index>(c)) * std::exp(std::min(x / lengths_[c], 30.0)) / lengths_[c];
  return sum;
}

Eigen::Index DeepResponse::powers_at(double farthest) const {
  const double part = farthest / shortest_length_;
  if (!(part < series_reach)) return 0;
  constexpr double rounding = 1e-17;
  Eigen::Index powers = 1;
  for (double term = 1; powers < moments_.cols() && term > rounding; ++powers)
    term *= part / static_cast<double>(powers);
  return powers;
}

namespace {

/// Places that a processor's registers hold with all sums over them.
using Chunk = Eigen::Array<double, 8, 1>;

/// Calls `each(chunk, first, count)` for all places, of which the last chunk may hold fewer.
template <class Each>
void in_chunks(const Eigen::ArrayXd& x, const Each& each) {
  for (Eigen::Index first = 0; first < x.size(); first += Chunk::SizeAtCompileTime) {
    const Eigen::Index count = std::min<Eigen::Index>(Chunk::SizeAtCompileTime, x.size() - first);
    Chunk chunk = Chunk::Constant(x(first));
    chunk.head(count) = x.segment(first, count);
    each(chunk, first, count);
  }
}

/// Sums of factors(row, k) x^k.
template <class Factors>
Chunk power_sum(const Factors& factors, Eigen::Index row, Eigen::Index powers, const Chunk& x) {
  Chunk sum = Chunk::Zero();
  for (Eigen::Index k = powers - 1; k >= 0; --k) sum = factors(row, k) + x * sum;
  return sum;
}

}  // namespace

Eigen::ArrayX3d DeepResponse::growing(const Eigen::ArrayXd& x) const {
  Eigen::ArrayX3d sum = Eigen::ArrayX3d::Zero(x.size(), 3);
  const Eigen::Index powers = x.size() > 0 ? powers_at(x.abs().maxCoeff()) : 0;
  if (powers == 0) {
    for (Eigen::Index i = 0; i < x.size(); ++i) sum.row(i) = growing(x(i)).transpose();
    return sum;
  }
  in_chunks(x, [&](const Chunk& chunk, Eigen::Index first, Eigen::Index count) {
    for (Eigen::Index c = 0; c < 3; ++c)
      sum.col(c).segment(first, count) = power_sum(moments_, c, powers, chunk).head(count);
  });
  return sum;
}

Eigen::ArrayX3d DeepResponse::slopes(const Eigen::ArrayXd& x) const {
  Eigen::ArrayX3d sum = Eigen::ArrayX3d::Zero(x.size(), 3);
  if (lengths_.empty() || x.size() == 0) return sum;
  const Eigen::Index powers = powers_at(x.abs().maxCoeff());
  if (powers == 0) {
    for (Eigen::Index i = 0; i < x.size(); ++i) sum.row(i) = slope(x(i)).head<3>().transpose();
    return sum;
  }
  in_chunks(x, [&](const Chunk& chunk, Eigen::Index first, Eigen::Index count) {
    const Chunk logarithm = chunk.abs().log();
    for (Eigen::Index c = 0; c < 2; ++c) {
      const Chunk slope = logarithm * power_sum(moments_, c, powers, chunk) - power_sum(rests_, c, powers, chunk);
      sum.col(c).segment(first, count) = slope.head(count) / (2 * M_PI);
    }
    const Chunk wake = (chunk < 0).select(-power_sum(moments_, 2, powers, chunk), 0);
    sum.col(2).segment(first, count) = wake.head(count);
  });
  return sum;
}

LayerSlopes DeepResponse::mean(double memory_length, double x) const {
  const double pole = remembered_pole(x, memory_length);
  const double wake = x < 0 ? std::exp(x / memory_length) / memory_length : 0;
  Eigen::Array3d sum = at_once_ * Eigen::Array3d(pole, pole, wake);
  for (std::size_t c = 0; c < lengths_.size(); ++c) {
    const double length = lengths_[c], apart = memory_length - length;
    const auto both = [&](double one, double other) { return (memory_length * one - length * other) / apart; };
    const double poles = both(pole, remembered_pole(x, length));
    const double wakes = x < 0 ? both(wake, std::exp(x / length) / length) : 0;
    sum += weights_.col(static_cast<Eigen::Index>(c)) * Eigen::Array3d(poles, poles, wakes);
  }
  return {-sum(0) / (2 * M_PI), -sum(1) / (2 * M_PI), -sum(2), 0};
}

LayerSlopes DeepResponse::displacement(double x) const {
  Eigen::Array3d sum = at_rest() * std::log(x);
  for (std::size_t c = 0; c < lengths_.size(); ++c)
    sum += weights_.col(static_cast<Eigen::Index>(c)) * lengths_[c] * remembered_pole(x, lengths_[c]);
  return {-sum(0) / (2 * M_PI), -sum(1) / (2 * M_PI), -0.5 * at_rest()(2), 0};
}

}  // namespace rollres
