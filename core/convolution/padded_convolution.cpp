#include "core/convolution/padded_convolution.hpp"

#include <algorithm>

#include "core/convolution/line_batches.hpp"

namespace rollres {

PaddedSize padded_size(int columns, int rows, int more_columns) {
  return {good_fft_size(2 * columns + more_columns), rows > 1 ? good_fft_size(2 * rows - 1) : 1};
}

template <class Real>
PaddedConvolution<Real>::PaddedConvolution(PaddedSize size)
    : size_(size),
      along_x_(shared_fft_line<complex>(size.columns)),
      along_y_(shared_fft_line<complex>(std::max(size.rows, 4))),
      work_(static_cast<std::size_t>(threads_for(size.points()))),
      spectrum_(static_cast<std::size_t>(size.columns) * static_cast<std::size_t>(size.rows)) {
  for (Work& work : work_) {
    for (auto* lines : {&work.lines, &work.transformed})
      *lines = FftBuffer<complex>(static_cast<std::size_t>(batch * size.columns));
    work.columns = FftBuffer<complex>(static_cast<std::size_t>(2 * size.rows));
    work.block = FftBuffer<Real>(6 * (size.rows > 1 ? size.quarter_rows() : size.quarter_size()));
  }
}

template <class Real>
void PaddedConvolution<Real>::load(const Fields& in, int first_column) {
  const Real* const even = in.even && in.even->size() > 0 ? in.even->data() : nullptr;
  const Real* const odd = in.odd && in.odd->size() > 0 ? in.odd->data() : nullptr;
  const Real* const second = in.second_even && in.second_even->size() > 0 ? in.second_even->data() : nullptr;
  const int wrapped = std::clamp(-first_column, 0, in.columns);  // columns that stand at the end of the line
  const auto fill = [&](complex* line, int row) {
    const Real sign = row < 0 ? Real(-1) : row == 0 ? Real(0) : Real(1);
    const auto from = static_cast<std::ptrdiff_t>(std::abs(row)) * in.columns;
    const auto copy = [&](complex* to, int begin, int end) {
      for (int i = begin; i < end; ++i, ++to)
        *to = {(even ? even[from + i] : Real(0)) + (odd ? sign * odd[from + i] : Real(0)),
               second ? second[from + i] : Real(0)};
      return to;
    };
    complex* const end_of_first = copy(line, wrapped, in.columns);
    std::fill(end_of_first, line + size_.columns - wrapped, complex());
    copy(line + size_.columns - wrapped, 0, wrapped);
  };
  if (size_.rows == 1) {
    fill(work_[0].lines.data(), 0);
    along_x_.forward(work_[0].lines.data(), spectrum_.data());
    return;
  }
  const int first_row = 1 - in.rows, last_row = in.rows - 1;
  share_out(batches(2 * in.rows - 1), threads(), [&](int index, int slot) {
    Work& work = work_[static_cast<std::size_t>(slot)];
    const int row = first_row + index * batch;
    const int count = std::min(batch, last_row - row + 1);
    for (int i = 0; i < count; ++i) {
      const auto line = static_cast<std::ptrdiff_t>(i) * size_.columns;
      fill(work.lines.data() + line, row + i);
      along_x_.forward(work.lines.data() + line, work.transformed.data() + line);
    }
    // Rows y < 0 stand at the end of a column; a batch may lie across.
    const int before = std::clamp(-row, 0, count);
    for (int kx = 0; kx < size_.columns; ++kx) {
      const complex* line = work.transformed.data() + kx;
      complex* const to = column(kx);
      for (int i = 0; i < before; ++i, line += size_.columns) to[size_.rows + row + i] = *line;
      for (int i = before; i < count; ++i, line += size_.columns) to[row + i] = *line;
    }
  });
}

template <class Real>
void PaddedConvolution<Real>::transform_columns(Work& work, int kx, int rows) {
  const int other = kx == 0 ? 0 : size_.columns - kx;
  for (const int k : {kx, other}) {
    std::fill(column(k) + rows, column(k) + size_.rows - rows + 1, complex());
    along_y_.forward(column(k), work.columns.data() + (k == kx ? 0 : size_.rows));
    if (other == kx) break;
  }
}

template <class Real>
void PaddedConvolution<Real>::split(const Work& work, int kx, const WavenumberBlock<Real>& block) {
  const Real half = Real(0.5);
  const complex* const plus = work.columns.data();
  const complex* const minus = single(kx) ? plus : plus + size_.rows;
  for (int ky = 0; ky < block.count; ++ky) {
    const int other = ky == 0 ? 0 : size_.rows - ky;
    const complex a = plus[ky], b = plus[other], c = minus[ky], d = minus[other];
    block.even_re[ky] = half * (a.real() + c.real());
    block.even_im[ky] = half * (a.imag() - c.imag());
    block.odd_re[ky] = half * (a.real() - b.real());
    block.odd_im[ky] = half * (a.imag() - b.imag());
    block.second_re[ky] = half * (a.imag() + d.imag());
    block.second_im[ky] = half * (d.real() - a.real());
  }
}

template <class Real>
void PaddedConvolution<Real>::join(Work& work, int kx, const WavenumberBlock<Real>& block) {
  complex* const plus = work.columns.data();
  complex* const minus = single(kx) ? plus : plus + size_.rows;
  for (int ky = 0; ky < block.count; ++ky) {
    const int other = ky == 0 ? 0 : size_.rows - ky;
    const Real pr = block.even_re[ky] + block.odd_re[ky], pi = block.even_im[ky] + block.odd_im[ky];
    const Real mr = block.even_re[ky] - block.odd_re[ky], mi = block.even_im[ky] - block.odd_im[ky];
    const Real qr = block.second_re[ky], qi = block.second_im[ky];
    plus[ky] = {pr - qi, pi + qr};      // P + O + iQ
    plus[other] = {mr - qi, mi + qr};   // P - O + iQ
    minus[ky] = {mr + qi, qr - mi};     // conj(P - O) + i conj(Q)
    minus[other] = {pr + qi, qr - pi};  // conj(P + O) + i conj(Q)
  }
}

template <class Real>
void PaddedConvolution<Real>::split_line(const WavenumberBlock<Real>& block) {
  const Real half = Real(0.5);
  for (int kx = 0; kx < block.count; ++kx) {
    const complex a = spectrum_[static_cast<std::size_t>(kx)];
    const complex c = spectrum_[static_cast<std::size_t>(kx == 0 ? 0 : size_.columns - kx)];
    block.even_re[kx] = half * (a.real() + c.real());
    block.even_im[kx] = half * (a.imag() - c.imag());
    block.second_re[kx] = half * (a.imag() + c.imag());
    block.second_im[kx] = half * (c.real() - a.real());
  }
}

template <class Real>
void PaddedConvolution<Real>::join_line(const WavenumberBlock<Real>& block) {
  for (int kx = 0; kx < block.count; ++kx) {
    const Real pr = block.even_re[kx], pi = block.even_im[kx], qr = block.second_re[kx], qi = block.second_im[kx];
    spectrum_[static_cast<std::size_t>(kx)] = {pr - qi, pi + qr};
    spectrum_[static_cast<std::size_t>(kx == 0 ? 0 : size_.columns - kx)] = {pr + qi, qr - pi};
  }
}

template <class Real>
void PaddedConvolution<Real>::transform_columns_back(Work& work, int kx, const Results& out) {
  const int other = kx == 0 ? 0 : size_.columns - kx;
  const Real half = Real(0.5);
  for (const int k : {kx, other}) {
    complex* const values = column(k);
    along_y_.inverse(work.columns.data() + (k == kx ? 0 : size_.rows), values);
    if (out.odd)
      // (z(y) + z(-y))/2 = p + i q stays on rows y >= 0; (z(y) - z(-y))/2 = o is real.
      for (int row = 1; row < out.rows; ++row) {
        complex &upper = values[row], &lower = values[size_.rows - row];
        const complex sum = half * (upper + lower), difference = half * (upper - lower);
        upper = sum;
        lower = difference;
      }
    if (other == kx) break;
  }
}

template <class Real>
void PaddedConvolution<Real>::unload(const Results& out) {
  const Eigen::Index size = static_cast<Eigen::Index>(out.columns) * out.rows;
  for (Vector* field : {out.even, out.odd, out.second_even})
    if (field) field->resize(size);
  if (size_.rows == 1) {
    complex* const line = work_[0].lines.data();
    along_x_.inverse(spectrum_.data(), line);
    for (int i = 0; i < out.columns; ++i) {
      if (out.even) (*out.even)(i) = line[i].real();
      if (out.second_even) (*out.second_even)(i) = line[i].imag();
      if (out.odd) (*out.odd)(i) = 0;
    }
    return;
  }
  const int rows = batches(out.rows), odd_rows = out.odd ? (batches(out.rows - 1) + 1) / 2 : 0;
  share_out(rows + odd_rows, threads(), [&](int index, int slot) {
    Work& work = work_[static_cast<std::size_t>(slot)];
    if (index < rows)
      unload_rows(work, index * batch, out);
    else
      unload_odd_rows(work, 1 + (index - rows) * 2 * batch, out);
  });
  if (out.odd) out.odd->head(out.columns).setZero();
}

template <class Real>
void PaddedConvolution<Real>::unload_rows(Work& work, int row, const Results& out) {
  const int count = std::min(batch, out.rows - row);
  for (int kx = 0; kx < size_.columns; ++kx) {
    const complex* const from = column(kx) + row;
    complex* line = work.lines.data() + kx;
    for (int i = 0; i < count; ++i, line += size_.columns) *line = from[i];
  }
  for (int i = 0; i < count; ++i) {
    const auto line = static_cast<std::ptrdiff_t>(i) * size_.columns;
    complex* const values = work.transformed.data() + line;
    along_x_.inverse(work.lines.data() + line, values);
    const Eigen::Index first = static_cast<Eigen::Index>(row + i) * out.columns;
    for (int c = 0; c < out.columns; ++c) {
      if (out.even) (*out.even)(first + c) = values[c].real();
      if (out.second_even) (*out.second_even)(first + c) = values[c].imag();
    }
  }
}

template <class Real>
void PaddedConvolution<Real>::unload_odd_rows(Work& work, int row, const Results& out) {
  // Two rows of the real field o make one complex line.
  const int rows = std::min(2 * batch, out.rows - row), count = (rows + 1) / 2;
  for (int kx = 0; kx < size_.columns; ++kx) {
    const complex* const from = column(kx) + size_.rows - row;
    complex* line = work.lines.data() + kx;
    for (int i = 0; i < count; ++i, line += size_.columns) {
      const complex first = from[-2 * i];
      const complex second = 2 * i + 1 < rows ? from[-2 * i - 1] : complex();
      *line = {first.real() - second.imag(), first.imag() + second.real()};
    }
  }
  for (int i = 0; i < rows; ++i) {
    const auto line = static_cast<std::ptrdiff_t>(i / 2) * size_.columns;
    complex* const values = work.transformed.data() + line;
    if (i % 2 == 0) along_x_.inverse(work.lines.data() + line, values);
    Real* const to = out.odd->data() + static_cast<Eigen::Index>(row + i) * out.columns;
    for (int c = 0; c < out.columns; ++c) to[c] = i % 2 == 0 ? values[c].real() : values[c].imag();
  }
}

template <class Real>
EvenTransform<Real>::EvenTransform(PaddedSize size, bool folded)
    : size_(size),
      folded_(folded),
      along_x_(shared_fft_line<Real>(size.columns)),
      along_y_(shared_fft_line<complex>(std::max(size.rows, 4))),
      work_(static_cast<std::size_t>(threads_for(size.points()))),
      spectrum_(static_cast<std::size_t>(size.columns / 2 + 1) * static_cast<std::size_t>(size.rows)) {
  for (Work& work : work_) {
    work.lines = FftBuffer<Real>(static_cast<std::size_t>(batch * size.columns));
    work.transformed = FftBuffer<complex>(static_cast<std::size_t>(batch * line_room(size)));
    work.column = FftBuffer<complex>(static_cast<std::size_t>(size.rows));
  }
}

template <class Real>
void EvenTransform<Real>::convolve(const Vector& in, int columns, int rows, const Spectrum<Real>& kernel, Vector& out,
                                   int out_columns) {
  const int half = size_.columns / 2 + 1, room = line_room(size_), quarter = size_.rows / 2 + 1;
  out.resize(static_cast<Eigen::Index>(out_columns) * rows);
  const auto column = [&](int kx) { return spectrum_.data() + static_cast<std::ptrdiff_t>(kx) * size_.rows; };
  const int threads = static_cast<int>(work_.size());
  const auto work_of = [&](int slot) -> Work& { return work_[static_cast<std::size_t>(slot)]; };

  share_out(batches(rows), threads, [&](int index, int slot) {
    Work& work = work_of(slot);
    const int row = index * batch, count = std::min(batch, rows - row);
    for (int i = 0; i < count; ++i) {
      Real* const line = work.lines.data() + static_cast<std::ptrdiff_t>(i) * size_.columns;
      const Real* const from = in.data() + static_cast<Eigen::Index>(row + i) * columns;
      std::copy(from, from + columns, line);
      std::fill(line + columns, line + size_.columns, Real(0));
      along_x_.forward(line, work.transformed.data() + static_cast<std::ptrdiff_t>(i) * room);
    }
    for (int kx = 0; kx < half; ++kx)
      for (int i = 0; i < count; ++i) column(kx)[row + i] = work.transformed[static_cast<std::size_t>(i * room + kx)];
  });

  share_out(half, threads, [&](int kx, int slot) {
    Work& work = work_of(slot);
    complex* const values = column(kx);
    complex* const spectrum = size_.rows > 1 ? work.column.data() : values;
    if (size_.rows > 1) {
      std::fill(values + rows, values + size_.rows, complex());
      for (int row = 1; folded_ && row < rows; ++row) values[size_.rows - row] = values[row];
      along_y_.forward(values, spectrum);
    }
    const Real* const re = kernel.re.data() + static_cast<std::ptrdiff_t>(kx) * quarter;
    const Real* const im = kernel.im.data() + static_cast<std::ptrdiff_t>(kx) * quarter;
    const auto multiply = [&](complex& value, int ky) {
      value = {re[ky] * value.real() - im[ky] * value.imag(), re[ky] * value.imag() + im[ky] * value.real()};
    };
    for (int ky = 0; ky < quarter; ++ky) multiply(spectrum[ky], ky);
    if (size_.rows == 1) return;
    for (int ky = 1; ky < size_.rows - quarter + 1; ++ky)
      if (folded_)
        spectrum[size_.rows - ky] = spectrum[ky];
      else
        multiply(spectrum[size_.rows - ky], ky);
    along_y_.inverse(spectrum, values);
  });

  share_out(batches(rows), threads, [&](int index, int slot) {
    Work& work = work_of(slot);
    const int row = index * batch, count = std::min(batch, rows - row);
    for (int kx = 0; kx < half; ++kx)
      for (int i = 0; i < count; ++i) work.transformed[static_cast<std::size_t>(i * room + kx)] = column(kx)[row + i];
    for (int i = 0; i < count; ++i) {
      Real* const line = work.lines.data() + static_cast<std::ptrdiff_t>(i) * size_.columns;
      along_x_.inverse(work.transformed.data() + static_cast<std::ptrdiff_t>(i) * room, line);
      std::copy(line, line + out_columns, out.data() + static_cast<Eigen::Index>(row + i) * out_columns);
    }
  });
}

template class PaddedConvolution<double>;
template class PaddedConvolution<float>;
template class EvenTransform<double>;
template class EvenTransform<float>;

}  // namespace rollres
