#include "core/influence/influence.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "core/influence/axial_line.hpp"
#include "core/influence/line_passage.hpp"
#include "core/influence/long_waves.hpp"
#include "core/influence/passage_kernel.hpp"
#include "core/influence/periodic_kernel.hpp"
#include "core/influence/sphere_passage.hpp"
#include "core/material/lumped_spectrum.hpp"
#include "core/material/material.hpp"
#include "core/model/contact_surface.hpp"
#include "core/numerics/recently_made.hpp"

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
  if (reach_y_ == 0 && (displacement == v || force == v)) return 0;  // antiplane shear moves nothing else
  if (displacement != w && force != w) return odd * uv[at];
  const double sign = displacement == w ? -1 : 1;
  const Direction tangential = displacement == w ? force : displacement;
  if (tangential == v) return sign * odd * vw[at];
  return displacement == w && !hoop.empty() ? -(uw[at] + hoop[at]) : sign * uw[at];
}

InfluenceTable InfluenceTable::reversed() const {
  InfluenceTable turned(reach_x_, reach_y_);
  const auto turn = [&](const std::vector<double>& from, std::vector<double>& to, double parity) {
    if (from.empty()) return;
    to.resize(from.size());
    for (int rows = 0; rows <= reach_y_; ++rows)
      for (int columns = -reach_x_; columns <= reach_x_; ++columns)
        to[static_cast<std::size_t>(index(columns, rows))] =
            parity * from[static_cast<std::size_t>(index(-columns, rows))];
  };
  turn(ww, turned.ww, 1);
  turn(uu, turned.uu, 1);
  turn(vv, turned.vv, 1);
  turn(uv, turned.uv, -1);
  turn(uw, turned.uw, -1);
  turn(vw, turned.vw, 1);
  turn(hoop, turned.hoop, -1);
  return turned;
}

InfluenceTable InfluenceTable::transposed() const {
  InfluenceTable other = reversed();
  for (std::size_t i = 0; i < other.hoop.size(); ++i) {
    other.uw[i] += other.hoop[i];
    other.hoop[i] = -other.hoop[i];
  }
  return other;
}

void InfluenceTable::add(const InfluenceTable& other, double cross) {
  const auto add_to = [](std::vector<double>& to, const std::vector<double>& from, double sign) {
    if (to.empty()) to.assign(from.size(), 0.0);
    for (std::size_t i = 0; i < from.size(); ++i) to[i] += sign * from[i];
  };
  add_to(ww, other.ww, 1);
  add_to(uu, other.uu, 1);
  add_to(vv, other.vv, 1);
  add_to(uv, other.uv, 1);
  add_to(uw, other.uw, cross);
  add_to(vw, other.vw, cross);
  add_to(hoop, other.hoop, cross);
}

namespace {

struct SurfaceKey {
  LayeredMedium medium;
  double wave_speed;  // 0 without inertia, whatever the speed
  bool operator==(const SurfaceKey&) const = default;
};

SurfaceKey surface_key(const ContactModel& model, const LayeredMedium& medium) {
  return {medium, model.inertia ? model.speed : 0};
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

/// What a coating whose table alone is this one adds to that of a surface.
InfluenceTable part_of_coating(const ContactModel& model, const InfluenceTable& alone) {
  InfluenceTable part(alone.reach_x(), alone.reach_y());
  part.add_coating(coating_remembers_ahead(model) ? alone.reversed() : alone);
  return part;
}

/// Of whatever is more than one layer of one material without inertia (`ContactModel::composite`).
InfluenceTable composite_table(const ContactModel& model, const SurfaceGrid& grid, int reach_x, int reach_y) {
  if (model.dimension == 2) return line_passage_table(model, grid, reach_x);
  const auto table_of = [&](const LayeredMedium& medium) {
    return sphere_table({surface_key(model, medium), model.speed, grid.spacing_x, grid.spacing_y, reach_x, reach_y});
  };
  InfluenceTable sum = *table_of(foundation_of(model));
  const LayeredMedium coating = coating_of(model);
  if (coating.empty()) return sum;
  const std::shared_ptr<const InfluenceTable> body = table_of(coating);
  sum.add_coating(coating_remembers_ahead(model) ? body->reversed() : *body);
  sum.coating = std::make_shared<const InfluenceTable>(part_of_coating(model, *body));
  return sum;
}

InfluenceTable passage_table(const ContactModel& model, const SurfaceGrid& grid, int reach_x, int reach_y) {
  if (model.composite()) return composite_table(model, grid, reach_x, reach_y);
  const double largest =
      std::max(reach_x * grid.spacing_x, std::isinf(model.top().layer_thickness) ? 0 : model.top().layer_thickness);
  const CreepSpectrum material = lumped(model.top().creep, memory_range(model.speed, grid.spacing_x, largest));
  return shared_passage_kernel(model.dimension, model.layer(), grid.spacing_x, grid.spacing_y, reach_x, reach_y)
      ->table(material, model.speed, reach_x, reach_y);
}

/// Without what all nodes move together: under a cylinder a half-space sinks without limit, by far more than the nodes
/// differ where it creeps a thousandfold.
InfluenceTable without_sinking(InfluenceTable table) {
  for (std::vector<double>* const component : {&table.ww, &table.uu, &table.vv}) {
    if (component->empty()) continue;
    const double least = *std::min_element(component->begin(), component->end());
    for (double& value : *component) value -= least;
  }
  return table;
}

/// All but a coating's part.
InfluenceTable surface_table(const ContactModel& model, const SurfaceGrid& grid) {
  const bool sphere = model.dimension == 3;
  const int reach_x = grid.columns, reach_y = sphere ? grid.rows : 0;
  if (model.period) {
    const SteadySurface surface = steady_surface(model);
    const auto symbols = [&surface](double along) -> SymbolsAcross {
      return
          [&surface, along, moduli = surface.moduli(along)](double across) { return surface(moduli, along, across); };
    };
    return periodic_table(symbols, *model.period, model.series_terms, grid.spacing_x, grid.spacing_y, reach_x, reach_y,
                          model.ring() && model.friction_coefficient > 0);
  }
  InfluenceTable table = passage_table(model, grid, reach_x, reach_y);
  if (!sphere && model.lateral()) table.vv = axial_coefficients(model, grid, reach_x);
  return sphere || has_rigid_base(model) ? table : without_sinking(std::move(table));
}

/// Of a coating alone. Bodies of a train have a coating each: a ring comes round after a turn, whatever the period, and
/// a flat coating never.
InfluenceTable coating_table(const ContactModel& model, const SurfaceGrid& grid) {
  ContactModel alone = coating_alone(model);
  if (model.period && model.ring()) {
    const double turn = 2 * M_PI * model.radius;
    alone.series_terms = static_cast<int>(std::ceil(model.series_terms * turn / *model.period));
    alone.period = turn;
  } else {
    alone.period.reset();
  }
  return surface_table(alone, grid);
}

}  // namespace

InfluenceTable influence_table(const ContactModel& model, const SurfaceGrid& grid) {
  if (model.coating.empty()) {
    InfluenceTable table = surface_table(model, grid);
    const LongWaveCorrection correction(steady_surface(model), grid);
    correction.add_to(table);
    table.steps = correction.share();
    return table;
  }
  const ContactModel foundation = foundation_alone(model);
  InfluenceTable table = surface_table(model.period ? foundation : model, grid);
  InfluenceTable part = table.coating ? *table.coating : part_of_coating(model, coating_table(model, grid));
  if (model.period) table.add(part);
  const LongWaveCorrection of_foundation(steady_surface(foundation), grid);
  const LongWaveCorrection of_coating(steady_surface(coating_alone(model)), grid, coating_remembers_ahead(model));
  of_foundation.add_to(table);
  of_coating.add_to(table);
  of_coating.add_to(part);
  table.steps = of_foundation.share_with(of_coating);
  table.coating = std::make_shared<const InfluenceTable>(std::move(part));
  return table;
}

double expansion_error(const ContactModel& model) {
  if (model.dimension == 2) return line_expansion_error(model);
  double error = sphere_passage(surface_key(model, foundation_of(model)))->error();
  if (const LayeredMedium coating = coating_of(model); !coating.empty())
    error = std::max(error, sphere_passage(surface_key(model, coating))->error());
  return error;
}

}  // namespace rollres
