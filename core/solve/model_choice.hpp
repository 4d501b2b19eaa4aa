#pragma once

/// The cheapest model of a scene that its tolerance allows: layers that hardly yield are taken as rigid.
///
/// Each simplification rests on an estimate of what it changes, by the answers of the full and the simpler surface to
/// Hertz's pressure at one half-width (composite_estimate.hpp): the largest change of the compliance, of its slope by
/// the half-width and of the loss, threefold. All together may take a fifth of the tolerance. Scenes without a
/// tolerance are left as they are.

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace rollres {

struct ModelChoice {
  RollingScene scene;                  ///< what is to be solved, with what is left of the tolerance
  std::vector<std::string> decisions;  ///< in words, each with the number it rests on
  double left_out = 0;                 ///< estimate of what they change the rolling resistance by [1]
};

/// @param scene obeys `check`
ModelChoice choose_model(const RollingScene& scene);

}  // namespace rollres
