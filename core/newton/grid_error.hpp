#pragma once

/// What a grid does to the rolling resistance, told from one solution on it.
///
/// Edges. With central differences an elastic layer takes no power on the grid either, as it takes none in truth. The
/// power it takes by them, -V sum(F_W dw/dx), is that of R_r less what the gaps beside the contact amount to,
///   Delta = sum p A (gap(i+1) - gap(i-1)) / 2a                                                                   (1)
/// over the contact (A: area of a cell, a: spacing). R_r and R_r - Delta tend to the same value.
///
/// Slow rolling. For memories short against the contact, with the creep compliance J(omega) = J0 (1 - i omega A -
/// omega^2 B + ...), no friction and any layer,
///   R_r = V A P/R - V^2 (B - A^2/2) W,   W = (pi / 4 E0*) int sum |d(p^2)/dx| dy,   E0* = 2 G0 / (1 - nu),        (2)
/// the sum over the leading and the trailing edge of the contact at y. The first term is the known limit; the second is
/// the layer's give at the edges, where the pressure rises as a square root whatever the layer. For a cylinder on a
/// half-space (2) is the beginning of Hunter's (1961) solution, R_r = V tau' (P/R) (1 - (T + T_r)/2a) with T = V tau,
/// T_r = T/(1 + f): it holds to 0.02 % at T/a = 0.1, to 2 % at 0.3. The grid, whose cells are loaded evenly, loses a
/// part of the order of a cell over the contact's length where memories are shorter than a cell:
///   c (1 - nu) R a / (G0 P) int int (dp/dx)^2 dx dy                                                              (3)
/// of R_r, measured with c = 0.7.

#include "core/newton/contact_problem.hpp"

namespace rollres {

struct GridError {
  bool sphere = false;
  double edges = 0;          ///< Delta of equation (1) [N] (per metre for a cylinder)
  double slow_loss = 0;      ///< viscous resistance by equation (2) [N]
  double slow_error = 0;     ///< estimated error of that [N]
  double unresolved = 0;     ///< estimated error of the grid's own, by equation (3) [N]
  double slow_share = 0;     ///< how much of `slow_loss` to take: 0 to 1, smooth in all inputs
  double memory_length = 0;  ///< longest V tau [m]

  /// Estimated error of a resistance, from what the last halving of the spacing changed in it [N]; that may be NaN.
  double estimate(double resistance, double last_change) const;
};

/// @param pressure [Pa] and gap [m] on the problem's (half) grid
GridError grid_error(const ContactProblem& problem, const Vector& pressure, const std::vector<Zone>& zone,
                     const Vector& gap);

/// Puts the slow-rolling resistance into a solution, by its share, which much friction reduces: R_r, what drives it,
/// and the viscous loss. Shear tractions add V A int (tau_x u'' + tau_y v'') to equation (2).
void take_slow_rolling(const RollingScene& scene, GridError& error, RollingSolution& solution);

}  // namespace rollres
