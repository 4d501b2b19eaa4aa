#include "core/model/absent_outputs.hpp"

#include <cmath>

#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"

using namespace rollres;
using Catch::Matchers::Contains;

TEST_CASE("an output that no answer to a scene has is told with its reason, and no other", "[core][model]") {
  RollingScene scene = plain_scene();
  for (const char* const there : {"approach", "rolling_resistance", "peak_pressure", "contact_area"}) {
    CAPTURE(there);
    CHECK(why_absent(scene, there) == "");
    CHECK(why_absent(ContactModel(scene), there) == "");
  }
  CHECK(why_absent(scene, "half_width") == "a cylinder has none");
  CHECK(why_absent(scene, "bond_shear") == "interior = on computes it");
  CHECK(why_absent(scene, "bond_shears[1]") == "the scene has 1 layer: [0]");
  CHECK(why_absent(scene, "peak_temperature") == "heat = on computes it");
  CHECK(why_absent(scene, "softening") == "no layer's moduli depend on the strain");
  CHECK(why_absent(scene, "peak_deflection") == "indenter \"pressure\" has it");
  scene.interior = Interior::on;
  CHECK(why_absent(scene, "bond_shear") == "");
  scene.layer_thickness = INFINITY;
  CHECK_THAT(why_absent(scene, "approach"), Contains("sinks without limit"));
  CHECK_THAT(why_absent(ContactModel(scene), "approach"), Contains("sinks without limit"));
  scene.indenter = Indenter::sphere;
  CHECK(why_absent(scene, "approach") == "");
  CHECK(why_absent(scene, "half_width") == "");
  scene.indenter = Indenter::pressure;
  CHECK(why_absent(scene, "peak_deflection") == "");
  CHECK(why_absent(scene, "deflections") == "deflection_places_x is not given");
  CHECK(why_absent(scene, "approach") == "a given pressure has none");
}
