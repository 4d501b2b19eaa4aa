#include "core/influence/influence.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

#include "core/influence/composite_table.hpp"
#include "core/influence/passage_kernel.hpp"
#include "core/influence/periodic_kernel.hpp"
#include "core/material/lumped_spectrum.hpp"
#include "core/material/material.hpp"
#include "core/surface/contact_surface.hpp"

namespace rollres {

InfluenceTable::InfluenceTable(int reach_x, int reach_y) : reach_x_(reach_x), reach_y_(reach_y) {
  const auto size = static_cast<std::size_t>((2 * reach_x + 1) * (reach_y + 1));
  for (auto* component : {&ww, &uu, &uw}) component->assign(size, 0.0);
  if (reach_y > 0)
    for (auto* component : {&vv, &uv, &vw}) component->assign(size, 0.0);
}

double InfluenceTable::operator()(Direction displacement, Direction force, int columns, int rows) const {
  assert(std::abs(columns) <= reach_x_ && std::abs(rows) <= reach_y_);
  const auto at = static_cast<std::size_t>(index(columns, std::abs(rows)));
  const double odd = rows < 0 ? -1 : 1;
  using enum Direction;
  if (displacement == force) return displacement == w ? ww[at] : displacement == u ? uu[at] : vv[at];
  if (displacement != w && force != w) return odd * uv[at];
  const double sign = displacement == w ? -1 : 1;
  const Direction tangential = displacement == w ? force : displacement;
  return tangential == u ? sign * uw[at] : sign * odd * vw[at];
}

InfluenceTable influence_table(const RollingScene& scene, const SurfaceGrid& grid) {
  const bool sphere = scene.indenter == Indenter::sphere;
  const int reach_x = grid.columns, reach_y = sphere ? grid.rows : 0;
  if (scene.period) {
    const SteadySurface surface(scene);
    const auto symbols = [&surface](double along) -> SymbolsAcross {
      return
          [&surface, along, moduli = surface.moduli(along)](double across) { return surface(moduli, along, across); };
    };
    return periodic_table(symbols, *scene.period, scene.series_terms, grid.spacing_x, grid.spacing_y, reach_x, reach_y);
  }
  if (is_composite(scene)) return composite_table(scene, grid, reach_x, reach_y);
  const CreepSpectrum material = creep_spectrum(scene);
  const double largest =
      std::max(reach_x * grid.spacing_x, std::isinf(scene.layer_thickness) ? 0 : scene.layer_thickness);
  return shared_passage_kernel(scene.indenter, layer_of(scene), grid.spacing_x, grid.spacing_y, reach_x, reach_y)
      ->table(lumped_for(material, scene.speed, grid.spacing_x, largest), scene.speed, reach_x, reach_y);
}

}  // namespace rollres
