#pragma once

// Frictionless contact on an elastic incompressible bonded layer by integral equations, for tests: half-width 1,
// thickness 1/alpha, G = R = 1. S(h) = (sinh 2h - 2h)/(cosh 2h + 1 + 2 h^2) is the compliance of the layer over that of
// the half-space at wavenumber h/H. For alpha up to about 20; beyond, the equations lose digits.

namespace rollres::testing {

struct LayerContact {
  double load, approach;
};

/// Cylinder: p = sqrt(1 - t^2) phi(t), phi at n Gauss-Chebyshev nodes of the second kind, the slope of the surface
/// collocated midway between them,
///     (1/2 pi) int p(t) [1/(x - t) - alpha int_0^inf (1 - S) sin(h alpha (x - t)) dh] dt = x.
LayerContact layer_contact_line(double alpha, int n);

/// Sphere: p^(k) = int_0^1 phi(t) cos(k t) dt turns the contact into (Lebedev and Ufliand 1958)
///     phi(t) - (2/pi) int_0^1 phi(s) alpha int_0^inf (1 - S) cos(h alpha t) cos(h alpha s) dh ds = (4/pi)(d - t^2),
/// phi(1) = 0, P = 2 pi int_0^1 phi; n Gauss-Legendre nodes after Golub and Welsch, phi(1) from the equation at t = 1.
LayerContact layer_contact_sphere(double alpha, int n);

}  // namespace rollres::testing
