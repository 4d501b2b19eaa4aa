#include "core/surface/ring_curvature.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/material/prony_series.hpp"
#include "core/numerics/memory_functions.hpp"

namespace rollres {

namespace {

using complex = std::complex<double>;

constexpr std::size_t count = 4;  // of squares
constexpr double euler = 0.57721566490153286;
/// Of the powers of x/R, up to x = R: 2^27/27! is 1e-20.
constexpr std::size_t series_terms = 14;
constexpr double nearest_tabled = 1e-5;  // of the radius
/// Of the finest distance, below which a memory counts as at once in its logarithms.
constexpr double short_share = 0.7;

/// R_T of 1/x for lengths of either sign: a negative one is of a memory that lies ahead.
double mean_of_pole(double x, double length) {
  return length > 0 ? remembered_pole(x, length) : -remembered_pole(-x, -length);
}

/// ln|x| + T R_T of 1/x, whose slope that is.
double remembered_logarithm(double x, double length) {
  if (x == 0) return std::log(std::abs(length)) - euler;
  return std::log(std::abs(x)) + length * mean_of_pole(x, length);
}

/// R_T of a unit force at 0, and half of it there.
double remembered_force(double x, double length) {
  if (x == 0) return 0.5 / std::abs(length);
  return x / length < 0 ? std::exp(x / length) / std::abs(length) : 0;
}

/// Its antiderivative, 0 far ahead.
double remembered_step(double x, double length) {
  const double fading = x / length < 0 ? std::exp(x / length) : 1;
  return length > 0 ? (x < 0 ? fading - 1 : 0) : (x > 0 ? -fading : -1);
}

/// Squares 1 to 4 times a number by which no length is a memory's.
std::vector<double> squares_apart(const CreepSpectrum& creep, double radius, double speed) {
  std::vector<double> squares(count);
  for (double factor = 1;; factor *= 1.01) {
    for (std::size_t j = 0; j < count; ++j) squares[j] = factor * static_cast<double>(j + 1);
    const bool apart = std::all_of(squares.begin(), squares.end(), [&](double s) {
      return std::all_of(creep.terms.begin(), creep.terms.end(), [&](const CreepSpectrum::Term& term) {
        return std::abs(std::abs(speed) * term.time * std::sqrt(s) / radius - 1) > 1e-3;
      });
    });
    if (apart || factor > 2) return squares;
  }
}

/// What makes sum of w_j f(s_j) = f(-1) for polynomials.
std::vector<double> weights_for(const std::vector<double>& squares) {
  std::vector<double> weights(squares.size(), 1);
  for (std::size_t j = 0; j < squares.size(); ++j)
    for (std::size_t i = 0; i < squares.size(); ++i)
      if (i != j) weights[j] *= (-1 - squares[i]) / (squares[j] - squares[i]);
  return weights;
}

}  // namespace

void LogarithmicSlope::add(double weight, double length) {
  if (constexpr double shortest = 0.4; std::abs(length) < shortest * radius_) {
    memories_.push_back({weight, length});
    return;
  }
  for (std::size_t k = 0; k < powers_; ++k) {
    series_[k] += weight;
    weight *= radius_ / (length * static_cast<double>(k + 1));
  }
}

double LogarithmicSlope::operator()(double x) const {
  constexpr double faded = 0.25;
  // Terms fall as those of e^{2.5 x/R}, or faster: these suffice for 1e-15.
  const double ratio = x / radius_;
  double sum = 0;
  for (std::size_t k = std::abs(ratio) < 0.01 ? 7 : std::abs(ratio) < 0.1 ? 11 : powers_; k-- > 0;)
    sum = series_[k] + sum * ratio;
  for (const Memory& memory : memories_) {
    const double z = x / memory.length, square = faded * z * faded * z, fourth = square * square;
    sum += memory.weight * std::exp(z - fourth * fourth);
  }
  return sum;
}

RingCurvature::RingCurvature(const MediumLayer& ring, double speed, Of of, bool coating)
    : ring_(ring),
      speed_(speed),
      of_(of),
      coating_(coating),
      squares_(squares_apart(ring.material, ring.radius, speed)),
      weights_(weights_for(squares_)) {
  const double nu = ring.poisson_ratio;
  even_ = 1 - nu;
  odd_ = -0.5 * (1 - 2 * nu);
  if (of_ == Of::shear) {
    std::swap(even_, odd_);
    if (coating_) even_ = -even_, odd_ = -odd_;
  }
  for (const double square : squares_)
    for (const double side : {1.0, -1.0}) parts_.push_back({side * ring.radius / std::sqrt(square), 0, 0});
  const auto add = [&](double compliance, double memory) {
    Part own{memory, 0, 0};
    // a/(1 - ikT) and -ib/(1 - ikT) are a pole and a jump in i e^{ikx}, a jump and a pole in -e^{ikx}.
    const auto put = [&](Part& part, double a, double b) {
      part.pole += of_ == Of::pressure ? a : b;
      part.jump += of_ == Of::pressure ? b : -a;
    };
    for (std::size_t j = 0; j < squares_.size(); ++j) {
      // even/(n^2 + s) + odd n/(n^2 + s) by 1/(1 - ik tau) and 1/(1 + ik tau), each times 1/(1 - ik memory)
      const double root = std::sqrt(squares_[j]), tau = ring.radius / root;
      const double a = compliance * even_ * weights_[j] / (2 * squares_[j]);
      const double b = compliance * odd_ * weights_[j] / (2 * root);
      const double ahead = memory - tau, behind = memory + tau;
      put(parts_[2 * j], -a * tau / ahead, -b * tau / ahead);
      put(parts_[2 * j + 1], a * tau / behind, -b * tau / behind);
      put(own, a * (memory / ahead + memory / behind), b * (memory / ahead - memory / behind));
    }
    if (memory != 0) parts_.push_back(own);
  };
  if (ring.material.instantaneous != 0) add(ring.material.instantaneous, 0);
  for (const CreepSpectrum::Term& term : ring.material.terms) add(term.compliance, speed * term.time);
  for (const Part& part : parts_) {
    step_ += part.jump;
    if (of_ == Of::pressure) at_rest_ += part.pole;
  }
  if (of_ == Of::pressure && ring.material.terms.empty()) make_series();
}

void RingCurvature::make_series() {
  // Of e^{-z} Ei(z) + e^z E_1(z) = 2 sum over odd k of (harmonic number - euler - ln z) z^k/k!, z = sqrt(s) x/R.
  logarithms_.assign(series_terms, 0);
  rests_.assign(series_terms, 0);
  for (std::size_t j = 0; j < squares_.size(); ++j) {
    const double root = std::sqrt(squares_[j]), logarithm = euler + std::log(root);
    double term = (1 - ring_.poisson_ratio) * weights_[j] / (M_PI * ring_.radius);
    double harmonic = 1;
    for (std::size_t i = 0; i < series_terms; ++i) {
      logarithms_[i] += term;
      rests_[i] += term * (logarithm - harmonic);
      const double k = 2 * static_cast<double>(i) + 2;
      term *= squares_[j] / (k * (k + 1));
      harmonic += 1 / k + 1 / (k + 1);
    }
  }
}

/// Where slopes are tabled, and what parts of a length are there: curvatures seen through many memories have most of
/// them in common.
class RingCurvature::TabledParts {
 public:
  explicit TabledParts(double radius) {
    borders.push_back(0);
    while (borders.back() > std::log(nearest_tabled)) borders.push_back(borders.back() - width_);
    std::reverse(borders.begin(), borders.end());
    for (const double side : {1.0, -1.0})
      Side(borders, degree, [&](double logarithm) {
        places_.push_back(side * radius * std::exp(logarithm));
        return Side::Values::Zero();
      });
  }

  /// The sum at all places, those ahead first.
  Eigen::ArrayXd sum(const std::vector<Part>& parts) {
    Eigen::ArrayXd values = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(places_.size()));
    for (const Part& part : parts) {
      values -= part.pole / M_PI * at_places(poles_, part.length, mean_of_pole);
      if (part.jump != 0) values += part.jump * at_places(forces_, part.length, remembered_force);
    }
    return values;
  }

  // Slopes are singular at pi i of the logarithm: a term of their series is 1/12.6 of the one before.
  static constexpr int degree = 13;
  std::vector<double> borders;  // of panels in ln|x/R|

 private:
  using Known = std::map<double, Eigen::ArrayXd>;

  const Eigen::ArrayXd& at_places(Known& known, double length, double (*function)(double, double)) {
    const auto [found, made] = known.try_emplace(length);
    if (!made) return found->second;
    const Eigen::Map<const Eigen::ArrayXd> x(places_.data(), static_cast<Eigen::Index>(places_.size()));
    return found->second = x.unaryExpr([&](double place) { return function(place, length); });
  }

  static constexpr double width_ = 1;
  std::vector<double> places_;
  Known poles_, forces_;
};

RingCurvature RingCurvature::over(const CreepSpectrum& deep) const {
  if (none()) return {};
  const CreepSpectrum& own = ring_.material;
  MediumLayer quotient = ring_;
  const RelaxationSpectrum relaxation = relaxation_spectrum(deep);
  quotient.material = {.instantaneous = own.instantaneous * relaxation.instantaneous, .terms = {}};
  for (const RelaxationSpectrum::Term& term : relaxation.terms) {
    double at_pole = own.instantaneous;  // of the ring's creep
    for (const CreepSpectrum::Term& memory : own.terms) at_pole += memory.compliance / (1 - memory.time / term.time);
    const double residue = -term.modulus * at_pole;
    if (constexpr double nothing = 1e-9; std::abs(residue) > nothing * quotient.material.instantaneous)
      quotient.material.terms.push_back({residue, term.time});
  }
  RingCurvature over(quotient, speed_, of_, coating_);
  TabledParts tabled(ring_.radius);
  if (!quotient.material.terms.empty() || of_ == Of::shear) over.tabulate(tabled);
  return over;
}

void RingCurvature::tabulate(TabledParts& tabled) {
  const Eigen::ArrayXd values = tabled.sum(parts_);
  Eigen::Index next = 0;
  const auto side = [&] {
    return Side(tabled.borders, TabledParts::degree, [&](double) { return Side::Values::Constant(values(next++)); });
  };
  Side ahead = side();
  sides_ = std::make_shared<const std::array<Side, 2>>(std::array{std::move(ahead), side()});
}

std::vector<RingCurvature> RingCurvature::remembered(const std::vector<double>& lengths) const {
  std::vector<RingCurvature> all;
  if (none()) return all;
  TabledParts tabled(ring_.radius);
  for (const double length : lengths) {
    all.push_back(seen_through(length));
    all.back().tabulate(tabled);
  }
  return all;
}

RingCurvature RingCurvature::seen_through(double length) const {
  // 1/((1 + sT)(1 + s rho)) = [T/(1 + sT) - rho/(1 + s rho)]/(T - rho)
  MediumLayer seen = ring_;
  const double time = length / speed_;
  seen.material = {.instantaneous = 0, .terms = {{ring_.material.instantaneous, time}}};
  for (const CreepSpectrum::Term& term : ring_.material.terms) {
    double apart = time - term.time;
    if (constexpr double equal = 1e-7; std::abs(apart) < equal * time) apart = equal * time;
    seen.material.terms[0].compliance += term.compliance * time / apart;
    seen.material.terms.push_back({-term.compliance * term.time / apart, term.time});
  }
  return {seen, speed_, of_, coating_};
}

complex RingCurvature::operator()(double wavenumber) const {
  if (none()) return 0;
  const double n = wavenumber * ring_.radius;
  double sum = 0;
  for (std::size_t j = 0; j < squares_.size(); ++j) sum += weights_[j] / (n * n + squares_[j]);
  return ring_.material(-wavenumber * speed_) * (even_ + odd_ * n) * sum;
}

double RingCurvature::slope(double x) const {
  const double ratio = x / ring_.radius, square = ratio * ratio;
  if (of_ == Of::pressure && ring_.material.terms.empty() && square <= 1 && ring_.poisson_ratio == 0.5) {
    double logarithms = 0, rests = 0;
    for (std::size_t i = series_terms; i-- > 0;) {
      logarithms = logarithms_[i] + square * logarithms;
      rests = rests_[i] + square * rests;
    }
    return x == 0 ? 0 : ring_.material.instantaneous * ratio * (logarithms * std::log(std::abs(ratio)) + rests);
  }
  if (const double distance = std::abs(ratio); sides_ && distance > nearest_tabled && distance < 1)
    return (*sides_)[x > 0 ? 0 : 1](std::log(distance))(0);
  return sum_of_parts(x);
}

double RingCurvature::sum_of_parts(double x) const {
  double sum = 0;
  for (const Part& part : parts_) {
    const double pole = x == 0 ? (std::log(std::abs(part.length)) - euler) / part.length : mean_of_pole(x, part.length);
    sum -= part.pole / M_PI * pole;
    if (part.jump != 0) sum += part.jump * remembered_force(x, part.length);
  }
  return sum;
}

double RingCurvature::displacement(double x) const {
  double sum = 0.5 * step_;  // transforms are as far below 0 behind as above it ahead
  for (const Part& part : parts_) {
    sum -= part.pole / M_PI * remembered_logarithm(x, part.length);
    if (part.jump != 0) sum += part.jump * remembered_step(x, part.length);
  }
  return sum;
}

LogarithmicSlope RingCurvature::logarithmic_slope(double finest) const {
  if (none()) return {};
  MediumLayer told_apart = ring_;
  told_apart.material = {.instantaneous = ring_.material.instantaneous, .terms = {}};
  for (const CreepSpectrum::Term& term : ring_.material.terms)
    if (std::abs(speed_ * term.time) < short_share * finest)
      told_apart.material.instantaneous += term.compliance;
    else
      told_apart.material.terms.push_back(term);
  LogarithmicSlope slope(ring_.radius);
  for (const Part& part : RingCurvature(told_apart, speed_, of_, coating_).parts_)
    if (part.pole != 0) slope.add(part.pole / (M_PI * part.length), part.length);
  return slope;
}

}  // namespace rollres
