#pragma once

/// Rolling of a cylinder with continuous contact edges: one domain for each zone, spectral in each. Theory:
/// core/spectral/README.md.
///
/// The zones are guessed from a chain of cheap solutions (frictionless; one border between stick and slip; slip at the
/// leading edge where that would overload the stick; the zones of a coarse grid), and every answer is checked against
/// all laws on a fine set of points. Orders rise until the tolerance is met.

#include <optional>
#include <string>

#include "core/material/material.hpp"
#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"
#include "core/zones/spectral_search.hpp"

namespace rollres {

/// The zones of an answer, where the search for those of much the same scene may begin.
struct FoundZones {
  SlipPattern pattern;
  SpectralEdges edges;
  double coefficients;  ///< that the answer took
  EdgeSearch::Slopes search;
  CoatingMoments coating_moments;  ///< M and N of (S18) [N/m]
};

struct SpectralOutcome {
  /// Absent if no pattern of zones that this method knows obeys all laws.
  std::optional<RollingSolution> solution;
  std::string reason;                    ///< why there is none
  std::optional<FoundZones> zones = {};  ///< of a solution with friction
};

/// @param scene of a cylinder that obeys `check`, without period
/// The solution's status is converged or no_steady_state; model, seconds and warnings are left to the caller.
/// @param near  zones of much the same scene, which are tried before all others
SpectralOutcome solve_spectral(const ContactModel& model, const std::optional<FoundZones>& near = {});
/// The same for any discrete spectrum in place of the scene's material; the start is guessed from the scene's.
SpectralOutcome solve_spectral(const ContactModel& model, const CreepSpectrum& creep);

}  // namespace rollres
