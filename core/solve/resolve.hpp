#pragma once

/// From a scene to the model that is solved: the cheapest that its tolerance allows, where layers that hardly yield are
/// taken as rigid.
///
/// Each simplification rests on an estimate of what it changes, by the answers of the full and the simpler surface to
/// Hertz's pressure at one half-width (composite_estimate.hpp): the largest change of the compliance, of its slope by
/// the half-width and of the loss, threefold. All together may take a fifth of the tolerance. Scenes without a
/// tolerance are left as they are.

#include "core/model/contact_model.hpp"

namespace rollres {

/// The model of a scene before anything is known of its answer. @param scene obeys `check`
ContactModel resolve(const RollingScene& scene);

/// A model with nothing left out, less what its tolerance allows: with `decisions`, what they change (`left_out`), and
/// what is left of the tolerance.
ContactModel simplified(const ContactModel& full);

}  // namespace rollres
