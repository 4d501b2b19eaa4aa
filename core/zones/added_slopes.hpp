#pragma once

/// What layers add to the elastic slopes, tabulated along a surface for the panels that march over it.

#include <cstddef>
#include <functional>
#include <vector>

#include "core/numerics/chebyshev.hpp"
#include "core/zones/spectral_field.hpp"

namespace rollres {

/// Ends at which tractions or slopes have roots of the distance [m].
std::vector<double> ends_of_zones(const SpectralEdges& edges);

/// What finite thickness adds to the elastic slopes, as Chebyshev series on panels no wider than the depth it comes
/// from: it is singular at twice that distance from the surface. A ring's, which goes with ln|x|, is smooth in x
/// outside the contact in the angle of x = centre +- half cosh(angle), and between the ends of zones in that of x =
/// centre + half sin(angle).
class AddedSlopes {
 public:
  /// Between these places; elsewhere, and where there would be more nodes than `most`, it is summed anew.
  /// @param part of what yields: the field's problem, or one side of it
  AddedSlopes(const SpectralProblem& part, const SpectralField& field, const SpectralEdges& edges, double from,
              double to, std::size_t most);

  SpectralField::Slopes operator()(double x) const;

 private:
  struct Stretch {
    double from, to;
    std::function<double(double)> variable;  // of the place
    ChebyshevTable<2> table;
  };
  using Variable = std::function<double(double)>;
  /// @param variable of a place, which runs between first and last, and back
  void tabulate(double from, double to, double first, double last, Variable variable, const Variable& place);

  const SpectralProblem& part_;
  const SpectralField& field_;
  std::size_t most_;
  std::vector<Stretch> stretches_;
};

}  // namespace rollres
