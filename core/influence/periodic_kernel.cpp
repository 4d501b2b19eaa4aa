#include "core/influence/periodic_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/influence/elastic_kernel.hpp"
#include "core/messages/message_text.hpp"
#include "core/numerics/fft.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/surface/layer_compliance.hpp"

namespace rollres {

namespace {

int wrapped(int n, int size) { return ((n % size) + size) % size; }

/// A ring that yields as a whole is strained along its surface on average, by w/R: the term of no wavenumber is one of
/// the strain, of which displacements that return after a period know nothing.
/// @param wavenumber far below that of any memory: in the mean all are at rest   @param area over which the period's
/// means are taken
void add_mean_strain(InfluenceTable& table, const SymbolsAlong& symbols, double wavenumber, double area, double cell) {
  const SurfaceCompliance c = symbols(wavenumber)(0);
  const double strain = -wavenumber * c.cross.real() / area, hoop = -wavenumber * c.hoop.real() / area;
  for (int column = -table.reach_x(); column <= table.reach_x(); ++column) {
    const auto at = static_cast<std::size_t>(table.index(column, 0));
    table.uw[at] += strain * column * cell;
    table.hoop[at] += hoop * column * cell;
  }
}

}  // namespace

InfluenceTable periodic_table(const SymbolsAlong& symbols, double period, int terms, double cell_x, double cell_y,
                              int reach_x, int reach_y, bool ring) {
  using complex = std::complex<double>;
  const bool sphere = reach_y > 0;
  const int columns = std::max(checked_count(period / cell_x, "cells of the period"), 2 * reach_x + 1);
  const int rows = sphere ? std::max(checked_count(period / cell_y, "cells of the period"), 2 * reach_y + 1) : 1;
  const int components = sphere ? 6 : ring ? 4 : 3;
  const double cells = static_cast<double>(columns) * rows;
  // A length that is a prime number takes FFTW (3.3.10) the most of both.
  const double bytes_per_cell = 8.0 * components + (sphere ? 12 : 60), seconds_per_cell = 0.85e-6;
  require_memory(bytes_per_cell * cells, message_text("the period needs ", columns, " x ", rows, " cells"));
  require_time(seconds_per_cell * cells * components);
  const double step_x = 2 * M_PI / (columns * cell_x), step_y = sphere ? 2 * M_PI / (rows * cell_y) : 0;
  const int half = columns / 2 + 1, terms_y = sphere ? terms : 0;

  // Spectra by rows of ky; kx >= 0 only, as the coefficients are real.
  constexpr std::size_t hoop = 6;
  std::array<FftBuffer<complex>, 7> spectra;
  constexpr std::array<std::size_t, 4> line_components{coefficient::ww, coefficient::uu, coefficient::uw, hoop};
  const auto component_at = [&](int component) {
    return sphere ? static_cast<std::size_t>(component) : line_components[static_cast<std::size_t>(component)];
  };
  for (int component = 0; component < components; ++component)
    spectra[component_at(component)] =
        FftBuffer<complex>(static_cast<std::size_t>(rows) * static_cast<std::size_t>(half));
  const double area = columns * cell_x * (sphere ? rows * cell_y : 1.0);

  for (int n = -terms; n <= terms; ++n) {
    const int column = wrapped(n, columns);
    if (column >= half) continue;
    require_time();
    const double kx = n * step_x;
    const double scale = average_over_cell(kx, cell_x) / area;
    const SymbolsAcross across = symbols(kx);
    for (int m = -terms_y; m <= terms_y; ++m) {
      const double ky = m * step_y, k = std::hypot(kx, ky);
      const SurfaceCompliance c = across(ky);
      const double lx = k > 0 ? kx / k : 0, ly = k > 0 ? ky / k : 0;
      const double factor = scale * average_over_cell(ky, cell_y);
      const complex i_factor(0, factor);
      const auto at = static_cast<std::size_t>(wrapped(m, rows) * half + column);
      using namespace coefficient;
      spectra[ww][at] += factor * c.normal;
      spectra[uu][at] += factor * (k > 0 ? lx * lx * c.longitudinal + ly * ly * c.transverse : c.longitudinal);
      spectra[uw][at] += i_factor * lx * c.cross;
      if (ring) spectra[hoop][at] += i_factor * lx * c.hoop;
      if (!sphere) continue;
      spectra[vv][at] += factor * (k > 0 ? ly * ly * c.longitudinal + lx * lx * c.transverse : c.transverse);
      spectra[uv][at] += factor * lx * ly * (c.longitudinal - c.transverse);
      spectra[vw][at] += i_factor * ly * c.cross;
    }
  }

  InfluenceTable table(reach_x, reach_y);
  if (ring) table.bend();
  const std::array<std::vector<double>*, 7> targets{&table.ww, &table.uu, &table.vv,  &table.uv,
                                                    &table.uw, &table.vw, &table.hoop};
  FftBuffer<double> field(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  for (int component = 0; component < components; ++component) {
    const std::size_t c = component_at(component);
    require_time(seconds_per_cell * cells * (components - component));
    inverse_plane(columns, rows, spectra[c], field);
    for (int row = 0; row <= reach_y; ++row)
      for (int column = -reach_x; column <= reach_x; ++column)
        (*targets[c])[static_cast<std::size_t>(table.index(column, row))] =
            field[static_cast<std::size_t>(wrapped(row, rows) * columns + wrapped(column, columns))];
  }
  if (ring) add_mean_strain(table, symbols, 1e-25 * step_x, area, cell_x);
  return table;
}

}  // namespace rollres
