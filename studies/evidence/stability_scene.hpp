#pragma once

/// Random scenes that try a method: each is a function of a seed, an indenter and its number alone, the same on any
/// machine and for any number of scenes.
///
/// Log-uniform: R 5-200 mm, H 1 mm-0.2 m, G0 0.1-100 MPa, f 0.01-100, τ 10 µs-10 s, V 0.1 mm/s-30 m/s, μ 0.005-2, and
/// the half-width of the contact that the load gives a layer of modulus G0, from R/100 to R/3. The spacing puts 20 to
/// 60 nodes along a cylinder's contact and 12 to 24 along a sphere's, as estimated with the modulus at the frequency V
/// / half-width. Each sixth of the scenes has another drive: top force, torque (uniform, up to 1.2 μ P R either way),
/// free rolling, rotation about rolling (R Ω/V = 1 ± 1e-6 to 0.3), a locked body (0), full sliding (2 to 100 either
/// way). A sixth has a compressible layer (ν up to 0.49), a sixth a second layer below the first, a sixth a coating.
/// Every second scene has materials with wide spectra instead (random_material.hpp), in a half of them also other
/// layers: a half-space, alone or below, two or three layers below, one or two coatings; its load is then that of the
/// modulus at the contact's frequency.
/// Numbers have four digits, so that the last bit of a machine's logarithm does not matter.

#include <cstdint>

#include "core/scene/scene.hpp"
#include "studies/run/forked_work.hpp"

namespace rollres {

/// Which materials random scenes have.
enum class Spectra {
  both,   ///< one or the other, by lot
  zener,  ///< Zener solids, in all layers
  wide    ///< materials with memories over many decades
};
template <>
struct ChoiceNames<Spectra> {
  static constexpr std::array<std::string_view, 3> names{"both", "zener", "wide"};
};

RollingScene stability_scene(Indenter indenter, std::uint64_t seed, std::size_t number,
                             Spectra spectra = Spectra::both);

/// How many of them are tried, and how: each in a child process, so that one that crashes costs itself alone.
struct RandomScenes {
  std::size_t cylinders = 0, spheres = 0;
  std::uint64_t seed = 1;
  Spectra spectra = Spectra::both;
  int jobs = 0;                                           ///< child processes; 0: one for each core
  double time_limit = 600;                                ///< for one scene [s]
  const std::atomic<bool>* stop = nullptr;                ///< set from outside: return what there is
  std::function<void(const SweepProgress&)> report = {};  ///< called ten times a second

  /// Work in so many pieces under these limits; what a piece is, is left open.
  ForkedWork work(std::size_t pieces) const {
    return {.pieces = pieces, .jobs = jobs, .time_limit = time_limit, .report = report, .stop = stop};
  }
};

}  // namespace rollres
