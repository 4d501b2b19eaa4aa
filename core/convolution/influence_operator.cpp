#include "core/convolution/influence_operator.hpp"

#include "core/convolution/influence_terms.hpp"
#include "core/convolution/krylov_operator.hpp"

namespace rollres {

namespace {

/// Coefficients for offsets up to +-reach_x columns and reach_y rows, times `factor`.
Vector coefficients(const InfluenceTable& table, const std::vector<double>& component, int reach_x, int reach_y,
                    double factor) {
  const Eigen::Index width = 2 * reach_x + 1;
  Vector values(width * (reach_y + 1));
  for (int row = 0; row <= reach_y; ++row)
    values.segment(row * width, width) =
        factor * Eigen::Map<const Vector>(component.data() + table.index(-reach_x, row), width);
  return values;
}

InfluenceSpectra transform_coefficients(const InfluenceTable& table, const SurfaceGrid& grid, bool lateral,
                                        bool friction, PaddedSize padded) {
  InfluenceSpectra spectra;
  PaddedConvolution<double> transform(padded);  // the coefficients are even or odd in y on any grid
  const std::size_t size = transform.size().quarter_size();
  const int reach_x = grid.columns, reach_y = grid.whole_rows() - 1;
  const double factor = grid.cell_area() / transform.size().points();
  const auto pass = [&](const std::vector<double>& even, Spectrum<double>& of_even, const std::vector<double>* odd,
                        Spectrum<double>* of_odd, const std::vector<double>* second, Spectrum<double>* of_second) {
    Vector values[3];
    values[0] = coefficients(table, even, reach_x, reach_y, factor);
    if (odd) values[1] = coefficients(table, *odd, reach_x, reach_y, factor);
    if (second) values[2] = coefficients(table, *second, reach_x, reach_y, factor);
    for (Spectrum<double>* spectrum : {&of_even, of_odd, of_second})
      if (spectrum) {
        spectrum->re.resize(size);
        spectrum->im.resize(size);
      }
    const auto keep = [](Spectrum<double>& to, const WavenumberBlock<double>& block, const double* re,
                         const double* im) {
      std::copy(re, re + block.count, to.re.begin() + static_cast<std::ptrdiff_t>(block.first));
      std::copy(im, im + block.count, to.im.begin() + static_cast<std::ptrdiff_t>(block.first));
    };
    transform.transform({&values[0], &values[1], &values[2], 2 * reach_x + 1, reach_y + 1}, -reach_x,
                        [&](const WavenumberBlock<double>& block) {
                          keep(of_even, block, block.even_re, block.even_im);
                          if (of_odd) keep(*of_odd, block, block.odd_re, block.odd_im);
                          if (of_second) keep(*of_second, block, block.second_re, block.second_im);
                        });
  };
  if (!friction) {
    pass(table.ww, spectra.ww, nullptr, nullptr, nullptr, nullptr);
  } else if (!lateral) {
    pass(table.ww, spectra.ww, nullptr, nullptr, &table.uu, &spectra.uu);
    if (table.hoop.empty()) {
      pass(table.uw, spectra.uw, nullptr, nullptr, nullptr, nullptr);
    } else {
      std::vector<double> of_shear = table.uw;
      for (std::size_t i = 0; i < of_shear.size(); ++i) of_shear[i] += table.hoop[i];
      pass(table.uw, spectra.uw, nullptr, nullptr, &of_shear, &spectra.wu);
    }
    if (!table.vv.empty()) pass(table.vv, spectra.vv, nullptr, nullptr, nullptr, nullptr);
  } else {
    pass(table.ww, spectra.ww, &table.uv, &spectra.uv, &table.uu, &spectra.uu);
    pass(table.vv, spectra.vv, &table.vw, &spectra.vw, &table.uw, &spectra.uw);
  }
  return spectra;
}

}  // namespace

InfluenceOperator::InfluenceOperator(const ContactModel& model, const InfluenceTable& table, const SurfaceGrid& grid,
                                     bool friction)
    : model_(model),
      grid_(grid),
      lateral_(model.dimension == 3),
      friction_(friction),
      padded_(padded_size(grid.columns, grid.whole_rows(), 1)),
      coating_table_(table.coating) {
  spectra_ = transform_coefficients(table, grid, lateral_, friction, padded_);
  self_normal_ = table(Direction::w, Direction::w, 0) * grid.cell_area();
  self_slip_ =
      (table(Direction::u, Direction::u, 0) - table(Direction::u, Direction::u, 1)) * grid.cell_area() / grid.spacing_x;
}

InfluenceOperator::~InfluenceOperator() = default;

const InfluenceOperator* InfluenceOperator::part(std::unique_ptr<InfluenceOperator>& made,
                                                 const std::shared_ptr<const InfluenceTable>& table,
                                                 bool reversed) const {
  if (table && !made)
    made = std::make_unique<InfluenceOperator>(model_, reversed ? table->transposed() : *table, grid_, friction_);
  return made.get();
}

template <>
KrylovOperator<float>& InfluenceOperator::krylov() const {
  if (!single_) single_ = std::make_unique<KrylovOperator<float>>(model_, grid_, padded_, spectra_, friction_);
  return *single_;
}

template <>
KrylovOperator<double>& InfluenceOperator::krylov() const {
  if (!double_) double_ = std::make_unique<KrylovOperator<double>>(model_, grid_, padded_, spectra_, friction_);
  return *double_;
}

EvenTransform<double>& InfluenceOperator::even_transform() const {
  if (!even_transform_) even_transform_ = std::make_unique<EvenTransform<double>>(padded_, grid_.folded);
  return *even_transform_;
}

Displacements InfluenceOperator::apply(const Vector& pressure, const Vector& shear_x, const Vector& shear_y) const {
  Displacements moved;
  const int columns = grid_.columns + 1;
  if (shear_x.size() == 0) {
    even_transform().convolve(-pressure, grid_.columns, grid_.rows, spectra_.ww, moved.w, columns);
    return moved;
  }
  const InfluenceTerms<double> terms{spectra_.ww, spectra_.of_shear(), spectra_.vw, spectra_.uw,
                                     spectra_.vw, spectra_.uu,         spectra_.uv, spectra_.vv};
  const Vector none;
  if (!transform_) transform_ = std::make_unique<SurfaceConvolution<double>>(padded_, grid_);
  transform_->convolve({&pressure, lateral_ ? &shear_y : &none, &shear_x, grid_.columns, grid_.rows},
                       [&](const WavenumberBlock<double>& block) { terms.multiply(block, lateral_); },
                       {&moved.w, lateral_ ? &moved.v : nullptr, &moved.u, columns, grid_.rows});
  if (!lateral_ && shear_y.size() > 0) {
    even_transform().convolve(shear_y, grid_.columns, grid_.rows, spectra_.vv, moved.v, columns);
  }
  return moved;
}

}  // namespace rollres
