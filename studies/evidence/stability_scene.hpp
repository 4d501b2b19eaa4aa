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
/// Numbers have four digits, so that the last bit of a machine's logarithm does not matter.

#include <cstddef>
#include <cstdint>

#include "core/scene/scene.hpp"

namespace rollres {

RollingScene stability_scene(Indenter indenter, std::uint64_t seed, std::size_t number);

}  // namespace rollres
