#include "core/surface/deep_response.hpp"
#include "core/surface/deep_medium.hpp"

#include <cmath>

#include "core/model/contact_surface.hpp"
#include "core/numerics/quadrature.hpp"
#include "core/spectral/spectral_problem.hpp"
#include "tests/catch.hpp"
#include "tests/core/paper_scenes.hpp"

using namespace rollres;

namespace {

RollingScene with_inertia(double poisson_ratio, double speed) {
  RollingScene scene = paper_cylinder();
  scene.spacing.reset();
  scene.poisson_ratio = poisson_ratio;
  scene.inertia = Inertia::on;
  scene.speed = speed;
  scene.material = MaterialModel::prony;
  scene.static_shear_modulus = 1e6;
  scene.relaxation_moduli = {2e6, 5e5};
  scene.relaxation_times = {1e-3, 1e-5};
  return scene;
}

}  // namespace

TEST_CASE("what short waves make of tractions with inertia is a sum over poles and cuts", "[core][deep_response]") {
  for (const double poisson_ratio : {0.5, 0.3, 0.0})
    for (const double speed : {1.0, 10.0, 20.0}) {
      const RollingScene scene = with_inertia(poisson_ratio, speed);
      const CreepSpectrum creep = near_spectrum(scene);
      const SpectralProblem problem(scene, creep, 3e-3);
      const SteadySurface surface = steady_surface(scene);
      for (const double k : {0.0, 0.3, 10.0, 300.0, 1e4, 1e7}) {
        const SurfaceCompliance c = surface.half_spaces(surface.moduli(k));
        const std::complex<double> d = creep(-k * speed);
        const Eigen::Array3cd exact(2.0 * c.normal / d, 2.0 * c.longitudinal / d, c.cross / d);
        INFO(poisson_ratio << " " << speed << " " << k);
        // The cuts by 10 points each; near the speed of Rayleigh waves they are as long as they are far away.
        CHECK((problem.deep->at(k) - exact).abs().maxCoeff() < 1e-9);
      }
    }
}

TEST_CASE("a half-space with inertia is a sum over retardation times of its own", "[core][deep_response]") {
  for (const double poisson_ratio : {0.5, 0.3, 0.0})
    for (const double speed : {1.0, 10.0, 20.0}) {
      const RollingScene scene = with_inertia(poisson_ratio, speed);
      const SteadySurface surface = steady_surface(scene);
      MediumLayer layer = foundation_of(scene).front();
      const std::vector<HalfSpaceTerm> terms = half_space_terms(layer, speed);
      REQUIRE(!terms.empty());
      for (const double k : {0.0, 0.3, 10.0, 300.0, 1e4, 1e7}) {
        Eigen::Array3cd sum = Eigen::Array3cd::Zero();
        for (const HalfSpaceTerm& term : terms) sum += term.compliances / std::complex<double>(1, -k * term.length);
        const SurfaceCompliance c = surface.half_spaces(surface.moduli(k));
        const Eigen::Array3cd exact(c.normal, c.longitudinal, c.cross);
        INFO(poisson_ratio << " " << speed << " " << k);
        CHECK((sum - exact).abs().maxCoeff() < 1e-8 * std::abs(c.normal));
      }
      layer.material.terms.push_back(layer.material.terms.front());
      CHECK(half_space_terms(layer, speed).empty());  // times that coincide are left to the expansion
    }
  RollingScene fast = with_inertia(0.5, 31);  // Rayleigh waves on the relaxed material: 0.955 sqrt(1e6/1000) = 30.2 m/s
  CHECK(half_space_terms(foundation_of(fast).front(), fast.speed).empty());
}

TEST_CASE("a half-space in slow motion remembers as without inertia", "[core][deep_response]") {
  // Reference: the closed form of an elastic half-space times the creep. Its waves are at the memories' own rates, to
  // 1e-9 of them and less: left out, the half-space forgets nothing.
  for (const double poisson_ratio : {0.5, 0.3})
    for (const double speed : {1e-3, 1e-4, 1e-5, 1e-8}) {
      const RollingScene scene = with_inertia(poisson_ratio, speed);
      const MediumLayer layer = foundation_of(scene).front();
      const LayerSymbols elastic = half_space_symbols(poisson_ratio);
      for (const double k : {0.0, 1e3 / speed, 1e5 / speed}) {
        Eigen::Array3cd sum = Eigen::Array3cd::Zero();
        for (const HalfSpaceTerm& term : half_space_terms(layer, speed))
          sum += term.compliances / std::complex<double>(1, -k * term.length);
        const Eigen::Array3cd exact =
            layer.material(-k * speed) * Eigen::Array3cd(elastic.normal, elastic.longitudinal, elastic.cross);
        INFO(poisson_ratio << " " << speed << " " << k);
        CHECK((sum - exact).abs().maxCoeff() / exact.abs().maxCoeff() < 1e-7);
      }
    }
}

TEST_CASE("a memory that hardly yields changes nothing of a half-space with inertia", "[core][deep_response]") {
  // Its waves are at its own rate to 1e-16, where they were looked for in vain and no scene had an answer.
  for (const double modulus : {1e-4, 1e-7, 1e-10}) {
    RollingScene scene = with_inertia(0.3, 20);
    const std::vector<HalfSpaceTerm> without = half_space_terms(foundation_of(scene).front(), scene.speed);
    scene.relaxation_moduli.push_back(modulus);
    scene.relaxation_times.push_back(1);
    const std::vector<HalfSpaceTerm> with = half_space_terms(foundation_of(scene).front(), scene.speed);
    REQUIRE(!with.empty());
    const auto sum = [](const std::vector<HalfSpaceTerm>& terms, double k) {
      Eigen::Array3cd all = Eigen::Array3cd::Zero();
      for (const HalfSpaceTerm& term : terms) all += term.compliances / std::complex<double>(1, -k * term.length);
      return all;
    };
    for (const double k : {0.0, 0.3, 300.0, 1e7}) {
      INFO(modulus << " Pa, " << k);
      CHECK((sum(with, k) - sum(without, k)).abs().maxCoeff() < 1e-8 * sum(without, k).abs().maxCoeff());
    }
  }
}

TEST_CASE("means of short waves' slopes are those that integration along the memory gives", "[core][deep_response]") {
  const SpectralProblem problem(with_inertia(0.3, 15), near_spectrum(with_inertia(0.3, 15)), 3e-3);
  const DeepResponse& deep = *problem.deep;
  const double length = 2e-3;
  for (const double x : {1e-3, 4e-3}) {
    LayerSlopes sum = LayerSlopes::Zero();
    const QuadratureRule& rule = gauss_rule(200);
    for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
      const double s = 40 * length * rule.nodes[q];
      const LayerSlopes at_once(-deep.normal() / (2 * M_PI * (x + s)), -deep.along() / (2 * M_PI * (x + s)), 0, 0);
      sum += 40 * rule.weights[q] * std::exp(-s / length) * (at_once + deep.slope(x + s));
    }
    const LayerSlopes mean = deep.mean(length, x);
    CHECK(mean(0) == Approx(sum(0)).epsilon(1e-10));
    CHECK(mean(1) == Approx(sum(1)).epsilon(1e-10));
    // -d/dx of a displacement is the slope: here by a central difference.
    const double step = 1e-6;
    const LayerSlopes rise = (deep.displacement(x + step) - deep.displacement(x - step)) / (2 * step);
    const LayerSlopes slope = deep.slope(x);
    CHECK(rise(0) == Approx(slope(0) - deep.normal() / (2 * M_PI * x)).epsilon(1e-6));
  }
}
