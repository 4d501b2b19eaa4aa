#include "core/convolution/krylov_operator.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/convolution/influence_terms.hpp"
#include "core/model/contact_surface.hpp"

namespace rollres {

namespace {

using complex = std::complex<double>;

/// Shift of the slip operator's symbol, which vanishes at k = 0, relative to its largest value.
constexpr double slip_shift = 0.005;
/// Floor of the normal symbol, which vanishes at k = 0 for an incompressible layer, relative to its largest value.
constexpr double normal_floor = 1e-3;

/// Symbols of displacements at the nodes from tractions uniform over cells [m/Pa].
struct CellSymbols {
  complex ww = 0, uu = 0, uv = 0, vv = 0;
};

/// Sum over the aliases that matter: the nearest ones, for wavelengths of a few cells.
CellSymbols cell_symbols(const SteadySurface& surface, const SteadySurface::Moduli& moduli, double kx, double ky,
                         double cell_x, double cell_y) {
  const bool alias_x = kx * cell_x > 1, alias_y = ky * cell_y > 1;
  CellSymbols sum;
  for (int m = alias_x ? -1 : 0; m <= (alias_x ? 1 : 0); ++m)
    for (int n = alias_y ? -1 : 0; n <= (alias_y ? 1 : 0); ++n) {
      const double x = kx + (m == 0 ? 0 : m * 2 * M_PI / cell_x), y = ky + (n == 0 ? 0 : n * 2 * M_PI / cell_y);
      const double k = std::sqrt(x * x + y * y), lx = x / k, ly = y / k;
      const double average = average_over_cell(x, cell_x) * average_over_cell(y, cell_y);
      const SurfaceCompliance c = surface(moduli, x, y);
      sum.ww += average * c.normal;
      sum.uu += average * (lx * lx * c.longitudinal + ly * ly * c.transverse);
      sum.uv += average * lx * ly * (c.longitudinal - c.transverse);
      sum.vv += average * (ly * ly * c.longitudinal + lx * lx * c.transverse);
    }
  return sum;
}

template <class Real>
void store(Spectrum<Real>& spectrum, std::size_t at, complex value) {
  spectrum.re[at] = static_cast<Real>(value.real());
  spectrum.im[at] = static_cast<Real>(value.imag());
}

template <class Real>
void resize(std::size_t size, std::initializer_list<Spectrum<Real>*> spectra) {
  for (Spectrum<Real>* spectrum : spectra) {
    spectrum->re.resize(size);
    spectrum->im.resize(size);
  }
}

template <class Real>
Spectrum<Real> rounded(const Spectrum<double>& spectrum) {
  return {{spectrum.re.begin(), spectrum.re.end()}, {spectrum.im.begin(), spectrum.im.end()}};
}

}  // namespace

template <class Real>
KrylovOperator<Real>::KrylovOperator(const ContactModel& model, const SurfaceGrid& grid, PaddedSize padded,
                                     const InfluenceSpectra& spectra, bool friction)
    : grid_(grid), lateral_(model.dimension == 3), padded_(padded), ww_(rounded<Real>(spectra.ww)) {
  if (friction) {
    transform_ = std::make_unique<SurfaceConvolution<Real>>(padded_, grid_);
    wu_ = rounded<Real>(spectra.of_shear());
    vw_ = rounded<Real>(spectra.vw);
    const std::size_t rows = padded_.quarter_rows();
    // The forward difference over a cell, as a factor.
    const auto slip = [&](const Spectrum<double>& displacement, Spectrum<Real>& result) {
      resize<Real>(displacement.re.size(), {&result});
      for (std::size_t i = 0; i < displacement.re.size(); i += rows) {
        const double angle = 2 * M_PI * static_cast<double>(i / rows) / padded_.columns;
        const complex factor = (std::polar(1.0, angle) - 1.0) / grid_.spacing_x;
        for (std::size_t j = i; j < i + rows; ++j)
          store(result, j, factor * complex(displacement.re[j], displacement.im[j]));
      }
    };
    slip(spectra.uw, slip_uw_);
    slip(spectra.vw, slip_vw_);
    slip(spectra.uu, slip_uu_);
    slip(spectra.uv, slip_uv_);
    slip(spectra.vv, slip_vv_);
  }
  prepare_inverses(model, friction);
}

template <class Real>
void KrylovOperator<Real>::prepare_inverses(const ContactModel& model, bool friction) {
  const double normalise = 1 / padded_.points();
  const std::size_t size = padded_.quarter_size(), rows = padded_.quarter_rows();
  const double step_x = 2 * M_PI / (padded_.columns * grid_.spacing_x);
  const double step_y = lateral_ ? 2 * M_PI / (padded_.rows * grid_.spacing_y) : 0;
  // All symbols first, whose largest values the floor and the shift refer to.
  std::vector<CellSymbols> symbols(size);
  std::vector<complex> difference;  // by kx
  double largest_ww = 0, largest_xx = 0;
  const SteadySurface surface = steady_surface(model);
  SteadySurface::Moduli moduli;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t column = i / rows, row = i % rows;
    // A line's symbol at k = 0: the next; a surface's likewise.
    const double kx = static_cast<double>(column == 0 && !lateral_ ? 1 : column) * step_x;
    const double ky = lateral_ ? static_cast<double>(row == 0 && column == 0 ? 1 : row) * step_y : 0;
    if (row == 0) {
      moduli = surface.moduli(kx);
      // Minus the forward difference over a cell, as a symbol.
      difference.push_back((1.0 - std::polar(1.0, kx * grid_.spacing_x)) / grid_.spacing_x);
    }
    symbols[i] = cell_symbols(surface, moduli, kx, ky, grid_.spacing_x, lateral_ ? grid_.spacing_y : 0);
    largest_ww = std::max(largest_ww, std::abs(symbols[i].ww));
    largest_xx = std::max(largest_xx, std::abs(difference[column] * symbols[i].uu));
  }
  const double floor = std::pow(normal_floor * largest_ww, 2), shift = slip_shift * largest_xx;
  resize<Real>(size, {&inverse_ww_});
  if (friction) resize<Real>(size, {&inverse_xx_});
  if (friction && lateral_) resize<Real>(size, {&inverse_xy_});
  if (friction && model.lateral()) resize<Real>(size, {&inverse_yy_});
  for (std::size_t i = 0; i < size; ++i) {
    const CellSymbols& c = symbols[i];
    const complex ww = c.ww;
    store(inverse_ww_, i, normalise * std::conj(ww) / std::max(std::norm(ww), floor));
    if (!friction) continue;
    const complex slip = difference[i / rows];
    if (!lateral_) {
      store(inverse_xx_, i, normalise / (slip * c.uu + shift));
      if (model.lateral()) store(inverse_yy_, i, normalise / (slip * c.vv + shift));
      continue;
    }
    const complex xx = slip * c.uu + shift, xy = slip * c.uv, yy = slip * c.vv + shift;
    const complex over_determinant = normalise / (xx * yy - xy * xy);
    store(inverse_xx_, i, yy * over_determinant);
    store(inverse_xy_, i, -xy * over_determinant);
    store(inverse_yy_, i, xx * over_determinant);
  }
}

template <class Real>
EvenTransform<Real>& KrylovOperator<Real>::even_transform() {
  if (!even_transform_) even_transform_ = std::make_unique<EvenTransform<Real>>(padded_, grid_.folded);
  return *even_transform_;
}

template <class Real>
void KrylovOperator<Real>::apply(const Tractions& tractions, Response& response) {
  if (tractions.shear_x.size() == 0) {
    even_transform().convolve(tractions.pressure, grid_.columns, grid_.rows, ww_, response.w, grid_.columns);
    response.w = -response.w;
    return;
  }
  const InfluenceTerms<Real> terms{ww_, wu_, vw_, slip_uw_, slip_vw_, slip_uu_, slip_uv_, slip_vv_};
  transform_->convolve(
      {&tractions.pressure, lateral_ ? &tractions.shear_y : &none_, &tractions.shear_x, grid_.columns, grid_.rows},
      [&](const WavenumberBlock<Real>& block) { terms.multiply(block, lateral_); },
      {&response.w, lateral_ ? &response.slip_y : nullptr, &response.slip_x, grid_.columns, grid_.rows});
  if (!lateral_) along_axle(tractions.shear_y, slip_vv_, response.slip_y);
}

template <class Real>
void KrylovOperator<Real>::along_axle(const Field& from, const Spectrum<Real>& kernel, Field& to) {
  if (from.size() > 0) even_transform().convolve(from, grid_.columns, grid_.rows, kernel, to, grid_.columns);
}

template <class Real>
void KrylovOperator<Real>::approximate_inverse(const Response& wanted, Tractions& tractions) {
  if (wanted.slip_x.size() == 0) {
    even_transform().convolve(wanted.w, grid_.columns, grid_.rows, inverse_ww_, tractions.pressure, grid_.columns);
    return;
  }
  const auto multiply = [&](const WavenumberBlock<Real>& block) {
    const std::size_t first = block.first;
    const Real *const wr = inverse_ww_.re.data() + first, *const wi = inverse_ww_.im.data() + first;
    const Real *const xxr = inverse_xx_.re.data() + first, *const xxi = inverse_xx_.im.data() + first;
#pragma GCC ivdep
    for (int i = 0; i < block.count; ++i) {
      const Real pr = block.even_re[i], pi = block.even_im[i];
      block.even_re[i] = wr[i] * pr - wi[i] * pi;
      block.even_im[i] = wr[i] * pi + wi[i] * pr;
    }
    if (!lateral_) {
#pragma GCC ivdep
      for (int i = 0; i < block.count; ++i) {
        const Real xr = block.second_re[i], xi = block.second_im[i];
        block.second_re[i] = xxr[i] * xr - xxi[i] * xi;
        block.second_im[i] = xxr[i] * xi + xxi[i] * xr;
      }
      return;
    }
    const Real *const xyr = inverse_xy_.re.data() + first, *const xyi = inverse_xy_.im.data() + first;
    const Real *const yyr = inverse_yy_.re.data() + first, *const yyi = inverse_yy_.im.data() + first;
#pragma GCC ivdep
    for (int i = 0; i < block.count; ++i) {
      const Real xr = block.second_re[i], xi = block.second_im[i], yr = block.odd_re[i], yi = block.odd_im[i];
      block.second_re[i] = xxr[i] * xr - xxi[i] * xi + xyr[i] * yr - xyi[i] * yi;
      block.second_im[i] = xxr[i] * xi + xxi[i] * xr + xyr[i] * yi + xyi[i] * yr;
      block.odd_re[i] = xyr[i] * xr - xyi[i] * xi + yyr[i] * yr - yyi[i] * yi;
      block.odd_im[i] = xyr[i] * xi + xyi[i] * xr + yyr[i] * yi + yyi[i] * yr;
    }
  };
  transform_->convolve(
      {&wanted.w, lateral_ ? &wanted.slip_y : &none_, &wanted.slip_x, grid_.columns, grid_.rows}, multiply,
      {&tractions.pressure, lateral_ ? &tractions.shear_y : nullptr, &tractions.shear_x, grid_.columns, grid_.rows});
  if (!lateral_) along_axle(wanted.slip_y, inverse_yy_, tractions.shear_y);
}

template class KrylovOperator<float>;
template class KrylovOperator<double>;

}  // namespace rollres
