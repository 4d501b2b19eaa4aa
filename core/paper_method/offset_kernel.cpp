#include "core/paper_method/offset_kernel.hpp"

namespace rollres {

OffsetKernel::OffsetKernel(const SurfaceGrid& grid, const std::function<double(int, int)>& value)
    : columns_(grid.columns), width_(2 * grid.columns - 1) {
  const int reach_x = grid.columns - 1, reach_y = grid.rows - 1;
  values_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(2 * grid.rows - 1));
  centre_ = reach_y * width_ + reach_x;
  for (int row = -reach_y; row <= reach_y; ++row)
    for (int column = -reach_x; column <= reach_x; ++column)
      values_[centre_ + row * width_ + column] = value(column, row);
}

void OffsetKernel::add(const std::vector<int>& receivers, const std::vector<int>& sources,
                       const Eigen::VectorXd& forces, Eigen::VectorXd& response) const {
  std::vector<int> places(sources.size());
  Eigen::VectorXd source_forces(sources.size());
  for (std::size_t k = 0; k < sources.size(); ++k) {
    places[k] = centre_ - position(sources[k]);
    source_forces[k] = forces[sources[k]];
  }
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    const double* values = values_.data() + position(receivers[r]);
    double sum = 0;
    for (std::size_t k = 0; k < places.size(); ++k) sum += values[places[k]] * source_forces[k];
    response[r] += sum;
  }
}

OffsetKernel displacement_kernel(const InfluenceTable& table, const SurfaceGrid& grid, Direction displacement,
                                 Direction force) {
  return {grid, [&](int columns, int rows) { return table(displacement, force, columns, rows); }};
}

OffsetKernel slope_kernel(const InfluenceTable& table, const SurfaceGrid& grid, Direction displacement, Direction force,
                          SlipStencil stencil) {
  const int ahead = stencil == SlipStencil::backward ? 0 : 1, behind = stencil == SlipStencil::forward ? 0 : 1;
  const double distance = (ahead + behind) * grid.spacing_x;
  return {grid, [=, &table](int columns, int rows) {
            return (table(displacement, force, columns + ahead, rows) -
                    table(displacement, force, columns - behind, rows)) /
                   distance;
          }};
}

}  // namespace rollres
