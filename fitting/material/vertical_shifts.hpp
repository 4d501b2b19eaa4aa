#pragma once

/// Vertical shifts: b_T G*(omega, T) = G*(a_T omega, T0), one b_T for each temperature, found with the free a_T.
///
/// Any b_T lowers the misfit. They are taken where AICc (errors/information_criteria.hpp) falls by wanted_gain, which
/// leaves models without them "essentially no support" (Burnham and Anderson 2002, Model Selection and Multimodel
/// Inference, section 2.6): 11 of them do so by chance in one of some thousand tables.

#include <functional>

#include "fitting/material/material_fit.hpp"

namespace rollres {

inline constexpr double wanted_gain = 10;

/// The better of two fits of free shifts, without and with b_T; a note says which, and by how much. The second is not
/// made where to first order AICc would not fall by so much.
/// @param fit_with  fits with the shifts that it is given, whose table has b_T where they are wanted
MaterialFit with_vertical_shifts(const std::vector<MeasuredModulus>& data, const MaterialFitOptions& options,
                                 const std::function<MaterialFit(const MaterialFitOptions&)>& fit_with);

}  // namespace rollres
