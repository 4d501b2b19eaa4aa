#include "core/influence_operator.hpp"

#include <algorithm>
#include <cmath>

namespace rollres {

namespace {

/// Shift of the slip operator's symbol, which vanishes at k = 0, relative to its largest value.
constexpr double slip_shift = 0.005;
/// Floor of the normal symbol, which vanishes at k = 0 for an incompressible layer, relative to its largest value.
constexpr double normal_floor = 1e-3;

}  // namespace

InfluenceOperator::InfluenceOperator(const InfluenceTable& table, const SurfaceGrid& half, bool sphere, bool friction)
    : grid_(half), sphere_(sphere), friction_(friction) {
  padded_columns_ = good_fft_size(2 * half.columns + 1);
  padded_rows_ = sphere ? good_fft_size(4 * half.rows - 3) : 1;
  plan_ = FftPlan(padded_columns_, padded_rows_);
  const auto field_size = static_cast<std::size_t>(padded_columns_) * static_cast<std::size_t>(padded_rows_);
  const auto spectrum_size = static_cast<std::size_t>(padded_columns_ / 2 + 1) * static_cast<std::size_t>(padded_rows_);

  const int reach_x = half.columns, reach_y = sphere ? 2 * (half.rows - 1) : 0;
  const double normalise = half.cell_area() / static_cast<double>(field_size);
  FftBuffer<double> field(field_size);
  const auto transform = [&](const std::vector<double>& component, double row_parity) {
    std::fill(field.data(), field.data() + field_size, 0.0);
    for (int row = -reach_y; row <= reach_y; ++row)
      for (int column = -reach_x; column <= reach_x; ++column) {
        const int px = (column + padded_columns_) % padded_columns_, py = (row + padded_rows_) % padded_rows_;
        field[static_cast<std::size_t>(py) * static_cast<std::size_t>(padded_columns_) + static_cast<std::size_t>(px)] =
            normalise * (row < 0 ? row_parity : 1) *
            component[static_cast<std::size_t>(table.index(column, std::abs(row)))];
      }
    Spectrum spectrum(spectrum_size);
    plan_.forward(field, spectrum);
    return spectrum;
  };
  ww_ = transform(table.ww, 1);
  if (friction) {
    uu_ = transform(table.uu, 1);
    uw_ = transform(table.uw, 1);
    if (sphere) {
      vv_ = transform(table.vv, 1);
      uv_ = transform(table.uv, -1);
      vw_ = transform(table.vw, -1);
    }
  }
  self_normal_ = table(Direction::w, Direction::w, 0) * half.cell_area();
  self_slip_ =
      (table(Direction::u, Direction::u, 0) - table(Direction::u, Direction::u, 1)) * half.cell_area() / half.spacing_x;

  const double back = 1.0 / (static_cast<double>(field_size) * static_cast<double>(field_size));
  inverse_ww_ = Spectrum(spectrum_size);
  double largest = 0;
  for (std::size_t i = 0; i < spectrum_size; ++i) largest = std::max(largest, std::abs(ww_[i]));
  for (std::size_t i = 0; i < spectrum_size; ++i) {
    const double size = std::abs(ww_[i]);
    inverse_ww_[i] = back * std::conj(ww_[i]) / std::max(size * size, std::pow(normal_floor * largest, 2));
  }
  if (!friction) return;
  inverse_xx_ = Spectrum(spectrum_size);
  if (sphere) {
    inverse_xy_ = Spectrum(spectrum_size);
    inverse_yy_ = Spectrum(spectrum_size);
  }
  const int width = padded_columns_ / 2 + 1;
  const auto difference = [&](std::size_t i) {
    const double angle = 2 * M_PI * static_cast<double>(i % static_cast<std::size_t>(width)) / padded_columns_;
    return (1.0 - std::polar(1.0, angle)) / half.spacing_x;  // minus the forward difference
  };
  largest = 0;
  for (std::size_t i = 0; i < spectrum_size; ++i) largest = std::max(largest, std::abs(difference(i) * uu_[i]));
  for (std::size_t i = 0; i < spectrum_size; ++i) {
    const complex d = difference(i), shift = slip_shift * largest;
    const complex xx = d * uu_[i] + shift;
    if (!sphere) {
      inverse_xx_[i] = back / xx;
      continue;
    }
    const complex xy = d * uv_[i], yy = d * vv_[i] + shift, determinant = xx * yy - xy * xy;
    inverse_xx_[i] = back * yy / determinant;
    inverse_xy_[i] = -back * xy / determinant;
    inverse_yy_[i] = back * xx / determinant;
  }
}

std::size_t InfluenceOperator::conjugate_row(std::size_t at) const {
  const auto width = static_cast<std::size_t>(padded_columns_ / 2 + 1);
  const std::size_t row = at / width, column = at % width;
  return (row == 0 ? 0 : static_cast<std::size_t>(padded_rows_) - row) * width + column;
}

/// Writes even + odd, mirrored to y < 0, into the padded field.
void InfluenceOperator::load_field(FftBuffer<double>& field, const Vector& even, const Vector& odd) const {
  const int columns = grid_.columns;
  for (int row = 0; row < grid_.rows; ++row) {
    double* upper = field.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(padded_columns_);
    double* lower = row == 0 ? nullptr
                             : field.data() + static_cast<std::size_t>(padded_rows_ - row) *
                                                  static_cast<std::size_t>(padded_columns_);
    const Eigen::Index first = static_cast<Eigen::Index>(row) * columns;
    for (int column = 0; column < columns; ++column) {
      const double e = even.size() > 0 ? even(first + column) : 0, o = odd.size() > 0 ? odd(first + column) : 0;
      upper[column] = row == 0 ? e : e + o;
      if (lower) lower[column] = e - o;
    }
  }
}

/// Reads the even part and, if wanted, the odd part of the padded field on the first `columns` columns.
void InfluenceOperator::read_field(const FftBuffer<double>& field, int columns, Vector& even, Vector* odd) const {
  even.resize(static_cast<Eigen::Index>(columns) * grid_.rows);
  if (odd) odd->resize(even.size());
  for (int row = 0; row < grid_.rows; ++row) {
    const double* upper = field.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(padded_columns_);
    const double* lower = field.data() + static_cast<std::size_t>(row == 0 ? 0 : padded_rows_ - row) *
                                             static_cast<std::size_t>(padded_columns_);
    const Eigen::Index first = static_cast<Eigen::Index>(row) * columns;
    for (int column = 0; column < columns; ++column) {
      even(first + column) = odd ? 0.5 * (upper[column] + lower[column]) : upper[column];
      if (odd) (*odd)(first + column) = 0.5 * (upper[column] - lower[column]);
    }
  }
}

InfluenceOperator::Spectrum InfluenceOperator::spectrum_of(const Vector& even, const Vector& odd) const {
  FftBuffer<double> field(static_cast<std::size_t>(padded_columns_) * static_cast<std::size_t>(padded_rows_));
  load_field(field, even, odd);
  Spectrum spectrum(static_cast<std::size_t>(padded_columns_ / 2 + 1) * static_cast<std::size_t>(padded_rows_));
  plan_.forward(field, spectrum);
  return spectrum;
}

Displacements InfluenceOperator::apply(const Vector& pressure, const Vector& shear_x, const Vector& shear_y) const {
  Displacements result;
  FftBuffer<double> field(static_cast<std::size_t>(padded_columns_) * static_cast<std::size_t>(padded_rows_));
  const int columns = grid_.columns + 1;
  if (!friction_) {
    Spectrum p = spectrum_of(pressure, {});
    for (std::size_t i = 0; i < p.size(); ++i) p[i] *= -ww_[i];
    plan_.inverse(p, field);
    read_field(field, columns, result.w, nullptr);
    return result;
  }
  if (!sphere_) {
    Spectrum p = spectrum_of(pressure, {}), x = spectrum_of(shear_x, {});
    for (std::size_t i = 0; i < p.size(); ++i) {
      const complex w = -ww_[i] * p[i] - uw_[i] * x[i], u = -uw_[i] * p[i] + uu_[i] * x[i];
      p[i] = w;
      x[i] = u;
    }
    plan_.inverse(p, field);
    read_field(field, columns, result.w, nullptr);
    plan_.inverse(x, field);
    read_field(field, columns, result.u, nullptr);
    return result;
  }
  // p + tau_y in one spectrum: the part even under ky -> -ky belongs to p, the odd one to tau_y.
  const Spectrum packed = spectrum_of(pressure, shear_y);
  Spectrum x = spectrum_of(shear_x, {});
  Spectrum both(packed.size());
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const complex mirror = packed[conjugate_row(i)];
    const complex p = 0.5 * (packed[i] + mirror), y = 0.5 * (packed[i] - mirror);
    const complex w = -ww_[i] * p - uw_[i] * x[i] - vw_[i] * y;
    const complex v = -vw_[i] * p + uv_[i] * x[i] + vv_[i] * y;
    x[i] = -uw_[i] * p + uu_[i] * x[i] + uv_[i] * y;
    both[i] = w + v;
  }
  plan_.inverse(both, field);
  read_field(field, columns, result.w, &result.v);
  plan_.inverse(x, field);
  read_field(field, columns, result.u, nullptr);
  return result;
}

Vector InfluenceOperator::approximate_pressure(const Vector& displacement) const {
  Spectrum spectrum = spectrum_of(displacement, {});
  for (std::size_t i = 0; i < spectrum.size(); ++i) spectrum[i] *= inverse_ww_[i];
  FftBuffer<double> field(static_cast<std::size_t>(padded_columns_) * static_cast<std::size_t>(padded_rows_));
  plan_.inverse(spectrum, field);
  Vector pressure;
  read_field(field, grid_.columns, pressure, nullptr);
  return pressure;
}

void InfluenceOperator::approximate_shear(const Vector& slip_x, const Vector& slip_y, Vector& shear_x,
                                          Vector& shear_y) const {
  FftBuffer<double> field(static_cast<std::size_t>(padded_columns_) * static_cast<std::size_t>(padded_rows_));
  // slip_x and slip_y in one spectrum, told apart as in `apply`.
  Spectrum packed = spectrum_of(slip_x, sphere_ ? slip_y : Vector());
  if (!sphere_) {
    for (std::size_t i = 0; i < packed.size(); ++i) packed[i] *= inverse_xx_[i];
    plan_.inverse(packed, field);
    read_field(field, grid_.columns, shear_x, nullptr);
    return;
  }
  Spectrum both(packed.size());
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const complex mirror = packed[conjugate_row(i)];
    const complex x = 0.5 * (packed[i] + mirror), y = 0.5 * (packed[i] - mirror);
    both[i] = inverse_xx_[i] * x + inverse_xy_[i] * y + inverse_xy_[i] * x + inverse_yy_[i] * y;
  }
  plan_.inverse(both, field);
  read_field(field, grid_.columns, shear_x, &shear_y);
}

}  // namespace rollres
