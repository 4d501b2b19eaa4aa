#include "core/moving_shape.hpp"

#include <algorithm>
#include <cmath>

#include "core/wavenumber_rule.hpp"

namespace rollres {

namespace {

using Eigen::Index;
constexpr int table_degree = 15;
constexpr double panel_growth = 1.6;

/// Distances over the length where panels end, as for an elastic layer: corrections are singular at +-2i and more.
std::vector<double> panel_borders(double end) {
  std::vector<double> borders{0, 1.5, 3.5, 6.5, 11};
  while (borders.back() < end) borders.push_back(borders.back() * panel_growth);
  return borders;
}

/// Bessel functions J_0 ... J_{count - 1} by Miller's backward recurrence.
std::vector<double> bessel_functions(double z, int count) {
  std::vector<double> values(static_cast<std::size_t>(count), 0.0);
  if (z < 1e-8) {
    values[0] = 1;
    if (count > 1) values[1] = z / 2;
    return values;
  }
  const int beyond = 2 * ((std::max(count, static_cast<int>(z)) + 20 + static_cast<int>(3 * std::cbrt(z) * 2)) / 2);
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

/// Transforms of the corrections' harmonics at distances from r0 to r1 over the length.
class HankelTransform {
 public:
  HankelTransform(const WaveDirections& directions, double length, double r0, double r1)
      : harmonics_(directions.harmonics()),
        terms_(directions.terms()),
        rule_(directions.lowest_wavenumber() * length, directions.highest_wavenumber() * length, r0, r1,
              2 * directions.harmonics()) {
    for (const double k : rule_.nodes) values_.push_back(directions.correction(k / length));
  }

  /// r K's symbols' harmonics, for each term [1/length].
  std::vector<Harmonics> operator()(double r) const {
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
    std::vector<Harmonics> all((borders.size() - 1) * (table_degree + 1));
    for (Harmonics& sample : all) sample = next_sample();
    for (Index n = 0; n < count; ++n) {
      std::size_t next = 0;
      tables_.emplace_back(borders, table_degree, [&](double) -> Coefficients { return all[next++].col(n); });
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
double table_end(const WaveDirections& directions, const std::vector<Harmonics>& deep, double length, double finite,
                 bool rigid) {
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

std::vector<MovingShape> moving_shapes(const LayeredMedium& medium, const WaveDirections& directions) {
  const double finite = finite_thickness(medium);
  const bool rigid = std::isfinite(medium.back().thickness);
  std::vector<MovingShape> shapes;
  std::vector<Harmonics> deep, base;
  for (int m = 0; m < directions.terms(); ++m) {
    deep.push_back(response_harmonics(directions.deep(m)));
    base.push_back(response_harmonics(directions.base(m)));
    shapes.push_back({directions.time(m), {}, CornerFunction(deep.back()), CornerFunction(base.back()), nullptr, {}});
  }
  if (finite == 0) return shapes;

  const double length = 18 / directions.highest_wavenumber();
  const std::vector<double> borders = panel_borders(table_end(directions, deep, length, finite, rigid));
  std::vector<std::vector<Harmonics>> samples;  // in the order in which a table asks for them
  for (std::size_t panel = 0; panel + 1 < borders.size(); ++panel) {
    const double from = borders[panel], to = borders[panel + 1];
    const HankelTransform transform(directions, length, from, to);
    for (int node = 0; node <= table_degree; ++node)
      samples.push_back(transform(from + 0.5 * (to - from) * (1 + std::cos(M_PI * (node + 0.5) / (table_degree + 1)))));
  }

  std::vector<double> distances;
  for (const double border : borders) distances.push_back(border * length);
  const double end = borders.back();
  for (std::size_t m = 0; m < shapes.size(); ++m) {
    std::size_t next = 0;
    const RadialHarmonics radial(borders, directions.harmonics(), [&] { return samples[next++][m]; });
    const Harmonics beyond = base[m] - deep[m];
    Harmonics tail = radial(end) - beyond / end;
    if (rigid) tail.setZero();
    const auto correction = [=](double x, double y) -> Coefficients {
      const double r = std::sqrt(x * x + y * y) / length;
      return harmonic_sum(r < end ? radial(r) : Harmonics(beyond / r + tail_at(tail, end / r)), x, y) / length;
    };
    MovingShape& shape = shapes[m];
    shape.scales = {length, end * length, rigid};
    shape.tail = tail / length;
    shape.correction = std::make_shared<const PanelField>(distances, table_degree, correction);
  }
  return shapes;
}

ElasticResponse MovingShape::response(double cell_x, double cell_y) const {
  return [=, this](double y) -> ResponseAlong {
    const double below = y - 0.5 * cell_y, above = y + 0.5 * cell_y;
    const bool in_table = correction && above <= correction->end();
    const auto strip = in_table ? correction->strip(below, above) : PanelField::Strip();
    return [=, this](double x) -> Coefficients {
      const double distance = std::sqrt(x * x + y * y), left = x - 0.5 * cell_x, right = x + 0.5 * cell_x;
      if (distance > scales.reach()) return Coefficients::Zero();
      if (!correction) return deep.average(x, y, cell_x, cell_y);
      if (in_table && right <= correction->end())
        return deep.average(x, y, cell_x, cell_y) + strip(left, right) / (cell_x * cell_y);
      return base.average(x, y, cell_x, cell_y) + harmonic_sum(tail_at(tail, scales.extent / distance), x, y);
    };
  };
}

}  // namespace rollres
