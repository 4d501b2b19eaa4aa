#include "core/surface/deep_response.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "core/numerics/memory_functions.hpp"
#include "core/surface/deep_medium.hpp"
#include "core/surface/layered_medium.hpp"

namespace rollres {

namespace {

using complex = std::complex<double>;

/// Of the shortest of the memories, up to where powers of the distance stand for exponentials.
constexpr double series_reach = 0.3;

}  // namespace

DeepResponse::DeepResponse(const MediumLayer& top, double speed, double instantaneous,
                           const std::vector<double>& creep_length, const std::vector<double>& creep_compliance,
                           double length) {
  at_once_ << 1, 1, -0.25 * (1 - 2 * top.poisson_ratio) / (1 - top.poisson_ratio);
  if (top.density == 0) return;
  const double share = 2 * (1 - top.poisson_ratio);
  std::vector<double> compliances = creep_compliance;
  for (double& compliance : compliances) compliance /= share;
  const RetardedSum ratios = half_space_ratios(top, speed, instantaneous / share, creep_length, compliances);
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
