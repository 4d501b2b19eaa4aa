#include "core/influence/surface_shape.hpp"

namespace rollres {

SurfaceShape surface_shape(Indenter indenter, const Layer& layer) {
  SurfaceShape shape{.deep = half_space_symbols(layer.poisson_ratio), .base = {}, .radial = {}, .line = {}};
  if (std::isinf(layer.thickness)) {
    shape.base = shape.deep;
    return shape;
  }
  shape.length = layer.thickness;
  shape.extent = layer_table_end * layer.thickness;
  if (indenter == Indenter::cylinder)
    shape.line = line_table(layer.poisson_ratio);
  else
    shape.radial = radial_table(layer.poisson_ratio);
  return shape;
}

}  // namespace rollres
