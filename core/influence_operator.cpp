#include "core/influence_operator.hpp"

#include <algorithm>
#include <cmath>

#include "core/layer_compliance.hpp"
#include "core/material.hpp"

namespace rollres {

namespace {

/// Shift of the slip operator's symbol, which vanishes at k = 0, relative to its largest value.
constexpr double slip_shift = 0.005;
/// Floor of the normal symbol, which vanishes at k = 0 for an incompressible layer, relative to its largest value.
constexpr double normal_floor = 1e-3;

/// Symbols of displacements at the nodes from tractions uniform over cells, unit shear modulus [m].
struct CellSymbols {
  double ww = 0, uu = 0, uv = 0, vv = 0;
};

/// Sum over the aliases that matter: the nearest ones, for wavelengths of a few cells.
CellSymbols cell_symbols(double kx, double ky, double thickness, double cell_x, double cell_y) {
  const auto factor = [](double k, double cell) {
    const double z = 0.5 * k * cell;
    return z == 0 ? 1 : std::sin(z) / z;
  };
  const bool alias_x = kx * cell_x > 1, alias_y = ky * cell_y > 1;
  CellSymbols sum;
  for (int m = alias_x ? -1 : 0; m <= (alias_x ? 1 : 0); ++m)
    for (int n = alias_y ? -1 : 0; n <= (alias_y ? 1 : 0); ++n) {
      const double x = kx + (m == 0 ? 0 : m * 2 * M_PI / cell_x), y = ky + (n == 0 ? 0 : n * 2 * M_PI / cell_y);
      const double k = std::hypot(x, y), lx = x / k, ly = y / k, average = factor(x, cell_x) * factor(y, cell_y);
      const LayerSymbols c = layer_symbols(k, thickness);
      sum.ww += average * c.normal;
      sum.uu += average * (lx * lx * c.longitudinal + ly * ly * c.transverse);
      sum.uv += average * lx * ly * (c.longitudinal - c.transverse);
      sum.vv += average * (ly * ly * c.longitudinal + lx * lx * c.transverse);
    }
  return sum;
}

}  // namespace

InfluenceOperator::InfluenceOperator(const RollingScene& scene, const InfluenceTable& table, const SurfaceGrid& half,
                                     bool friction)
    : grid_(half),
      sphere_(scene.indenter == Indenter::sphere),
      transform_(std::make_unique<SurfaceTransform>(half.columns, half.rows, 1)) {
  const int reach_x = half.columns, reach_y = 2 * (half.rows - 1);
  const double padded = static_cast<double>(transform_->padded_columns()) * transform_->padded_rows();
  const double normalise = half.cell_area() / padded;
  const auto kernel = [&](const std::vector<double>& component, bool odd_in_y) {
    return transform_->kernel(reach_x, reach_y, odd_in_y, [&](int column, int row) {
      return normalise * component[static_cast<std::size_t>(table.index(column, row))];
    });
  };
  ww_ = kernel(table.ww, false);
  if (friction) {
    uu_ = kernel(table.uu, false);
    uw_ = kernel(table.uw, false);
    if (sphere_) {
      vv_ = kernel(table.vv, false);
      uv_ = kernel(table.uv, true);
      vw_ = kernel(table.vw, true);
    }
  }
  self_normal_ = table(Direction::w, Direction::w, 0) * half.cell_area();
  self_slip_ =
      (table(Direction::u, Direction::u, 0) - table(Direction::u, Direction::u, 1)) * half.cell_area() / half.spacing_x;
  prepare_inverses(scene, friction);
}

void InfluenceOperator::prepare_inverses(const RollingScene& scene, bool friction) {
  const double normalise = 1 / (static_cast<double>(transform_->padded_columns()) * transform_->padded_rows());
  const std::size_t size = transform_->quarter_size();
  const int rows = transform_->quarter_rows();
  const double step_x = 2 * M_PI / (transform_->padded_columns() * grid_.spacing_x);
  const double step_y = sphere_ ? 2 * M_PI / (transform_->padded_rows() * grid_.spacing_y) : 0;
  const CreepSpectrum material = creep_spectrum(scene);
  inverse_ww_.resize(size);
  if (friction) inverse_xx_.resize(size);
  if (friction && sphere_) {
    inverse_xy_.resize(size);
    inverse_yy_.resize(size);
  }
  // Symbols first, then their reciprocals.
  double largest_ww = 0, largest_xx = 0;
  for (int column = 0; column < transform_->quarter_columns(); ++column) {
    const double kx = std::max(column, column == 0 && !sphere_ ? 1 : 0) * step_x;  // a line's symbol at k = 0: the next
    const complex compliance = material(-kx * scene.speed);
    // Minus the forward difference over a cell, as a symbol.
    const complex difference = (1.0 - std::polar(1.0, kx * grid_.spacing_x)) / grid_.spacing_x;
    for (int row = 0; row < rows; ++row) {
      const double ky = sphere_ ? (row == 0 && column == 0 ? 1 : row) * step_y : 0;
      const CellSymbols c = cell_symbols(kx, ky, scene.layer_thickness, grid_.spacing_x, sphere_ ? grid_.spacing_y : 0);
      const auto i = static_cast<std::size_t>(column) * static_cast<std::size_t>(rows) + static_cast<std::size_t>(row);
      inverse_ww_[i] = compliance * c.ww;
      largest_ww = std::max(largest_ww, std::abs(inverse_ww_[i]));
      if (!friction) continue;
      inverse_xx_[i] = difference * compliance * c.uu;
      largest_xx = std::max(largest_xx, std::abs(inverse_xx_[i]));
      if (!sphere_) continue;
      inverse_xy_[i] = difference * compliance * c.uv;
      inverse_yy_[i] = difference * compliance * c.vv;
    }
  }
  const double floor = std::pow(normal_floor * largest_ww, 2), shift = slip_shift * largest_xx;
  for (complex& value : inverse_ww_) value = normalise * std::conj(value) / std::max(std::norm(value), floor);
  if (!friction) return;
  if (!sphere_) {
    for (complex& value : inverse_xx_) value = normalise / (value + shift);
    return;
  }
  for (std::size_t i = 0; i < size; ++i) {
    const complex xx = inverse_xx_[i] + shift, xy = inverse_xy_[i], yy = inverse_yy_[i] + shift;
    const complex over_determinant = normalise / (xx * yy - xy * xy);
    inverse_xx_[i] = yy * over_determinant;
    inverse_xy_[i] = -xy * over_determinant;
    inverse_yy_[i] = xx * over_determinant;
  }
}

Displacements InfluenceOperator::apply(const Vector& pressure, const Vector& shear_x, const Vector& shear_y) const {
  using Triple = SurfaceTransform::Triple;
  Displacements moved;
  const int columns = grid_.columns + 1;
  transform_->forward(pressure, shear_y, shear_x);
  if (shear_x.size() == 0) {
    transform_->multiply([&](std::size_t i, const Triple& t) { return Triple{-ww_[i] * t.even, 0, 0}; });
    transform_->inverse(columns, &moved.w, nullptr, nullptr);
  } else if (!sphere_) {
    transform_->multiply([&](std::size_t i, const Triple& t) {
      const complex p = t.even, x = t.second_even;
      return Triple{-ww_[i] * p - uw_[i] * x, 0, -uw_[i] * p + uu_[i] * x};
    });
    transform_->inverse(columns, &moved.w, nullptr, &moved.u);
  } else {
    transform_->multiply([&](std::size_t i, const Triple& t) {
      const complex p = t.even, y = t.odd, x = t.second_even;
      return Triple{-ww_[i] * p - uw_[i] * x - vw_[i] * y, -vw_[i] * p + uv_[i] * x + vv_[i] * y,
                    -uw_[i] * p + uu_[i] * x + uv_[i] * y};
    });
    transform_->inverse(columns, &moved.w, &moved.v, &moved.u);
  }
  return moved;
}

Tractions InfluenceOperator::approximate_inverse(const Vector& displacement, const Vector& slip_x,
                                                 const Vector& slip_y) const {
  using Triple = SurfaceTransform::Triple;
  Tractions tractions;
  transform_->forward(displacement, slip_y, slip_x);
  if (slip_x.size() == 0) {
    transform_->multiply([&](std::size_t i, const Triple& t) { return Triple{inverse_ww_[i] * t.even, 0, 0}; });
    transform_->inverse(grid_.columns, &tractions.pressure, nullptr, nullptr);
  } else if (!sphere_) {
    transform_->multiply([&](std::size_t i, const Triple& t) {
      return Triple{inverse_ww_[i] * t.even, 0, inverse_xx_[i] * t.second_even};
    });
    transform_->inverse(grid_.columns, &tractions.pressure, nullptr, &tractions.shear_x);
  } else {
    transform_->multiply([&](std::size_t i, const Triple& t) {
      const complex x = t.second_even, y = t.odd;
      return Triple{inverse_ww_[i] * t.even, inverse_xy_[i] * x + inverse_yy_[i] * y,
                    inverse_xx_[i] * x + inverse_xy_[i] * y};
    });
    transform_->inverse(grid_.columns, &tractions.pressure, &tractions.shear_y, &tractions.shear_x);
  }
  return tractions;
}

}  // namespace rollres
