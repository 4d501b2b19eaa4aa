#pragma once

/// Layers whose moduli depend on the strain (material/strain_softening.hpp): the linear scene whose own strains give it
/// its moduli.
///
/// Unknown are ln gamma_i, the strain amplitude of each layer that softens (interior/interior_summary.hpp: mean over
/// its lines of flow by their loss), and ln omega, the contact's frequency V/a, a half of its length. A linear solution
/// with the factors of (gamma, omega) has amplitudes and a frequency of its own; where they agree, to 1e-8 in the
/// factors, it is the answer. Broyden's method (1965, Math. Comp. 19, 577), from gamma ~ G'^(-1/2), which holds for
/// Hertz's contact of a cylinder under a given load; for one layer it is a secant.

#include <functional>

#include "core/scene/solution.hpp"

namespace rollres {

/// Whether moduli of the scene's layers depend on the strain.
bool softens(const RollingScene& scene);

/// @param scene that softens   @param solve_linear  of the scene with given factors
/// @return the solution at its own strains, with strain_amplitude, softening and moduli_factors; not_converged, with a
/// reason, where there is none; what `solve_linear` found where that has no answer
RollingSolution solve_softening(const RollingScene& scene,
                                const std::function<RollingSolution(const RollingScene&)>& solve_linear);

}  // namespace rollres
