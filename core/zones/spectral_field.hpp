#pragma once

/// Tractions and slopes of the surface at any point, from a spectral state. Nothing here uses the equations that the
/// state was made to fulfil: what it finds in the contact is a check on them. The fields are those of (S1), (S2) and
/// (S21) in core/spectral/README.md.

#include <optional>
#include <vector>

#include "core/scene/solution.hpp"
#include "core/spectral/sliding_base.hpp"
#include "core/spectral/spectral_system.hpp"

namespace rollres {

class SpectralField {
 public:
  SpectralField(const SpectralProblem& problem, const SpectralState& state);

  double pressure(double x) const;  // (S9) with its tails [Pa]
  Eigen::ArrayXd pressure(const Eigen::ArrayXd& x) const;
  double shear(double x) const;  // (S15) [Pa]
  double shear(double x, double pressure_there) const;
  Eigen::ArrayXd shear(const Eigen::ArrayXd& x, const Eigen::ArrayXd& pressure_there) const;
  Zone zone(double x) const;

  /// Elastic slopes dw/dx, du/dx of a layer of unit modulus.
  struct Slopes {
    double w, u;
  };
  /// Of a half-space, at places x: [place, w and u].
  Eigen::ArrayX2d deep_slopes(const Eigen::ArrayXd& x) const;
  /// What finite thickness adds to them, a smooth function of x.
  /// @param part of what yields: the field's problem, or one side of it
  Slopes added_slopes(const SpectralProblem& part, double x) const;

  /// Well ahead of the contact, where points stand for the tractions: means R_{T_term} of those slopes, and the
  /// displacements w and u of the surface or of a side's part [m], 0 over a half-space.
  Slopes remembered_ahead(const SpectralProblem& part, std::size_t term, double x) const;
  Slopes displacement_ahead(const SpectralProblem& part, double x) const;

 private:
  /// Of a part's cross terms: those of a coating are opposite (steady_surface.hpp).
  double side_of(const SpectralProblem& part) const {
    return &part == problem_.side.get() && problem_.side_is_coating ? -1 : 1;
  }
  /// By the kernel of a part.
  template <class Kernel>
  Slopes sum_of_sources(const SpectralProblem& part, double x, Kernel kernel) const;
  struct Tails;  // what lies beyond a density's coefficients
  Eigen::VectorXd mixed_tail() const;
  template <class Value>
  Value tail_density(const Tails& tails, const Value& t) const;

  struct Tails {
    Eigen::VectorXd kept;  // amplitude times series up to the order, summed over terms
    Eigen::VectorXd left;  // and beyond it, from order + 1
    Eigen::VectorXd amplitudes, rates;
  };
  /// The slope that a density makes on a half-space, with its tails.
  class Image {
   public:
    Image() = default;
    /// @param weighted the density's coefficients, times what the slope takes of them
    Image(const Tails& tails, const Eigen::VectorXd& weighted);
    Eigen::ArrayXd at(const Interval& zone, const Eigen::ArrayXd& x) const;

   private:
    Eigen::VectorXd inside_, outside_;    // of T_0, T_1, ... in the zone; of the first power on of its continuation
    Eigen::VectorXd amplitudes_, rates_;  // of the tails' exponentials in the zone
  };
  static Tails tails_of(const SpectralProblem& problem, const SpectralDensity& density, double half_length);

  const SpectralProblem& problem_;
  const SpectralState& state_;
  double friction_;
  Tails contact_tails_;
  std::vector<Tails> stick_tails_;
  Image contact_image_, tail_image_;  // of the whole pressure; of its tails, where there is shear
  std::vector<Image> stick_images_;
  std::optional<SlidingBase> base_;
  RingLogarithms of_surface_, of_side_;
};

}  // namespace rollres
