#include "core/interior/surface_tractions.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/numerics/chebyshev.hpp"
#include "core/numerics/quadrature.hpp"
#include "core/numerics/solution_limits.hpp"

namespace rollres {

using complex = std::complex<double>;

namespace {

constexpr int gauss_order = 24;
constexpr complex imaginary{0, 1};
/// Of a panel, below which its parts near a point are not divided further.
constexpr double narrowest_part = 1e-11;

double place_on(double from, double to, double s) {
  return 0.5 * (from + to) + 0.5 * (to - from) * std::sin(M_PI_2 * s);
}

/// The Chebyshev series of pressure and shear from their values at cos(pi j/last), j = 0 ... last; one value is
/// uniform.
std::vector<Eigen::Array2d> series_of(const std::vector<double>& pressure, const std::vector<double>& shear) {
  const std::size_t last = pressure.size() - 1;
  if (last == 0) return {Eigen::Array2d(pressure.front(), shear.front())};
  std::vector<double> cosines;
  for (std::size_t j = 0; j < 2 * last; ++j)
    cosines.push_back(std::cos(M_PI * static_cast<double>(j) / static_cast<double>(last)));
  std::vector<Eigen::Array2d> series;
  for (std::size_t k = 0; k <= last; ++k) {
    Eigen::Array2d sum = Eigen::Array2d::Zero();
    for (std::size_t j = 0; j <= last; ++j)
      sum += (j == 0 || j == last ? 0.5 : 1.0) * cosines[j * k % (2 * last)] * Eigen::Array2d(pressure[j], shear[j]);
    series.emplace_back((k == 0 || k == last ? 1.0 : 2.0) / static_cast<double>(last) * sum);
  }
  return series;
}

}  // namespace

FaceDepth FaceDepth::of(double radius, double depth) {
  if (std::isinf(radius)) return {depth, depth};
  const double inner = radius - depth;
  return {-radius * std::log1p(-depth / radius), radius * depth * (radius + inner) / (2 * inner * inner), 1 / radius};
}

PlaneStress half_space_wave(double wavenumber, const FaceDepth& depth, complex p, complex q) {
  const double kz = wavenumber * depth.factor, decay = std::exp(-wavenumber * depth.decay),
               bend = 2 * depth.factor * depth.curvature;
  return {.x = decay * (-(1 - kz) * p + imaginary * (2 - kz + bend) * q),
          .z = decay * (-(1 + kz) * p + imaginary * (kz - bend) * q),
          .xz = decay * (-imaginary * kz * p + (1 - kz + bend) * q)};
}

double half_length_of(const SurfaceFields& fields) {
  const auto a_length = [](double half) {
    if (!(half > 0 && std::isfinite(half))) throw std::domain_error("the fields hold no contact to look into");
    return half;
  };
  if (!fields.panels.empty()) {
    double from = INFINITY, to = -INFINITY;
    for (const TractionPanel& panel : fields.panels) {
      from = std::min(from, panel.from);
      to = std::max(to, panel.to);
    }
    return a_length(0.5 * (to - from));
  }
  const auto nodes =
      std::count_if(fields.zone.begin(), fields.zone.end(), [](Zone zone) { return zone != Zone::free; });
  return a_length(0.5 * static_cast<double>(nodes) * fields.grid.spacing_x);
}

SurfaceTractions::SurfaceTractions(const SurfaceFields& fields, double highest) {
  for (const TractionPanel& panel : fields.panels)
    panels_.push_back({panel.from, panel.to, series_of(panel.pressure, panel.shear), {}, {}});
  const SurfaceGrid& grid = fields.grid;
  for (int i = 0; fields.panels.empty() && i < grid.columns; ++i)
    if (const auto node = static_cast<std::size_t>(i); fields.zone[node] != Zone::free)
      panels_.push_back({grid.x(i) - 0.5 * grid.spacing_x,
                         grid.x(i) + 0.5 * grid.spacing_x,
                         series_of({fields.pressure[node]}, {fields.shear_x[node]}),
                         {},
                         {}});
  from_ = INFINITY;
  to_ = -INFINITY;
  for (Panel& panel : panels_) {
    from_ = std::min(from_, panel.from);
    to_ = std::max(to_, panel.to);
    if (panel.uniform()) continue;
    for (int parts = 1;; parts *= 2) {
      std::vector<Point>& points = panel.rules.emplace_back();
      for (int i = 0; i < parts; ++i)
        add_points(panel, -1 + 2.0 * i / parts, -1 + 2.0 * (i + 1) / parts, gauss_order, points);
      if (gauss_order * parts > 16 + highest * (panel.to - panel.from)) break;
    }
  }
  for (Panel& panel : panels_)
    if (!panel.rules.empty()) panel.near = panel.rules.front();
  thin_out(highest);
}

void SurfaceTractions::thin_out(double highest) {
  constexpr double negligible = 1e-10;
  double load = 0;
  const auto wave = [](const std::vector<Point>& points, double k) {
    Transforms sum{};
    for (const Point& point : points) {
      const complex turned = std::polar(1.0, -k * point.x);
      sum.pressure += point.pressure * turned;
      sum.shear += point.shear * turned;
    }
    return sum;
  };
  for (const Panel& panel : panels_)
    if (!panel.rules.empty()) load += std::abs(wave(panel.rules.front(), 0).pressure);
  for (Panel& panel : panels_) {
    if (panel.rules.size() != 1) continue;
    for (const int order : {3, 6, 10, 15}) {
      std::vector<Point> fewer;
      add_points(panel, -1, 1, order, fewer);
      double change = 0;
      for (const double k : {0.0, 0.5 * highest, highest}) {
        const Transforms full = wave(panel.rules.front(), k), thin = wave(fewer, k);
        change = std::max({change, std::abs(full.pressure - thin.pressure), std::abs(full.shear - thin.shear)});
      }
      if (change > negligible * load) continue;
      panel.rules.front() = std::move(fewer);
      break;
    }
  }
}

SurfaceTractions::Point SurfaceTractions::point_of(const Panel& panel, double s, double weight) {
  const double scale = weight * 0.5 * (panel.to - panel.from) * M_PI_2 * std::cos(M_PI_2 * s);
  const Eigen::Array2d there = scale * chebyshev_sum<Eigen::Array2d>(panel.series, s);
  return {place_on(panel.from, panel.to, s), there(0), there(1)};
}

void SurfaceTractions::add_points(const Panel& panel, double s0, double s1, int order, std::vector<Point>& points) {
  const QuadratureRule& rule = gauss_rule(order);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    points.push_back(point_of(panel, s0 + (s1 - s0) * rule.nodes[i], (s1 - s0) * rule.weights[i]));
}

SurfaceTractions::Transforms SurfaceTractions::transforms(double k) const {
  require_time();
  Transforms sum{};
  for (const Panel& panel : panels_) {
    const double width = panel.to - panel.from;
    if (panel.uniform()) {
      const double phase = 0.5 * k * width, share = phase == 0 ? 1 : std::sin(phase) / phase;
      const complex wave = width * share * std::polar(1.0, -k * 0.5 * (panel.from + panel.to));
      sum.pressure += panel.series.front()(0) * wave;
      sum.shear += panel.series.front()(1) * wave;
      continue;
    }
    std::size_t level = 0;
    while (level + 1 < panel.rules.size() && std::ldexp(gauss_order, static_cast<int>(level)) < 16 + k * width) ++level;
    for (const Point& point : panel.rules[level]) {
      const complex wave = std::polar(1.0, -k * point.x);
      sum.pressure += point.pressure * wave;
      sum.shear += point.shear * wave;
    }
  }
  return sum;
}

std::vector<std::vector<SurfaceTractions::Transforms>> SurfaceTractions::transforms(const std::vector<double>& firsts,
                                                                                    double step, int count) const {
  // By the finest rules; uniform tractions as a point each, times sin(kw/2)/(kw/2) of their width w.
  std::vector<Point> points;
  std::vector<double> widths;
  for (const Panel& panel : panels_) {
    if (panel.uniform()) {
      const double width = panel.to - panel.from;
      points.push_back(
          {0.5 * (panel.from + panel.to), width * panel.series.front()(0), width * panel.series.front()(1)});
      widths.push_back(width);
    } else {
      points.insert(points.end(), panel.rules.back().begin(), panel.rules.back().end());
      widths.resize(points.size());
    }
  }
  const auto size = static_cast<Eigen::Index>(points.size());
  Eigen::ArrayXd x(size), p(size), q(size);
  const Eigen::ArrayXd half = 0.5 * Eigen::Map<const Eigen::ArrayXd>(widths.data(), size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const Point& point = points[static_cast<std::size_t>(i)];
    x(i) = point.x;
    p(i) = point.pressure;
    q(i) = point.shear;
  }
  const bool uniform = half.maxCoeff() > 0, sheared = (q != 0).any();
  // cos and -sin of kx and of kw/2, which turn by one step from wavenumber to wavenumber.
  struct Turn {
    Eigen::ArrayXd cosine, sine;
    Turn(const Eigen::ArrayXd& at, double k) : cosine((k * at).cos()), sine(-(k * at).sin()) {}
    void turn(const Turn& by) {
      const Eigen::ArrayXd before = cosine;
      cosine = before * by.cosine - sine * by.sine;
      sine = sine * by.cosine + before * by.sine;
    }
  };
  const Eigen::ArrayXd halves = uniform ? half : Eigen::ArrayXd();
  const Turn wave_step(x, step), share_step(halves, step);
  std::vector<std::vector<Transforms>> all;
  for (const double first : firsts) {
    std::vector<Transforms>& sums = all.emplace_back();
    Turn waves(x, first), shares(halves, first);
    for (int j = 0; j < count; ++j) {
      require_time();
      Turn shared = waves;
      if (uniform) {
        const double k = first + step * j;
        const Eigen::ArrayXd share = (half > 0).select(-shares.sine / (k * half), 1.0);
        shared.cosine *= share;
        shared.sine *= share;
        shares.turn(share_step);
      }
      Transforms& sum = sums.emplace_back();
      sum.pressure = {(p * shared.cosine).sum(), (p * shared.sine).sum()};
      if (sheared) sum.shear = {(q * shared.cosine).sum(), (q * shared.sine).sum()};
      waves.turn(wave_step);
    }
  }
  return all;
}

void SurfaceTractions::add_near(const Panel& panel, complex place, double s0, double s1, Potentials& sum) {
  const double a = place_on(panel.from, panel.to, s0), b = place_on(panel.from, panel.to, s1);
  const double beside = std::max({a - place.real(), place.real() - b, 0.0});
  if (std::hypot(beside, place.imag()) < b - a && s1 - s0 > narrowest_part) {
    add_near(panel, place, s0, 0.5 * (s0 + s1), sum);
    add_near(panel, place, 0.5 * (s0 + s1), s1, sum);
    return;
  }
  std::vector<Point> part;
  const std::vector<Point>* points = &part;
  constexpr double far = 3;
  if (s1 - s0 == 2)
    points = std::hypot(beside, place.imag()) > far * (b - a) ? &panel.rules.front() : &panel.near;
  else
    add_points(panel, s0, s1, gauss_order, part);
  for (const Point& point : *points) {
    const complex inverse = 1.0 / (place - point.x);
    sum.p += point.pressure * inverse;
    sum.dp -= point.pressure * inverse * inverse;
    sum.q += point.shear * inverse;
    sum.dq -= point.shear * inverse * inverse;
  }
}

PlaneStress SurfaceTractions::stresses(double x, const FaceDepth& depth) const {
  const double surface = 1e-9 * (to_ - from_);
  const double z = std::max(depth.factor, surface), bend = 2 * z * depth.curvature;
  const complex place(x, std::max(depth.decay, surface));
  Potentials f{};
  for (const Panel& panel : panels_) {
    if (!panel.uniform()) {
      add_near(panel, place, -1, 1, f);
      continue;
    }
    const double p = panel.series.front()(0), q = panel.series.front()(1);
    const complex logarithm = std::log(place - panel.from) - std::log(place - panel.to);
    const complex slope = 1.0 / (place - panel.from) - 1.0 / (place - panel.to);
    f.p += p * logarithm;
    f.dp += p * slope;
    f.q += q * logarithm;
    f.dq += q * slope;
  }
  for (complex* const potential : {&f.p, &f.dp, &f.q, &f.dq}) *potential *= imaginary / M_PI;
  // By F' of z = x + i depth: the derivative by x is Re F', by the depth -Im F'.
  return {.x = -(f.p.real() - z * f.dp.imag()) - (2 + bend) * f.q.imag() - z * f.dq.real(),
          .z = -(f.p.real() + z * f.dp.imag()) + bend * f.q.imag() + z * f.dq.real(),
          .xz = -z * f.dp.real() + (1 + bend) * f.q.real() - z * f.dq.imag()};
}

}  // namespace rollres
