#pragma once

/// What a given pressure loses in the layers, wave by wave.
///
/// With the transform P phi(k) of the pressure, tau = m p the shear along the motion, and the angle between wave
/// vector and motion,
///   R_r = (P/2 pi)^2 integral over all k of phi^2 k_x Im(c_ww + m^2 (c_ll cos^2 + c_tt sin^2)),
/// the compliances those of core/surface/steady_surface.hpp; the cross terms of p and tau take as much as they give.
/// With the half-length a, the half-width b and z^2 = (k_x a)^2 + (k_y b)^2, phi is 2 J_1(z)/z of a uniform ellipse, 3
/// (sin z - z cos z)/z^3 of Hertz's, and of rectangles the product of sin(k_y b)/(k_y b) and of sin(k_x a)/(k_x a) or,
/// of Hertz's, 2 J_1(k_x a)/(k_x a). Where phi^2 has oscillated often enough its mean takes its place.

#include "core/model/contact_model.hpp"

namespace rollres {

struct LossByWaves {
  double resistance;  ///< R_r [N]
  double error;       ///< estimated [N]
};

/// @param wanted  relative error   @pre the model has a loaded area
LossByWaves loss_by_waves(const ContactModel& model, double wanted);

}  // namespace rollres
