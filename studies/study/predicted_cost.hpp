#pragma once

/// How long a scene will take, from its inputs alone: to share out a study evenly, and to say when it will be done.

#include <vector>

#include "core/scene/scene.hpp"
#include "studies/study/study.hpp"

namespace rollres {

/// Seconds of one core, of the machine it was measured on, for a cold solution. Power laws in the cells x on the
/// half-width of the contact (core/estimate/grid_choice.hpp: estimate_contact), or in the tolerance where that decides
/// on the grid; without friction a half to a fifth of it.
///
/// Fitted to 848 random scenes (R 5 mm to 0.2 m, H/R 0.05 to 3, f 0.1 to 10, τ 1 ms to 1 s, V 1 mm/s to 10 m/s, x 4 to
/// 60 for a sphere and 5 to 500 for a cylinder): standard deviation of log(seconds/predicted) 0.1 to 0.25 for a
/// sphere's grid (given or tied), 0.1 to 0.5 for a cylinder's, 0.9 for the spectral method (0.2 to 10 ms, and longer
/// where a grid must step in), 1.4 to 1.8 for a `tolerance` on a grid, as nobody knows how often it is halved. On 119
/// others, mixed, seconds/predicted was 0.43 to 1.33 for eight of ten without and 0.06 to 2.4 with a tolerance on a
/// grid; the sum of all was 1.25 times what was predicted. `period` is left out of account.
double predicted_seconds(const RollingScene& scene);

/// The same of every point.
std::vector<double> predicted_seconds(const StudyPlan& plan);

}  // namespace rollres
