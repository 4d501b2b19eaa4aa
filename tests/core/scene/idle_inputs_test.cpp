#include "core/scene/idle_inputs.hpp"

#include "core/scene/layer_name.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

// Covers layer_name, too.

using namespace rollres;

TEST_CASE("inputs of other materials, of no softening and of other methods are idle", "[core][scene_input]") {
  RollingScene scene = paper_cylinder();
  for (const char* const key : {"fractional_order", "listed_moduli", "payne_drop", "payne_exponent", "sweep_amplitude",
                                "yeoh_third", "series_terms", "slip_stencil", "slip_rule", "resticking"})
    CHECK(is_idle(scene, key));
  for (const char* const key : {"radius", "static_shear_modulus", "stiffening", "creep_time", "poisson_ratio", "load",
                                "interior", "friction_coefficient"})
    CHECK_FALSE(is_idle(scene, key));
  scene.material = MaterialModel::elastic;
  CHECK(is_idle(scene, "creep_time"));
  scene.material = MaterialModel::fractional_zener;
  scene.payne_drop = 0.5;
  scene.yeoh_second = 0.1;
  scene.period = 0.1;
  scene.method = Method::active_set;
  for (const char* const key :
       {"fractional_order", "payne_exponent", "payne_drop", "yeoh_third", "series_terms", "slip_stencil", "resticking"})
    CHECK_FALSE(is_idle(scene, key));
  scene.coating_layers.resize(1);
  scene.coating_layers[0].material = MaterialModel::elastic;
  CHECK(is_idle(scene, "coating_layers[0].stiffening"));
  CHECK_FALSE(is_idle(scene, "coating_layers[0].layer_thickness"));
}

TEST_CASE("what is idle changes no digit of an answer", "[core][scene_input]") {
  const RollingScene scene = paper_cylinder();
  RollingScene other = scene;
  other.fractional_order = 0.5;
  other.listed_moduli = ListedModuli::young;
  other.payne_exponent = 2;
  other.payne_strain = 0.1;
  other.sweep_deformation = SweepDeformation::tension;
  other.sweep_amplitude = SweepAmplitude::peak_to_peak;
  other.series_terms = 8;
  other.slip_stencil = SlipStencil::central;
  other.slip_threshold = 1;
  other.resticking = Resticking::off;
  other.slip_rule = SlipRule::printed;
  visit_inputs(other, [&](const Quantity& quantity, const auto& value) {
    bool same = true;
    visit_inputs(scene, [&](const Quantity& q, const auto& before) {
      using Value = std::decay_t<decltype(value)>;
      if constexpr (std::is_same_v<Value, std::decay_t<decltype(before)>>)
        if (q.key == quantity.key) same = value == before;
    });
    INFO(quantity.key);
    CHECK((same || is_idle(other, quantity.key)));
  });
  CHECK(solve(other).rolling_resistance == solve(scene).rolling_resistance);
}

TEST_CASE("layers have names that count as their keys do", "[core][scene_input]") {
  CHECK(layer_name(false, 0) == "layer");
  CHECK(layer_name(false, 1) == "lower layer [0]");
  CHECK(layer_name(true, 0) == "coating [0]");
}
