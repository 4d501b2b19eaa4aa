#pragma once

/// A neo-Hookean solid in plane strain, in material description, by unit shear modulus.
///
/// With F = 1 + grad u, C = F^T F, J = det F, t = tr C + 1 (the third direction is not stretched):
///   S = J^(-2/3) (1 - t/3 C^-1) + p V,   V = J C^-1,                                                       (H2)
/// the second Piola-Kirchhoff stress of W = (J^(-2/3) t - 3)/2 and a pressure p > 0 in tension, with E = (C - 1)/2.
/// Stresses are (S_11, S_22, S_12), strains (E_11, E_22, 2 E_12).

#include <Eigen/Core>

namespace rollres {

struct NeoHookean {
  double volume = 1;            // J [1]
  Eigen::Vector3d stress;       // of the first term [1]
  Eigen::Matrix3d tangent;      // its derivative with respect to E
  Eigen::Vector3d dilatation;   // V; dJ = V . dE
  Eigen::Matrix3d of_pressure;  // derivative of V with respect to E
};

/// @param gradient F   J <= 0 gives NaN
NeoHookean neo_hookean(const Eigen::Matrix2d& gradient);

}  // namespace rollres
