#include "core/convolution/plane_convolution.hpp"

#include <algorithm>

#include "core/convolution/line_batches.hpp"

namespace rollres {

template <class Real>
PlaneConvolution<Real>::PlaneConvolution(PaddedSize size)
    : size_(size),
      along_x_(shared_fft_line<Real>(size.columns)),
      along_y_(shared_fft_line<complex>(size.rows)),
      work_(static_cast<std::size_t>(threads_for(size.points()))) {
  const auto half = static_cast<std::size_t>(size.columns / 2 + 1), rows = static_cast<std::size_t>(size.rows);
  for (FftBuffer<complex>& spectrum : spectra_) spectrum = FftBuffer<complex>(half * rows);
  for (Work& work : work_) {
    work.lines = FftBuffer<Real>(static_cast<std::size_t>(batch * size.columns));
    work.transformed = FftBuffer<complex>(static_cast<std::size_t>(batch * line_room(size)));
    for (FftBuffer<complex>& column : work.columns) column = FftBuffer<complex>(rows);
    for (FftBuffer<Real>& block : work.blocks) block = FftBuffer<Real>(2 * fields * size.quarter_rows());
  }
}

template <class Real>
void PlaneConvolution<Real>::load(const Fields& in) {
  const std::array<const Vector*, fields> given{in.even, in.odd, in.second_even};
  for (std::size_t f = 0; f < fields; ++f) given_[f] = given[f] && given[f]->size() > 0;
  const int room = line_room(size_), half = size_.columns / 2 + 1;
  share_out(batches(in.rows), static_cast<int>(work_.size()), [&](int index, int slot) {
    Work& work = work_[static_cast<std::size_t>(slot)];
    const int row = index * batch, count = std::min(batch, in.rows - row);
    for (std::size_t f = 0; f < fields; ++f) {
      if (!given_[f]) continue;
      for (int i = 0; i < count; ++i) {
        Real* const line = work.lines.data() + static_cast<std::ptrdiff_t>(i) * size_.columns;
        const Real* const from = given[f]->data() + static_cast<Eigen::Index>(row + i) * in.columns;
        std::copy(from, from + in.columns, line);
        std::fill(line + in.columns, line + size_.columns, Real(0));
        along_x_.forward(line, work.transformed.data() + static_cast<std::ptrdiff_t>(i) * room);
      }
      for (int kx = 0; kx < half; ++kx)
        for (int i = 0; i < count; ++i)
          column(f, kx)[row + i] = work.transformed[static_cast<std::size_t>(i * room + kx)];
    }
  });
}

template <class Real>
void PlaneConvolution<Real>::transform_columns(Work& work, int kx, int rows) {
  for (std::size_t f = 0; f < fields; ++f) {
    complex* const to = work.columns[f].data();
    if (given_[f]) {
      std::fill(column(f, kx) + rows, column(f, kx) + size_.rows, complex());
      along_y_.forward(column(f, kx), to);
    } else {
      std::fill(to, to + size_.rows, complex());
    }
  }
}

template <class Real>
WavenumberBlock<Real> PlaneConvolution<Real>::take(Work& work, std::size_t first, bool negative) const {
  const std::size_t count = size_.quarter_rows();
  Real* const at = work.blocks[negative ? 1 : 0].data();
  const WavenumberBlock<Real> block{
      first, static_cast<int>(count), at, at + count, at + 2 * count, at + 3 * count, at + 4 * count, at + 5 * count};
  const complex *const p = work.columns[0].data(), *const o = work.columns[1].data(), *const q = work.columns[2].data();
  const Real sign = negative ? Real(-1) : Real(1);
  for (int ky = 0; ky < block.count; ++ky) {
    const int from = negative && ky > 0 ? size_.rows - ky : ky;
    block.even_re[ky] = p[from].real();
    block.even_im[ky] = p[from].imag();
    block.odd_re[ky] = sign * o[from].real();
    block.odd_im[ky] = sign * o[from].imag();
    block.second_re[ky] = q[from].real();
    block.second_im[ky] = q[from].imag();
  }
  return block;
}

template <class Real>
void PlaneConvolution<Real>::put(const WavenumberBlock<Real>& block, bool negative, Work& work) const {
  complex *const p = work.columns[0].data(), *const o = work.columns[1].data(), *const q = work.columns[2].data();
  const Real sign = negative ? Real(-1) : Real(1);
  for (int ky = 0; ky < block.count; ++ky) {
    if (negative && (ky == 0 || 2 * ky == size_.rows)) continue;  // which is its own negative
    const int to = negative ? size_.rows - ky : ky;
    p[to] = {block.even_re[ky], block.even_im[ky]};
    o[to] = {sign * block.odd_re[ky], sign * block.odd_im[ky]};
    q[to] = {block.second_re[ky], block.second_im[ky]};
  }
}

template <class Real>
void PlaneConvolution<Real>::transform_columns_back(Work& work, int kx, const Results& out) {
  const std::array<Vector*, fields> wanted{out.even, out.odd, out.second_even};
  for (std::size_t f = 0; f < fields; ++f)
    if (wanted[f]) along_y_.inverse(work.columns[f].data(), column(f, kx));
}

template <class Real>
void PlaneConvolution<Real>::unload(const Results& out) {
  const std::array<Vector*, fields> wanted{out.even, out.odd, out.second_even};
  for (Vector* field : wanted)
    if (field) field->resize(static_cast<Eigen::Index>(out.columns) * out.rows);
  const int room = line_room(size_), half = size_.columns / 2 + 1;
  share_out(batches(out.rows), static_cast<int>(work_.size()), [&](int index, int slot) {
    Work& work = work_[static_cast<std::size_t>(slot)];
    const int row = index * batch, count = std::min(batch, out.rows - row);
    for (std::size_t f = 0; f < fields; ++f) {
      if (!wanted[f]) continue;
      for (int kx = 0; kx < half; ++kx)
        for (int i = 0; i < count; ++i)
          work.transformed[static_cast<std::size_t>(i * room + kx)] = column(f, kx)[row + i];
      for (int i = 0; i < count; ++i) {
        Real* const line = work.lines.data() + static_cast<std::ptrdiff_t>(i) * size_.columns;
        along_x_.inverse(work.transformed.data() + static_cast<std::ptrdiff_t>(i) * room, line);
        std::copy(line, line + out.columns, wanted[f]->data() + static_cast<Eigen::Index>(row + i) * out.columns);
      }
    }
  });
}

template class PlaneConvolution<double>;
template class PlaneConvolution<float>;

}  // namespace rollres
