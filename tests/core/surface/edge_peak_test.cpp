#include "core/surface/edge_peak.hpp"

#include <algorithm>
#include <cmath>

#include "core/solve/model_notes.hpp"
#include "core/solve/rolling_contact.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

TEST_CASE("a rise at an end counts as unresolved where it falls again within the cells given", "[core][edge_peak]") {
  const auto said = [](const std::vector<double>& sizes, std::size_t cells) {
    return !unresolved_peak("peak_pressure", *std::max_element(sizes.begin(), sizes.end()), sizes, cells, "grid",
                            "spacing")
                .empty();
  };
  CHECK(said({4, 9, 5, 6, 7, 6, 5, 3, 1}, 2));
  CHECK(said({1, 3, 5, 6, 7, 6, 5, 9, 4}, 2));
  CHECK(said({1, 4, 9, 5, 6, 7, 6, 5, 3}, 3));
  CHECK(!said({1, 4, 9, 5, 6, 7, 6, 5, 3}, 2));
  CHECK(!said({4, 4.2, 4.1, 8, 12, 9, 6, 3, 1}, 2));  // of less than half the peak
  CHECK(!said({1, 2, 3, 4, 5, 4, 3, 2, 1}, 2));
  CHECK(!said({2, 1}, 2));
}

TEST_CASE("a peak at the contact's edge that a grid does not resolve is said, and one that it does is not",
          "[core][edge_peak]") {
  RollingScene scene = paper_cylinder();
  scene.spacing.reset();
  scene.kinematics = Kinematics::consistent;
  scene.radius = 0.01;
  scene.layer_thickness = 2e-3;
  scene.static_shear_modulus = 1e6;
  scene.stiffening = 36;
  scene.creep_time = 0.014;
  scene.speed = 3e-3;
  scene.load.reset();
  scene.approach = 5e-6;
  scene.friction_coefficient = 0;
  const auto warned = [](const RollingSolution& solution, const char* output) {
    return std::any_of(solution.warnings.begin(), solution.warnings.end(), [&](const std::string& warning) {
      return warning.starts_with(std::string(output) + " may be off by 10 % or more");
    });
  };
  const double peak = solve(with_method(scene, Method::spectral)).peak_pressure;
  scene.method = Method::newton;
  const RollingSolution coarse = solve(scene);
  CHECK(std::abs(coarse.peak_pressure / peak - 1) > 0.05);
  CHECK(warned(coarse, "peak_pressure"));
  const auto cure = [&](const RollingScene& of) {
    for (const std::string& warning : warnings_for(ContactModel(of), coarse, {}))
      if (warning.starts_with("peak_pressure may be off")) return warning.substr(warning.find("; "));
    return std::string();
  };
  RollingScene tolerant = scene;
  tolerant.tolerance = 0.01;
  CHECK(cure(tolerant) == "; take a smaller tolerance");
  tolerant.tolerance.reset();
  tolerant.spacing = 1e-5;
  CHECK(cure(tolerant) == "; take a smaller spacing");
  scene.spacing = 4e-7;
  const RollingSolution fine = solve(scene);
  CHECK(fine.peak_pressure == Approx(peak).epsilon(5e-3));
  CHECK(!warned(fine, "peak_pressure"));

  scene.radius = 0.24;
  scene.layer_thickness = 0.0286;
  scene.stiffening = 4;
  scene.creep_time = 1.1e-3;
  scene.speed = 1.1;
  scene.approach = 3.1e-4;
  scene.friction_coefficient = 0.3;
  scene.drive = Drive::free;
  scene.inertia = Inertia::off;
  scene.spacing.reset();
  const RollingSolution sheared = solve(scene);
  CHECK(sheared.peak_shear_x < 0.5 * solve(with_method(scene, Method::spectral)).peak_shear_x);
  CHECK(warned(sheared, "peak_shear_x"));
  CHECK(!warned(sheared, "peak_pressure"));
  CHECK(solve(with_method(paper_cylinder(), Method::newton)).warnings.empty());
}
