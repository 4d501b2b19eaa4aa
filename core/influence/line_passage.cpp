#include "core/influence/line_passage.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/influence/passage_kernel.hpp"
#include "core/numerics/quadrature.hpp"
#include "core/numerics/recently_made.hpp"
#include "core/surface/deep_medium.hpp"
#include "core/surface/earlier_turns.hpp"
#include "core/surface/fourier_table.hpp"
#include "core/surface/medium_expansion.hpp"
#include "core/surface/ring_curvature.hpp"

namespace rollres {

namespace {

using complex = std::complex<double>;

/// What the half-spaces next to the contact remember, as spectra of creep in shear of half-spaces that yield as much:
/// incompressible ones, and for the cross term one with Poisson's ratio 0.
struct NearSpectra {
  CreepSpectrum normal, longitudinal, cross;
  double error = 0;

  /// @param deep k c of the half-space [1/Pa]   @param time of its memory [s]; 0: at once
  void add(double time, const Eigen::Array3d& deep, double cross_sign) {
    const auto put = [&](CreepSpectrum& spectrum, double compliance) {
      if (time == 0)
        spectrum.instantaneous += compliance;
      else
        spectrum.terms.push_back({compliance, time});
    };
    put(normal, 2 * deep(0));
    put(longitudinal, 2 * deep(1));
    if (deep(2) != 0) put(cross, -2 * cross_sign * deep(2));
  }

  /// Without inertia each term of creep is a half-space of its own.
  void add(const MediumLayer& top, double cross_sign) {
    const LayerSymbols symbols = half_space_symbols(top.poisson_ratio);
    const Eigen::Array3d deep(symbols.normal, symbols.longitudinal, symbols.cross);
    add(0, top.material.instantaneous * deep, cross_sign);
    for (const CreepSpectrum::Term& term : top.material.terms) add(term.time, term.compliance * deep, cross_sign);
  }

  void add(const LayeredMedium& medium, double wave_speed, double cross_sign) {
    if (medium.empty()) return;
    MediumLayer top = medium.front();
    if (wave_speed == 0) return add(top, cross_sign);
    top.thickness = INFINITY;
    // A few materials' terms are exact; of many, and near the speed of Rayleigh waves, fewer times stand for all.
    if (constexpr std::size_t few = 8; top.material.terms.size() <= few)
      if (const std::vector<HalfSpaceTerm> terms = half_space_terms(top, wave_speed); !terms.empty()) {
        for (const HalfSpaceTerm& term : terms) add(term.length / wave_speed, term.compliances, cross_sign);
        return;
      }
    const MediumExpansion expansion({top}, wave_speed);
    for (const MediumTerm& term : expansion.terms())
      add(term.time, {term.deep.normal, term.deep.longitudinal, term.deep.cross}, cross_sign);
    error = std::max(error, expansion.error());
  }
};

struct NearSpectraKey {
  LayeredMedium foundation, coating;
  double wave_speed;  // 0 without inertia, whatever the speed
  bool operator==(const NearSpectraKey&) const = default;
};

/// The same for all grids of a scene.
std::shared_ptr<const NearSpectra> near_spectra(const ContactModel& model, const LayeredMedium& foundation,
                                                const LayeredMedium& coating) {
  static RecentlyMade<NearSpectraKey, NearSpectra, 16> cache;
  const NearSpectraKey key{foundation, coating, model.inertia ? model.speed : 0};
  return cache(key, [&] {
    NearSpectra spectra;
    spectra.add(key.foundation, key.wave_speed, 1);
    spectra.add(key.coating, key.wave_speed, -1);
    return spectra;
  });
}

/// Inputs of what the layers add to the displacements under a line force.
struct AddedKey {
  SteadySurface surface;
  double depth;  // of the nearest interface [m]
  bool sheared;  // whether shear tractions act, which bend a ring

  AddedKey(const ContactModel& model, const MemoryRange& told_apart)
      : surface(steady_surface(model, told_apart)),
        depth(nearest_interface(model)),
        sheared(model.friction_coefficient > 0) {}
  bool operator==(const AddedKey&) const = default;
};

/// What the layers add to the displacements under a line force.
class AddedDisplacements {
 public:
  explicit AddedDisplacements(const AddedKey& key)
      : surface_(key.surface),
        depth_(key.depth),
        at_rest_(surface_.half_spaces(surface_.moduli(0))),
        long_waves_(surface_.long_waves()),
        pressed_(surface_.curvature(RingCurvature::Of::pressure)),
        sheared_(key.sheared ? surface_.curvature(RingCurvature::Of::shear) : RingCurvature()),
        table_(1, sheared_.none() ? 3 : 4, 0.1 * depth_ / surface_.longest_wave(),
               [this](double wavenumber, std::span<complex> values) { transform(wavenumber, values); }) {}
  AddedDisplacements(const AddedDisplacements&) = delete;
  AddedDisplacements& operator=(const AddedDisplacements&) = delete;

  /// At distances from the force. Threads wait for each other, as tables are made where they are asked for.
  std::vector<LayerSlopes> operator()(std::span<const double> distances) const { return averages(distances, 0); }

  /// The same of a force that is spread over a cell.
  std::vector<LayerSlopes> averages(std::span<const double> distances, double cell) const {
    const std::lock_guard lock(mutex_);
    std::vector<LayerSlopes> all;
    for (const double x : distances) {
      LayerSlopes sum = cell > 0 ? average(x - 0.5 * cell, x + 0.5 * cell) : smooth(x);
      if (!pressed_.none()) sum(layer_slope::normal) += pressed_.displacement(x);
      if (!sheared_.none()) sum(layer_slope::hoop) += sheared_.displacement(x);
      all.push_back(sum);
    }
    return all;
  }

 private:
  /// By Gauss rules to 1e-13 for what is singular at +-2i depths: one over a cell below 2 depths, else on panels that
  /// widen with the distance from 0.
  LayerSlopes average(double from, double to) const {
    const double cell = to - from, nearest = 2 * depth_;
    constexpr int nodes_of_panel = 14;
    const bool whole = cell < nearest;
    const int nodes = whole ? static_cast<int>(std::ceil(15 / std::asinh(2 * nearest / cell))) : nodes_of_panel;
    const QuadratureRule& rule = gauss_rule(nodes);
    LayerSlopes sum = LayerSlopes::Zero();
    for (double start = from, end = to; start < to; start = end) {
      const double widest = start < 0 ? 0.5 * (nearest - start) : nearest + start;
      end = whole ? to : std::min(to, start + widest);
      for (std::size_t q = 0; q < rule.nodes.size(); ++q)
        sum += rule.weights[q] * (end - start) / cell * smooth(start + (end - start) * rule.nodes[q]);
    }
    return sum;
  }

  /// But for what short waves see of a ring's curvature.
  LayerSlopes smooth(double x) const {
    LayerSlopes sum = table_(0, x / depth_);
    const double logarithm = std::log(x * x + 4 * depth_ * depth_) / (2 * M_PI);
    sum(layer_slope::normal) += (at_rest_.normal - long_waves_.normal).real() * logarithm;
    sum(layer_slope::tangential) += (at_rest_.longitudinal - long_waves_.longitudinal).real() * logarithm;
    if (!pressed_.none()) sum(layer_slope::normal) += pressed_.at_rest() * logarithm;
    return sum;
  }

  /// The integrand of (K9). Long waves are taken out of it as e^{-2k}/k, whose transform is the logarithm.
  void transform(double k, std::span<complex> values) const {
    constexpr complex i(0, 1);
    const double along = k / depth_;
    const SteadySurface::Moduli moduli = surface_.moduli(along);
    const SurfaceCompliance c = surface_(moduli, along, 0), deep = surface_.half_spaces(moduli);
    const double fade = std::exp(-2 * k), scale = 1 / (M_PI * k);
    values[0] = scale * (along * c.normal - deep.normal - pressed_(along) +
                         fade * (at_rest_.normal - long_waves_.normal + pressed_.at_rest()));
    values[1] = scale * (along * c.longitudinal - deep.longitudinal +
                         fade * (at_rest_.longitudinal - long_waves_.longitudinal));
    values[2] = i * scale * (along * c.cross - deep.cross);
    if (values.size() > 3) values[3] = i * scale * (along * c.hoop - sheared_(along));
  }

  SteadySurface surface_;
  double depth_;
  SurfaceCompliance at_rest_, long_waves_;
  RingCurvature pressed_, sheared_;  // of a ring's short waves: taken out of the transform
  FourierTable table_;
  mutable std::mutex mutex_;
};

/// The same for all grids of a scene, and for all scenes that differ in load, friction or body.
std::shared_ptr<const AddedDisplacements> added_displacements(const AddedKey& key) {
  static RecentlyMade<AddedKey, std::unique_ptr<const AddedDisplacements>, 16> cache;
  const auto kept = cache(key, [&] { return std::make_unique<const AddedDisplacements>(key); });
  return {kept, kept->get()};
}

struct TurnsKey {
  SteadySurface surface;
  double radius;  // [m]
  bool sheared;
  bool operator==(const TurnsKey&) const = default;
};

/// Displacements by earlier turns, the same for all grids of a scene: under shear w in place of the cross term. Along
/// the surface they count from the force, as they are displaced by the mean of all turns besides.
std::shared_ptr<const EarlierTurns> earlier_turns(const ContactModel& model) {
  static RecentlyMade<TurnsKey, EarlierTurns, 16> cache;
  const TurnsKey key{ring_alone(model), model.radius, model.friction_coefficient > 0};
  return cache(key, [&] {
    const SteadySurface& surface = key.surface;
    const auto displacements = [&](double along, std::span<complex> values) {
      constexpr complex i(0, 1);
      const SurfaceCompliance c = surface(surface.moduli(along), along, 0);
      values[0] = c.normal / M_PI;
      values[1] = c.longitudinal / M_PI;
      values[2] = i * (key.sheared ? c.cross + c.hoop : c.cross) / M_PI;
      if (key.sheared) values[3] = i * c.hoop / M_PI;
    };
    return EarlierTurns(key.radius, surface.longest_wave(), 1, key.sheared ? 4 : 3, displacements, key.sheared ? 3 : 2);
  });
}

/// Adds what rings have not recovered from in a turn.
void add_earlier_turns(InfluenceTable& table, const ContactModel& model, double cell) {
  if (!feels_earlier_turns(model)) return;
  const bool alone = model.coating.empty();
  const int reach = table.reach_x();
  const auto turns = earlier_turns(model);
  InfluenceTable earlier(reach, 0);
  earlier.bend();
  for (int column = -reach; column <= reach; ++column) {
    const auto at = static_cast<std::size_t>(table.index(column, 0));
    LayerSlopes values = (*turns)(0, column * cell);
    values(layer_slope::cross) -= values(layer_slope::hoop);
    earlier.ww[at] = values(layer_slope::normal);
    earlier.uu[at] = values(layer_slope::tangential);
    earlier.uw[at] = values(layer_slope::cross) * (alone ? -1 : 1);
    earlier.hoop[at] = values(layer_slope::hoop) * (alone ? -1 : 1);
  }
  table.add_coating(coating_remembers_ahead(model) ? earlier.reversed() : earlier);
}

/// A length in steps of 64 from a unit, which grids share that are some halvings apart. @param round up or down
double shared_length(double length, double unit, double (*round)(double)) {
  return unit * std::exp2(6 * round(std::log2(length / unit) / 6));
}

}  // namespace

double line_expansion_error(const ContactModel& model) {
  return model.inertia ? near_spectra(model, foundation_of(model), coating_of(model))->error : 0;
}

InfluenceTable line_passage_table(const ContactModel& model, const SurfaceGrid& grid, int reach_x) {
  const double cell = grid.spacing_x;
  const auto half_spaces = [&](const LayeredMedium& foundation, const LayeredMedium& coating) {
    const std::shared_ptr<const NearSpectra> near = near_spectra(model, foundation, coating);
    const auto half_space = [&](double poisson_ratio, const CreepSpectrum& spectrum) {
      return shared_passage_kernel(2, Layer(INFINITY, poisson_ratio), cell, grid.spacing_y, reach_x, 0)
          ->table(spectrum, model.speed, reach_x, 0);
    };
    InfluenceTable table = half_space(0.5, near->normal);
    if (near->longitudinal != near->normal) table.uu = half_space(0.5, near->longitudinal).uu;
    table.uw = half_space(0, near->cross).uw;
    return table;
  };
  const bool ahead = coating_remembers_ahead(model);
  const double depth = nearest_interface(model), unit = std::isfinite(depth) ? depth : cell;
  const double finest = shared_length(cell, unit, std::floor),
               farthest = shared_length(reach_x * cell, unit, std::ceil);
  const MemoryRange told_apart = memory_range(model.speed, finest, std::max(farthest, finite_thickness(model)));
  const LayeredMedium coating = coating_of(model, told_apart);
  InfluenceTable table = half_spaces(foundation_of(model, told_apart), ahead ? LayeredMedium{} : coating);
  if (ahead) table.add_coating(half_spaces(coating, {}).reversed());
  if (std::isinf(depth)) return table;
  const bool sheared_ring = model.ring() && model.friction_coefficient > 0;
  if (sheared_ring) table.bend();
  std::vector<double> distances;
  for (int column = -reach_x; column <= reach_x; ++column) distances.push_back(column * cell);
  const std::vector<LayerSlopes> added = added_displacements({model, told_apart})->averages(distances, cell);
  for (int column = -reach_x; column <= reach_x; ++column) {
    const auto at = static_cast<std::size_t>(table.index(column, 0));
    const LayerSlopes& values = added[static_cast<std::size_t>(column + reach_x)];
    table.ww[at] += values(layer_slope::normal);
    table.uu[at] += values(layer_slope::tangential);
    table.uw[at] += values(layer_slope::cross);
    if (sheared_ring) table.hoop[at] += values(layer_slope::hoop);
  }
  add_earlier_turns(table, model, cell);
  return table;
}

}  // namespace rollres
