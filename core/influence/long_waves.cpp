#include "core/influence/long_waves.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/surface/layer_compliance.hpp"

namespace rollres {

namespace {

using complex = std::complex<double>;

constexpr double long_wave = 0.1;  // times a cell, in radians

/// What the steps between cells add to the displacement of nodes under a wave [m/Pa].
/// @param compliance of wavenumbers   @param k of the wave, far below 1/cell [1/m]
template <class Compliance>
complex of_steps(const Compliance& compliance, double k, double cell) {
  // A sum of changing signs, whose terms may grow where the layer is far thinner than a cell: fading, it ends anywhere.
  constexpr int last = 32;
  const double apart = 2 * M_PI / cell;
  complex sum = 0;
  for (int m = last - 1; m >= 1; --m) {
    const double part = 1.0 * m / last, fade = std::pow(1 - part * part, 4);
    for (const double wave : {k + m * apart, k - m * apart})
      sum += fade * average_over_cell(wave, cell) * compliance(wave);
  }
  return sum;
}

/// 0 where steps make less than a thousandth of a long wave, 1 from a hundredth on, smooth between them.
double weight(double share) {
  constexpr double least = 1e-3, whole = 1e-2;
  if (!(share > least)) return 0;
  const double t = std::clamp(std::log(share / least) / std::log(whole / least), 0.0, 1.0);
  return t * t * t * (10 + t * (6 * t - 15));
}

/// 1 of cells that are about as long across the motion as along it, 0 of those longer than three times that: neighbours
/// that far are changed for all waves along the motion, which may be short.
double for_squares(double ratio) {
  constexpr double square = 1.5, longest = 3;
  const double t = std::clamp((longest - ratio) / (longest - square), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// What to add at neighbours along a direction.
struct Neighbours {
  double even = 0, odd = 0;  ///< [m/Pa]
  double mended = 0;         ///< as LongWaveCorrection has them
  complex whole;
};

template <class Compliance>
Neighbours neighbours(const Compliance& compliance, double cell) {
  const double wave = long_wave / cell, limit = 1e-3 / cell;
  const complex of_wave = of_steps(compliance, wave, cell), whole = compliance(wave);
  const double part = weight(std::abs(of_wave) / std::abs(whole));
  if (part == 0) return {0, 0, 0, whole};
  const complex steps = of_steps(compliance, limit, cell);
  const double ratio = limit * cell;
  // e (1 - 2 + 1) at the neighbours takes e k^2 cell^2 from a wave, o (1 - 1) adds 2 i o k cell.
  return {part * steps.real() / (ratio * ratio), part * steps.imag() / (2 * ratio), part * of_wave.real(), whole};
}

}  // namespace

LongWaveCorrection::LongWaveCorrection(const SteadySurface& surface, const SurfaceGrid& grid, bool backwards) {
  const double area = grid.cell_area();
  const auto along = [&](double k) { return surface(surface.moduli(k), k, 0).normal; };
  const Neighbours in_motion = neighbours(along, grid.spacing_x);
  const double odd = backwards ? -in_motion.odd : in_motion.odd;
  ahead_ = (in_motion.even + odd) / area;
  behind_ = (in_motion.even - odd) / area;
  mended_ = in_motion.mended;
  whole_ = in_motion.whole;
  if (grid.rows <= 1) return;
  // They go on along the motion as the contact does.
  const SteadySurface::Moduli moduli = surface.moduli(long_wave / grid.spacing_x);
  const auto across = [&](double k) { return surface(moduli, 0, std::abs(k)).normal; };
  aside_ = for_squares(grid.spacing_y / grid.spacing_x) * neighbours(across, grid.spacing_y).even / area;
}

void LongWaveCorrection::add_to(InfluenceTable& table) const {
  const auto add = [&](int column, int row, double value) {
    table.ww[static_cast<std::size_t>(table.index(column, row))] += value;
  };
  add(1, 0, ahead_);
  add(-1, 0, behind_);
  add(0, 0, -ahead_ - behind_ - 2 * aside_);
  if (table.reach_y() > 0) add(0, 1, aside_);
}

}  // namespace rollres
