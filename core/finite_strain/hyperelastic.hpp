#pragma once

/// A neo-Hookean or Yeoh solid in plane strain, in material description, by unit shear modulus.
///
/// With F = 1 + grad u, C = F^T F, J = det F, t = tr C + 1 (the third direction is not stretched) and I = J^(-2/3) t:
///   S = W'(I) J^(-2/3) (1 - t/3 C^-1) + p V,   V = J C^-1,                                                 (H2)
/// the second Piola-Kirchhoff stress of W(I)/2 and a pressure p > 0 in tension, with E = (C - 1)/2. Yeoh (1993):
///   W = (I - 3) + c_2 (I - 3)^2 + c_3 (I - 3)^3,   c_2 = C20/C10,  c_3 = C30/C10;   c_2 = c_3 = 0: neo-Hooke. (H2a)
/// Stresses are (S_11, S_22, S_12), strains (E_11, E_22, 2 E_12).

#include <Eigen/Core>

namespace rollres {

/// c_2 and c_3 [1]: a simple shear g takes the stress g (1 + 2 c_2 g^2 + 3 c_3 g^4).
struct YeohRatios {
  double second = 0, third = 0;
};

struct Hyperelastic {
  double volume = 1;            // J [1]
  Eigen::Vector3d stress;       // of the first term [1]
  Eigen::Matrix3d tangent;      // its derivative with respect to E
  Eigen::Vector3d dilatation;   // V; dJ = V . dE
  Eigen::Matrix3d of_pressure;  // derivative of V with respect to E
};

/// @param gradient F   J <= 0 gives NaN
Hyperelastic hyperelastic(const Eigen::Matrix2d& gradient, const YeohRatios& yeoh = {});

}  // namespace rollres
