#include "studies/evidence/stability_scene.hpp"

#include <charconv>
#include <cmath>
#include <random>

#include "core/estimate/grid_choice.hpp"
#include "core/numerics/bracketed_root.hpp"

namespace rollres {

namespace {

/// Four significant digits, the same for two numbers that differ in their last bits.
double rounded(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, 3).ptr;
  double result = 0;
  std::from_chars(text, end, result);
  return result;
}

/// Numbers from the bits of the Mersenne twister, whose sequence the standard fixes (that of its distributions it does
/// not).
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : bits_(seed) {}

  double uniform(double from, double to) { return from + (to - from) * part(); }
  double log_uniform(double from, double to) { return rounded(from * std::pow(to / from, part())); }
  int choice(int count) { return static_cast<int>(part() * count); }
  double signed_log_uniform(double from, double to) {
    const double magnitude = log_uniform(from, to);
    return part() < 0.5 ? -magnitude : magnitude;
  }

 private:
  double part() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }  // [0, 1)

  std::mt19937_64 bits_;
};

/// Spreads neighbouring numbers over all seeds: the last step of splitmix64 (Steele, Lea and Flood 2014).
std::uint64_t mixed(std::uint64_t bits) {
  bits += 0x9e3779b97f4a7c15u;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

/// The load under which the contact of an elastic layer has a given half-width.
double load_for(const RollingScene& scene, double half_width) {
  const auto excess = [&](double log_load) {
    const ContactEstimate found = elastic_contact_from_load(scene.indenter, scene.radius, scene.layer_thickness,
                                                            *scene.static_shear_modulus, std::exp(log_load));
    return std::log(found.half_width / half_width);
  };
  double low = std::log(*scene.static_shear_modulus * half_width * half_width / scene.radius *
                        (scene.indenter == Indenter::sphere ? half_width : 1));
  double high = low;
  while (excess(low) > 0) low -= 1;
  while (excess(high) < 0) high += 1;
  return std::exp(bracketed_root(excess, low, high, 1e-10));
}

}  // namespace

RollingScene stability_scene(Indenter indenter, std::uint64_t seed, std::size_t number) {
  Dice dice(mixed(mixed(mixed(seed) + static_cast<std::uint64_t>(indenter)) + number));
  const bool sphere = indenter == Indenter::sphere;
  RollingScene scene;
  scene.indenter = indenter;
  scene.radius = dice.log_uniform(5e-3, 0.2);
  scene.layer_thickness = dice.log_uniform(1e-3, 0.2);
  scene.static_shear_modulus = dice.log_uniform(1e5, 1e8);
  scene.stiffening = dice.log_uniform(0.01, 100);
  scene.creep_time = dice.log_uniform(1e-5, 10);
  scene.speed = dice.log_uniform(1e-4, 30);
  scene.friction_coefficient = dice.log_uniform(0.005, 2);
  scene.load = rounded(load_for(scene, dice.log_uniform(scene.radius / 100, scene.radius / 3)));
  const double nodes = dice.log_uniform(sphere ? 12 : 20, sphere ? 24 : 60);
  switch (dice.choice(6)) {
    case 0:
      scene.drive = Drive::top_force;
      break;
    case 1:
      scene.drive = Drive::torque;
      scene.driving_torque = rounded(dice.uniform(-1.2, 1.2) * scene.friction_coefficient * *scene.load * scene.radius);
      break;
    case 2:
      scene.drive = Drive::free;
      break;
    case 3:
      scene.drive = Drive::rotation;
      scene.rotation_ratio = 1 + dice.signed_log_uniform(1e-6, 0.3);
      break;
    case 4:
      scene.drive = Drive::rotation;
      scene.rotation_ratio = 0;
      break;
    default:
      scene.drive = Drive::rotation;
      scene.rotation_ratio = dice.signed_log_uniform(2, 100);
      break;
  }
  const auto second_layer = [&](double thickness) {
    BondedLayer layer;
    layer.poisson_ratio = dice.choice(2) == 0 ? 0.5 : 0.3;
    layer.static_shear_modulus = dice.log_uniform(0.3, 30) * *scene.static_shear_modulus;
    layer.stiffening = dice.log_uniform(0.01, 100);
    layer.creep_time = dice.log_uniform(0.01, 100) * scene.creep_time;
    layer.layer_thickness = rounded(thickness);
    return layer;
  };
  switch (dice.choice(6)) {  // half of the scenes have one incompressible layer
    case 0:
      scene.poisson_ratio = rounded(dice.uniform(0, 0.49));
      break;
    case 1:
      scene.lower_layers = {second_layer(dice.log_uniform(0.3, 3) * scene.layer_thickness)};
      break;
    case 2:
      scene.coating_layers = {second_layer(dice.log_uniform(0.03, 0.3) * scene.radius)};
      break;
  }
  scene.spacing = rounded(2 * estimate_contact(scene).half_width / nodes);
  return scene;
}

}  // namespace rollres
