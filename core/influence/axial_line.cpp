#include "core/influence/axial_line.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <span>
#include <utility>

#include "core/influence/influence.hpp"
#include "core/influence/passage_kernel.hpp"
#include "core/material/lumped_spectrum.hpp"
#include "core/model/contact_surface.hpp"
#include "core/surface/earlier_turns.hpp"
#include "core/surface/fourier_table.hpp"
#include "core/surface/medium_expansion.hpp"

namespace rollres {

namespace {

using complex = std::complex<double>;

/// Creep of the half-space of the first layer.
CreepSpectrum near_creep(const LayeredMedium& medium, double wave_speed) {
  MediumLayer top = medium.front();
  if (wave_speed == 0) return top.material;
  top.thickness = INFINITY;
  const MediumExpansion expansion({top}, wave_speed);
  CreepSpectrum creep;
  for (const MediumTerm& term : expansion.terms())
    if (term.time == 0)
      creep.instantaneous += term.deep.transverse;
    else
      creep.terms.push_back({term.deep.transverse, term.time});
  return creep;
}

/// What the layers add to the half-spaces', of a line force spread over a cell.
class AddedAlongAxle {
 public:
  AddedAlongAxle(const ContactModel& model, double cell, const MemoryRange& told_apart)
      : surface_(steady_surface(model, told_apart)),
        depth_(nearest_interface(model)),
        cell_(cell),
        lacking_((surface_.half_spaces(surface_.moduli(0)).transverse - surface_.long_waves().transverse).real()),
        table_(1, 1, 0.1 * depth_ / surface_.longest_wave(),
               [this](double wavenumber, std::span<complex> values) { values[0] = transform(wavenumber); }) {}
  AddedAlongAxle(const AddedAlongAxle&) = delete;
  AddedAlongAxle& operator=(const AddedAlongAxle&) = delete;

  double operator()(double x) const {
    return table_(0, x / depth_)(0) + lacking_ * std::log(x * x + 4 * depth_ * depth_) / (2 * M_PI);
  }

 private:
  complex transform(double k) const {
    const double along = k / depth_;
    const SteadySurface::Moduli moduli = surface_.moduli(along);
    const complex added = along * surface_(moduli, along, 0).transverse - surface_.half_spaces(moduli).transverse;
    return (average_over_cell(along, cell_) * added + std::exp(-2 * k) * lacking_) / (M_PI * k);
  }

  SteadySurface surface_;
  double depth_, cell_;
  double lacking_;  // of long waves against the half-spaces at rest, times the wavenumber [1/Pa]
  FourierTable table_;
};

/// What a ring still has of earlier turns.
void add_turns_along_axle(InfluenceTable& table, const ContactModel& model, double cell) {
  const SteadySurface surface = ring_alone(model);
  const EarlierTurns turns(model.radius, surface.longest_wave(), 1, 1, [&](double along, std::span<complex> values) {
    values[0] = surface(surface.moduli(along), along, 0).transverse / M_PI;
  });
  InfluenceTable earlier(table.reach_x(), 0);
  for (int column = -table.reach_x(); column <= table.reach_x(); ++column)
    earlier.ww[static_cast<std::size_t>(table.index(column, 0))] = turns(0, column * cell)(0);
  table.add_coating(coating_remembers_ahead(model) ? earlier.reversed() : earlier);
}

}  // namespace

std::vector<double> axial_coefficients(const ContactModel& model, const SurfaceGrid& grid, int reach_x) {
  const double cell = grid.spacing_x, wave_speed = model.inertia ? model.speed : 0;
  const MemoryRange told_apart = memory_range(model.speed, cell, std::max(reach_x * cell, finite_thickness(model)));
  const auto of_layer = [&](const Layer& layer, const CreepSpectrum& creep) {
    return shared_passage_kernel(1, layer, cell, grid.spacing_y, reach_x, 0)->table(creep, model.speed, reach_x, 0);
  };
  if (!model.composite()) return of_layer(model.layer(), lumped(model.top().creep, told_apart)).ww;
  InfluenceTable table(reach_x, 0);
  const auto add = [&](const LayeredMedium& medium, bool ahead) {
    if (medium.empty()) return;
    const InfluenceTable near = of_layer(Layer(INFINITY, 0.5), near_creep(medium, wave_speed));
    table.add_coating(ahead ? near.reversed() : near);
  };
  add(foundation_of(model, told_apart), false);
  add(coating_of(model, told_apart), coating_remembers_ahead(model));
  if (std::isfinite(nearest_interface(model))) {
    const AddedAlongAxle added(model, cell, told_apart);
    for (int column = -reach_x; column <= reach_x; ++column)
      table.ww[static_cast<std::size_t>(table.index(column, 0))] += added(column * cell);
  }
  if (feels_earlier_turns(model)) add_turns_along_axle(table, model, cell);
  return std::move(table.ww);
}

}  // namespace rollres
