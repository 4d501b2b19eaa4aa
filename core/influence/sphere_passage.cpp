#include "core/influence/sphere_passage.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/influence/passage_quadrature.hpp"
#include "core/messages/message_text.hpp"
#include "core/numerics/quadrature.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

namespace {

using Eigen::Index;
constexpr int panel_degree = 15;

/// Bessel functions J_0 ... J_{count - 1} by Miller's backward recurrence.
std::vector<double> bessel_functions(double z, int count) {
  std::vector<double> values(static_cast<std::size_t>(count), 0.0);
  if (z < 1e-8) {
    values[0] = 1;
    if (count > 1) values[1] = z / 2;
    return values;
  }
  const int beyond = 2 * ((std::max(count, checked_count(std::floor(z), "Bessel functions")) + 20 +
                           static_cast<int>(3 * std::cbrt(z) * 2)) /
                          2);
  double above = 0, here = 1e-300, sum = 0;
  for (int n = beyond; n >= 0; --n) {  // `here` is J_n but for a factor
    if (n < count) values[static_cast<std::size_t>(n)] = here;
    if (n % 2 == 0) sum += (n == 0 ? 1 : 2) * here;
    const double below = 2 * n / z * here - above;
    above = here;
    here = below;
    if (std::abs(here) > 1e200) {
      constexpr double scale = 1e-200;
      here *= scale;
      above *= scale;
      sum *= scale;
      for (double& value : values) value *= scale;
    }
  }
  for (double& value : values) value /= sum;
  return values;
}

std::string layers_response(int terms) {
  return message_text("the layers' response with ", terms, " retardation times under a sphere");
}

/// Transforms of the corrections' harmonics at distances from r0 to r1 over the length (K13).
class HankelTransform {
 public:
  HankelTransform(const DirectionalExpansion& directions, double length, double r0, double r1)
      : harmonics_(directions.harmonics()),
        terms_(directions.terms()),
        rule_(directions.lowest_wavenumber() * length, directions.highest_wavenumber() * length, r0, r1,
              2 * directions.harmonics()) {
    require_memory(48.0 * harmonics_ * terms_ * static_cast<double>(rule_.nodes.size()), layers_response(terms_));
    for (const double k : rule_.nodes) values_.push_back(directions.correction(k / length));
  }

  /// r K's symbols' harmonics, for each term [1/length].
  std::vector<Harmonics> operator()(double r) const {
    require_time();
    Eigen::ArrayXXd sum = Eigen::ArrayXXd::Zero(6 * harmonics_, terms_);
    Eigen::ArrayXd waves(6 * harmonics_);
    for (std::size_t q = 0; q < rule_.nodes.size(); ++q) {
      const std::vector<double> bessel = bessel_functions(rule_.nodes[q] * r, 2 * harmonics_);
      for (int n = 0; n < harmonics_; ++n)
        for (Index c = 0; c < 6; ++c)
          waves(6 * n + c) = rule_.weights[q] * bessel[static_cast<std::size_t>(order_of_harmonic(c, n))];
      sum += values_[q].colwise() * waves;
    }
    std::vector<Harmonics> result;
    for (Index m = 0; m < terms_; ++m)
      result.push_back(response_harmonics(Eigen::Map<const Harmonics>(&sum(0, m), 6, harmonics_)));
    return result;
  }

 private:
  int harmonics_, terms_;
  WavenumberRule rule_;
  std::vector<Eigen::ArrayXXd> values_;
};

/// Harmonics as functions of the distance over the length.
class RadialHarmonics {
 public:
  /// @param next_sample at the nodes of one panel after the other
  template <class Sample>
  RadialHarmonics(const std::vector<double>& borders, int count, const Sample& next_sample) {
    std::vector<Harmonics> all((borders.size() - 1) * (panel_degree + 1));
    for (Harmonics& sample : all) sample = next_sample();
    for (Index n = 0; n < count; ++n) {
      std::size_t next = 0;
      tables_.emplace_back(borders, panel_degree, [&](double) -> Coefficients { return all[next++].col(n); });
    }
  }
  Harmonics operator()(double r) const {
    Harmonics at(6, static_cast<Index>(tables_.size()));
    for (std::size_t n = 0; n < tables_.size(); ++n) at.col(static_cast<Index>(n)) = tables_[n](r);
    return at;
  }

 private:
  std::vector<ChebyshevTable<6>> tables_;
};

/// Distance over the length beyond which every term's surface is at rest (rigid base), or close to that of the base.
double farthest_panel(const DirectionalExpansion& directions, const std::vector<Harmonics>& deep, double length,
                      double finite, bool rigid) {
  constexpr double longest = 300, on_half_space = 60, at_rest = 1e-9;
  if (!rigid) return on_half_space * finite / length;
  double largest = 0;
  for (const Harmonics& of_term : deep) largest = std::max(largest, of_term.abs().maxCoeff());
  double end = 30 * finite / length;
  for (; end < longest * finite / length; end *= 1.3) {
    const std::vector<Harmonics> at = HankelTransform(directions, length, end, end)(end);
    double left = 0;
    for (std::size_t m = 0; m < deep.size(); ++m) left = std::max(left, (at[m] + deep[m] / end).abs().maxCoeff());
    if (left < at_rest * largest) break;
  }
  return end;
}

/// How what is left of the correction falls with the distance: r^-2, without harmonics of order 0 r^-3.
Harmonics tail_at(const Harmonics& tail, double share) {
  Harmonics falling = tail * (share * share);
  falling.col(0).head<3>() *= share;
  return falling;
}

}  // namespace

SpherePassage::SpherePassage(const LayeredMedium& medium, double wave_speed) {
  const DirectionalExpansion directions(medium, wave_speed);
  error_ = directions.error();
  harmonics_ = directions.harmonics();
  std::vector<Harmonics> deep, base;
  for (int m = 0; m < directions.terms(); ++m) {
    deep.push_back(response_harmonics(directions.deep(m)));
    base.push_back(response_harmonics(directions.base(m)));
    terms_.push_back({directions.time(m), DirectionalHalfSpace(deep.back()), DirectionalHalfSpace(base.back()), {}});
  }
  const double finite = finite_thickness(medium);
  if (finite == 0) return;

  const bool rigid = std::isfinite(medium.back().thickness);
  const double length = directions.finest_length();
  const std::vector<double> borders = distance_panels(farthest_panel(directions, deep, length, finite, rigid));
  constexpr double copies = 3;
  require_memory(
      copies * 48.0 * harmonics_ * directions.terms() * static_cast<double>(borders.size()) * (panel_degree + 1),
      layers_response(directions.terms()));
  std::vector<std::vector<Harmonics>> samples;  // in the order in which a table asks for them
  for (std::size_t panel = 0; panel + 1 < borders.size(); ++panel) {
    const double from = borders[panel], to = borders[panel + 1];
    const HankelTransform transform(directions, length, from, to);
    for (int node = 0; node <= panel_degree; ++node)
      samples.push_back(transform(from + 0.5 * (to - from) * (1 + std::cos(M_PI * (node + 0.5) / (panel_degree + 1)))));
  }

  const double end = borders.back();
  scales_ = {length, end * length, rigid};
  std::vector<double> distances;
  for (const double border : borders) distances.push_back(border * length);
  struct Correction {
    RadialHarmonics within;
    Harmonics beyond, tail;  // times r; what is left at the end
  };
  std::vector<Correction> corrections;
  for (std::size_t m = 0; m < terms_.size(); ++m) {
    std::size_t next = 0;
    RadialHarmonics within(borders, harmonics_, [&] { return samples[next++][m]; });
    const Harmonics beyond = base[m] - deep[m];
    Harmonics tail = within(end) - beyond / end;
    if (rigid) tail.setZero();
    terms_[m].tail = tail / length;
    corrections.push_back({std::move(within), beyond, tail});
  }
  const auto value = [=, corrections = std::move(corrections)](double x, double y) {
    require_time();
    const double r = std::sqrt(x * x + y * y) / length;
    Eigen::VectorXd values(6 * static_cast<Index>(corrections.size()));
    for (std::size_t m = 0; m < corrections.size(); ++m) {
      const auto& [within, beyond, tail] = corrections[m];
      const Harmonics at = r < end ? within(r) : Harmonics(beyond / r + tail_at(tail, end / r));
      values.segment<6>(6 * static_cast<Index>(m)) = harmonic_sum(at, x, y) / length;
    }
    return values;
  };
  correction_ = std::make_unique<const PiecewiseField>(distances, panel_degree, value);
}

/// The responses of all terms to a cell along a row.
class SpherePassage::RowResponse {
 public:
  RowResponse(const SpherePassage& surface, double y, double cell_x, double cell_y)
      : surface_(surface), y_(y), cell_x_(cell_x), cell_y_(cell_y), end_(0) {
    const double below = y - 0.5 * cell_y, above = y + 0.5 * cell_y;
    if (!surface.correction_ || above > surface.correction_->end()) return;
    end_ = surface.correction_->end();
    strip_ = surface.correction_->strip(below, above);
  }

  /// At x, for one term after the other.
  template <class Take>
  void operator()(double x, const Take& take) const {
    const double distance = std::sqrt(x * x + y_ * y_), left = x - 0.5 * cell_x_, right = x + 0.5 * cell_x_;
    const std::size_t count = surface_.terms_.size();
    if (distance > surface_.scales_.reach()) {
      for (std::size_t m = 0; m < count; ++m) take(m, Coefficients::Zero());
      return;
    }
    const CellFunctions cell(x, y_, cell_x_, cell_y_, surface_.harmonics_);
    if (!surface_.correction_) {
      for (std::size_t m = 0; m < count; ++m) take(m, surface_.terms_[m].deep(cell));
    } else if (right <= end_) {
      const Eigen::ArrayXd corrections = strip_(left, right).array() / (cell_x_ * cell_y_);
      for (std::size_t m = 0; m < count; ++m)
        take(m, surface_.terms_[m].deep(cell) + corrections.segment<6>(6 * static_cast<Index>(m)));
    } else {
      const double share = surface_.scales_.extent / distance;
      for (std::size_t m = 0; m < count; ++m)
        take(m, surface_.terms_[m].base(cell) + harmonic_sum(tail_at(surface_.terms_[m].tail, share), x, y_));
    }
  }

 private:
  const SpherePassage& surface_;
  double y_, cell_x_, cell_y_, end_;  // distance along x up to which the strip goes [m]
  PiecewiseField::Strip strip_;
};

InfluenceTable SpherePassage::table(double speed, double cell_x, double cell_y, int reach_x, int reach_y) const {
  const PassageQuadrature rules(scales_, cell_x, reach_x);
  std::vector<PassageQuadrature::Weights> weights;
  for (const Term& term : terms_)
    weights.push_back(term.time > 0 ? rules.weights(speed * term.time) : PassageQuadrature::Weights());
  InfluenceTable table(reach_x, reach_y);
  std::vector<std::vector<Coefficients>> values(terms_.size());
  for (int row = 0; row <= reach_y; ++row) {
    const RowResponse response(*this, row * cell_y, cell_x, cell_y);
    for (auto& of_term : values) of_term.clear();
    for (const double x : rules.distances(row)) {
      require_time();
      response(x, [&](std::size_t m, const Coefficients& value) { values[m].push_back(value); });
    }
    for (std::size_t m = 0; m < terms_.size(); ++m) {
      require_time();
      PassageQuadrature::under_load(values[m]);
      if (terms_[m].time > 0)
        rules.add(table, row, 1, weights[m], values[m]);
      else
        rules.add(table, row, 1, values[m]);
    }
  }
  return table;
}

}  // namespace rollres
