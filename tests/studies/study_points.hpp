#pragma once

#include <vector>

#include "studies/study/study.hpp"

namespace rollres {

/// The scenes of all points of a study, checked as StudyPlan does.
inline std::vector<RollingScene> points(const Study& study) {
  const StudyPlan plan(study);
  std::vector<RollingScene> scenes;
  plan.for_each([&](std::size_t, const RollingScene& scene) { scenes.push_back(scene); });
  return scenes;
}

}  // namespace rollres
