#pragma once

/// Layers whose moduli depend on the strain (material/strain_softening.hpp): the linear scene whose own strains give it
/// its moduli.
///
/// A linear solution with the factors (a_i, b_i) of the layers that soften has strain amplitudes gamma_i
/// (interior/interior_summary.hpp: mean over a layer's lines of flow by their loss) and a frequency omega = V/a of its
/// own, a half of the contact's length; these ask for factors of their own. Where both agree, to 1e-8, it is the
/// answer. ln gamma_i and ln omega are nearly linear in ln a_i, ln b_i: their slopes, at first those of a Hertz line
/// under a given load (gamma ~ G'^(-1/2)), are corrected by each further solution (Broyden 1965, Math. Comp. 19, 577),
/// and the factors that agree by them are tried next.
///
/// Where a solution costs many times one on the usual grid (a grid stands in for continuous edges, or is as fine as a
/// tolerance asks), the factors are found on that grid: its logarithms plus what they missed of the last answer asked
/// for, until that answer agrees to 1e-8 itself.
///
/// The estimated error of R_r counts that of the amplitudes, by their quadrature (LayerLoss::amplitude_error) and by
/// the loss that the lines miss of the whole: R_r goes as G" and at most as G'^(-3/2), as of a Hertz line under a load.

#include <functional>

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// Whether moduli of the model's layers depend on the strain.
bool softens(const ContactModel& model);

/// @param full  model that softens, with nothing left out   @param solve_linear  of it with given factors
/// @return the solution at its own strains, with strain_amplitude, softening and moduli_factors; not_converged, with a
/// reason, where there is none; what `solve_linear` found where that has no answer
RollingSolution solve_softening(const ContactModel& full,
                                const std::function<RollingSolution(const ContactModel&)>& solve_linear);

}  // namespace rollres
