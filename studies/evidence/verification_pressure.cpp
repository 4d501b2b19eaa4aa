#include <cmath>

#include "studies/evidence/verification_checks.hpp"

namespace rollres::verification {

namespace {

RollingScene pressed(double radius, double load) {
  RollingScene scene = on_half_space(Indenter::sphere);
  scene.indenter = Indenter::pressure;
  scene.kinematics = Kinematics::consistent;
  scene.radius = radius;
  scene.load = load;
  return scene;
}

BondedLayer elastic_layer(double thickness, double young, double poisson) {
  BondedLayer layer;
  layer.layer_thickness = thickness;
  layer.poisson_ratio = poisson;
  layer.material = MaterialModel::elastic;
  layer.static_shear_modulus = young / (2 * (1 + poisson));
  return layer;
}

}  // namespace

void check_given_pressures(Checks& checks) {
  constexpr double radius = 0.01, load = 100;
  const RollingScene disc = pressed(radius, load);
  const double yield = (1 - disc.poisson_ratio) / (2 * shear_modulus);  // (1 - nu^2)/E
  checks.add({"disc of pressure on a half-space: deflection of its middle", "Boussinesq (1885)", "m",
              2 * yield * load / (M_PI * radius), checks.solve(disc).deflection, 2e-5,
              "63 cells across, extrapolated"});
  RollingScene square = disc;
  square.pressure_shape = PressureShape::rectangle;
  checks.add({"square of pressure on a half-space: deflection of its middle", "Love (1929)", "m",
              2 * yield * load / (M_PI * radius) * std::log(1 + std::sqrt(2)), checks.solve(square).deflection, 2e-5,
              "63 cells across, extrapolated"});

  // A wheel on 150 mm of asphalt, taken as elastic, 600 mm of base and ground.
  RollingScene road = pressed(0.15, 1.1e6 * M_PI * 0.15 * 0.15);
  static_cast<MaterialInputs&>(road) = elastic_layer(0.15, 3e9, 0.3);
  road.layer_thickness = 0.15;
  road.lower_layers = {elastic_layer(0.6, 200e6, 0.35), elastic_layer(INFINITY, 40e6, 0.4)};
  road.deflection_places_x = {0, -1};
  road.deflection_places_y = {0.3, 0.3};
  const RollingSolution found = checks.solve(road);
  const auto deflection = [&](std::size_t place) {
    return place < found.deflections.size() ? found.deflections[place] : RollingSolution::absent;
  };
  constexpr const char *source = "Hankel's integral, by another program", *why = "its five digits";
  checks.add(
      {"disc of pressure on three layers: deflection beside it", source, "m", 0.80953e-3, deflection(0), 2e-5, why});
  checks.add(
      {"disc of pressure on three layers: deflection behind it", source, "m", 0.45250e-3, deflection(1), 3e-5, why});
}

}  // namespace rollres::verification
