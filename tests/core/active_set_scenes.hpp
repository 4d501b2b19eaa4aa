#pragma once

// Scenes and evidence shared by the tests of the paper's algorithms.

#include "core/estimate/grid_choice.hpp"
#include "core/newton/contact_problem.hpp"
#include "core/newton/grid_solution.hpp"
#include "core/paper_method/active_set.hpp"
#include "tests/core/paper_scenes.hpp"

namespace rollres::test {

/// Zehil and Gavin (2013), sections 5.1 and 5.2.
inline RollingScene paper_scene(Indenter indenter) {
  return with_method(indenter == Indenter::cylinder ? paper_cylinder() : paper_sphere(), Method::active_set);
}

struct Solved {
  ContactState state;
  RollingSolution solution;  // resultants and law_violation, recomputed from the tractions
  SurfaceGrid grid;
  InfluenceTable table;
};

inline Solved solve_on(const RollingScene& scene, double half_width) {
  const bool sphere = scene.indenter == Indenter::sphere;
  const SurfaceGrid half = window(dimension_of(scene.indenter), *scene.spacing, half_width);
  Solved solved;
  solved.grid = mirrored(half);
  solved.table = influence_table(scene, solved.grid);
  solved.state = solve_active_set(scene, solved.table, solved.grid);
  const ContactState& state = solved.state;
  ContactUnknowns unknowns;
  unknowns.pressure = state.pressure.tail(half.size());
  unknowns.shear_x = state.shear_x.tail(half.size());
  if (sphere) unknowns.shear_y = state.shear_y.tail(half.size());
  unknowns.approach = state.approach;
  unknowns.rotation_ratio = state.rotation_ratio;
  const std::vector<Zone> zone(state.zone.end() - half.size(), state.zone.end());
  solved.solution =
      summarise(ContactProblem(scene, half), InfluenceOperator(scene, solved.table, half, true), unknowns, zone)
          .solution;
  return solved;
}

}  // namespace rollres::test
