#include "core/influence/sphere_passage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/influence/directional_half_space.hpp"
#include "core/influence/passage_quadrature.hpp"
#include "core/messages/message_text.hpp"
#include "core/numerics/chebyshev.hpp"
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

/// Functions of the distance over the length, all from the same Chebyshev panels.
class RadialFunctions {
 public:
  /// @param samples  a column at each of the panels' nodes, from the last node of a panel to its first
  RadialFunctions(std::vector<double> borders, const Eigen::MatrixXd& samples) : borders_(std::move(borders)) {
    const Index count = panel_degree + 1;
    const Eigen::MatrixXd to_series = chebyshev_fit(count).from_values.transpose();
    for (Index panel = 0; panel + 1 < static_cast<Index>(borders_.size()); ++panel)
      series_.push_back(samples.middleCols(panel * count, count) * to_series);
  }
  Eigen::VectorXd operator()(double r) const {
    const auto after = std::upper_bound(borders_.begin() + 1, borders_.end() - 1, r);
    const double from = *(after - 1), to = *after;
    return series_[static_cast<std::size_t>(after - borders_.begin() - 1)] *
           chebyshev_images(std::clamp(2 * (r - from) / (to - from) - 1, -1.0, 1.0), panel_degree + 1);
  }

 private:
  std::vector<double> borders_;
  std::vector<Eigen::MatrixXd> series_;  // of each panel: a row for each function
};

/// r K's symbols' harmonics of one term after the other, at the panels' nodes as RadialFunctions asks for them.
Eigen::MatrixXd sampled(const DirectionalExpansion& directions, double length, const std::vector<double>& borders) {
  const Index of_term = 6 * directions.harmonics();
  Eigen::MatrixXd samples(of_term * directions.terms(), static_cast<Index>(borders.size() - 1) * (panel_degree + 1));
  Index next = 0;
  for (std::size_t panel = 0; panel + 1 < borders.size(); ++panel) {
    const double from = borders[panel], to = borders[panel + 1];
    const HankelTransform transform(directions, length, from, to);
    for (const double t : chebyshev_fit(panel_degree + 1).nodes) {
      const std::vector<Harmonics> at = transform(from + 0.5 * (to - from) * (1 + t));
      for (std::size_t m = 0; m < at.size(); ++m)
        samples.col(next).segment(static_cast<Index>(m) * of_term, of_term) = at[m].reshaped();
      ++next;
    }
  }
  return samples;
}

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

/// The functions of a place by which what is left of the correction falls, at 1/share of the distance of the harmonics:
/// as r^-2, without harmonics of order 0 as r^-3.
Harmonics falling(Harmonics waves, double share) {
  waves *= share * share;
  waves.col(0).head<3>() *= share;
  return waves;
}

}  // namespace

SpherePassage::TermSums::TermSums(const std::vector<Harmonics>& of_terms) {
  for (Index c = 0; c < 6; ++c) {
    of_coefficient_[static_cast<std::size_t>(c)].resize(static_cast<Index>(of_terms.size()), of_terms.front().cols());
    for (std::size_t m = 0; m < of_terms.size(); ++m)
      of_coefficient_[static_cast<std::size_t>(c)].row(static_cast<Index>(m)) = of_terms[m].row(c).matrix();
  }
}

void SpherePassage::TermSums::add_to(Responses& responses, const Places& places) const {
  if (places.at.empty()) return;
  const std::size_t count = places.at.size();
  std::array<Eigen::MatrixXd, 6> sums;  // [place, term]
  for (Index c = 0; c < 6; ++c) {
    Eigen::MatrixXd functions(places.functions.front().cols(), static_cast<Index>(count));
    for (std::size_t i = 0; i < count; ++i)
      functions.col(static_cast<Index>(i)) = places.functions[i].row(c).matrix().transpose();
    const auto of = static_cast<std::size_t>(c);
    sums[of] = functions.transpose() * of_coefficient_[of].transpose();
  }
  for (std::size_t m = 0; m < responses.size(); ++m)
    for (std::size_t i = 0; i < count; ++i) {
      Coefficients& response = responses[m][places.at[i]];
      for (std::size_t c = 0; c < 6; ++c)
        response(static_cast<Index>(c)) += sums[c](static_cast<Index>(i), static_cast<Index>(m));
    }
}

SpherePassage::SpherePassage(const LayeredMedium& medium, double wave_speed) {
  const DirectionalExpansion directions(medium, wave_speed);
  error_ = directions.error();
  harmonics_ = directions.harmonics();
  std::vector<Harmonics> deep, base;
  for (int m = 0; m < directions.terms(); ++m) {
    deep.push_back(response_harmonics(directions.deep(m)));
    base.push_back(response_harmonics(directions.base(m)));
    times_.push_back(directions.time(m));
  }
  for (const auto& [sums, half_spaces] : {std::pair{&deep_, &deep}, {&base_, &base}}) {
    std::array<std::vector<Harmonics>, 2> of_terms;  // near and far
    for (const Harmonics& response : *half_spaces) {
      const DirectionalHalfSpace half_space(response);
      for (const bool far : {false, true}) of_terms[far].push_back(half_space.harmonics(far));
    }
    for (const bool far : {false, true}) (*sums)[far] = TermSums(of_terms[far]);
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
  const double end = borders.back();
  scales_ = {length, end * length, rigid};
  std::vector<double> distances;
  for (const double border : borders) distances.push_back(border * length);
  RadialFunctions within(borders, sampled(directions, length, borders));
  const Index of_term = 6 * harmonics_;
  const Eigen::VectorXd at_end = within(end);
  std::vector<Harmonics> beyond, tails;  // times r; what is left at the end
  for (std::size_t m = 0; m < times_.size(); ++m) {
    beyond.push_back(base[m] - deep[m]);
    tails.push_back(Eigen::Map<const Harmonics>(&at_end(static_cast<Index>(m) * of_term), 6, harmonics_) -
                    beyond[m] / end);
    if (rigid) tails[m].setZero();
  }
  tail_ = TermSums(tails);
  const auto value = [=, harmonics = harmonics_, within = std::move(within)](double x, double y) {
    require_time();
    const double r = std::sqrt(x * x + y * y) / length;
    const Harmonics waves = direction_waves(x, y, harmonics);
    Eigen::VectorXd values(6 * static_cast<Index>(tails.size()));
    if (r < end) {
      const Eigen::VectorXd at = within(r);
      for (Index m = 0; 6 * m < values.size(); ++m)
        values.segment<6>(6 * m) = harmonic_sum(Eigen::Map<const Harmonics>(&at(m * of_term), 6, harmonics), waves);
    } else {
      for (std::size_t m = 0; m < tails.size(); ++m)
        values.segment<6>(6 * static_cast<Index>(m)) =
            harmonic_sum(beyond[m], waves) / r + harmonic_sum(tails[m], falling(waves, end / r));
    }
    return Eigen::VectorXd(values / length);
  };
  correction_ = std::make_unique<const PiecewiseField>(distances, panel_degree, value);
}

/// To a cell, at places (x, y) along a row.
SpherePassage::Responses SpherePassage::responses(const std::vector<double>& along, double y, double cell_x,
                                                  double cell_y) const {
  Responses responses(times_.size(), std::vector<Coefficients>(along.size(), Coefficients::Zero()));
  const double below = y - 0.5 * cell_y, above = y + 0.5 * cell_y;
  double end = 0;  // along x, of what the table of the correction serves [m]
  PiecewiseField::Strip strip;
  if (correction_ && above <= correction_->end()) {
    end = correction_->end();
    strip = correction_->strip(below, above);
  }
  std::array<Places, 2> deep, base;  // near and far
  Places tail;
  for (std::size_t i = 0; i < along.size(); ++i) {
    require_time();
    const double x = along[i], distance = std::sqrt(x * x + y * y), left = x - 0.5 * cell_x, right = x + 0.5 * cell_x;
    if (distance > scales_.reach()) continue;
    CellFunctions cell(x, y, cell_x, cell_y, harmonics_);
    const bool served = right <= end;
    (!correction_ || served ? deep : base)[cell.far].add(i, std::move(cell.values));
    if (served) {
      const Eigen::ArrayXd corrections = strip(left, right).array() / (cell_x * cell_y);
      for (std::size_t m = 0; m < times_.size(); ++m)
        responses[m][i] = corrections.segment<6>(6 * static_cast<Index>(m));
    } else if (correction_) {
      const double length = scales_.length;
      tail.add(i, falling(direction_waves(x, y, harmonics_), scales_.extent / distance) / length);
    }
  }
  for (const bool far : {false, true}) {
    deep_[far].add_to(responses, deep[far]);
    base_[far].add_to(responses, base[far]);
  }
  tail_.add_to(responses, tail);
  return responses;
}

InfluenceTable SpherePassage::table(double speed, double cell_x, double cell_y, int reach_x, int reach_y) const {
  const PassageQuadrature rules(scales_, cell_x, reach_x);
  std::vector<PassageQuadrature::Weights> weights;
  for (const double time : times_)
    weights.push_back(time > 0 ? rules.weights(speed * time) : PassageQuadrature::Weights());
  InfluenceTable table(reach_x, reach_y);
  for (int row = 0; row <= reach_y; ++row) {
    Responses values = responses(rules.distances(row), row * cell_y, cell_x, cell_y);
    for (std::size_t m = 0; m < times_.size(); ++m) {
      require_time();
      PassageQuadrature::under_load(values[m]);
      if (times_[m] > 0)
        rules.add(table, row, 1, weights[m], values[m]);
      else
        rules.add(table, row, 1, values[m]);
    }
  }
  return table;
}

}  // namespace rollres
