#include "core/influence/composite_table.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include "core/influence/line_passage.hpp"
#include "core/influence/sphere_passage.hpp"
#include "core/numerics/recently_made.hpp"
#include "core/surface/contact_surface.hpp"

namespace rollres {

namespace {

struct SurfaceKey {
  LayeredMedium medium;
  double wave_speed;  // 0 without inertia, whatever the speed
  bool operator==(const SurfaceKey&) const = default;
};

SurfaceKey surface_key(const RollingScene& scene, const LayeredMedium& medium) {
  return {medium, inertia_included(scene) ? scene.speed : 0};
}

std::shared_ptr<const SpherePassage> sphere_passage(const SurfaceKey& key) {
  static RecentlyMade<SurfaceKey, SpherePassage, 16> cache;
  return cache(key, [&] { return SpherePassage(key.medium, key.wave_speed); });
}

struct TableKey {
  SurfaceKey surface;
  double speed, cell_x, cell_y;
  int columns, rows;
  bool operator==(const TableKey&) const = default;
};

std::shared_ptr<const InfluenceTable> sphere_table(const TableKey& key) {
  static RecentlyMade<TableKey, InfluenceTable, 8> cache;
  return cache(key, [&] {
    return sphere_passage(key.surface)->table(key.speed, key.cell_x, key.cell_y, key.columns, key.rows);
  });
}

}  // namespace

InfluenceTable composite_table(const RollingScene& scene, const SurfaceGrid& grid, int reach_x, int reach_y) {
  if (scene.indenter == Indenter::cylinder) return line_passage_table(scene, grid, reach_x);
  const auto table_of = [&](const LayeredMedium& medium) {
    return sphere_table({surface_key(scene, medium), scene.speed, grid.spacing_x, grid.spacing_y, reach_x, reach_y});
  };
  InfluenceTable sum = *table_of(foundation_of(scene));
  const LayeredMedium coating = coating_of(scene);
  if (coating.empty()) return sum;
  const std::shared_ptr<const InfluenceTable> body = table_of(coating);
  const auto add = [](std::vector<double>& to, const std::vector<double>& from, double sign) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += sign * from[i];
  };
  add(sum.ww, body->ww, 1);
  add(sum.uu, body->uu, 1);
  add(sum.vv, body->vv, 1);
  add(sum.uv, body->uv, 1);
  add(sum.uw, body->uw, -1);
  add(sum.vw, body->vw, -1);
  return sum;
}

double expansion_error(const RollingScene& scene) {
  if (scene.indenter == Indenter::cylinder) return line_expansion_error(scene);
  double error = sphere_passage(surface_key(scene, foundation_of(scene)))->error();
  if (const LayeredMedium coating = coating_of(scene); !coating.empty())
    error = std::max(error, sphere_passage(surface_key(scene, coating))->error());
  return error;
}

}  // namespace rollres
