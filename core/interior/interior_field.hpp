#pragma once

/// Displacements, stresses, strains and losses inside the layers of a cylinder's contact in steady motion.
///
/// A wave e^{ikx} of the tractions moves at V, so that a material point meets it at the frequency -k V: its field is
/// the elastic one with the moduli G*(-k V) (depth_response.hpp), the strains with J = 1/G*(-k V) are
///     epsilon_x = J/2 [(1 - nu) sigma_x - nu sigma_z],  epsilon_z alike,  gamma_xz = J tau_xz     (plane strain),
/// and a field is f(x) = (1/pi) Re int_0^inf f(k) e^{ikx} dk. Near the surface, where waves decay slowly, the stresses
/// of a half-space, which do not depend on its material, are taken from the waves and added in closed form
/// (surface_tractions.hpp), the strains likewise with the compliance of the shortest wave.
///
/// The power lost on a line of flow, by Parseval from the whole line, memories that end far behind the contact
/// included:
///     D(z) = V int -sigma : d epsilon/dx dx = (V/pi) int_0^inf k Im[conj(sigma) : epsilon] dk,
/// whose sum over the depth is the power that the tractions put into the layers. The local density, for the spectrum
/// of creep J = J_inf + sum C_m/(1 + i omega tau_m) as springs and dashpots, with y_m the memory mean of the stress
/// over T_m = V tau_m and E(sigma) = [(1 - nu)(sigma_x^2 + sigma_z^2) - 2 nu sigma_x sigma_z]/2 + tau_xz^2, is
///     sum_m C_m/tau_m E(sigma - y_m).
/// Around a thick ring, or one that has not recovered when it comes round, waves are whole harmonics, k = n/R, and the
/// integrals sums over them.
/// Shear along the axle of a skewed cylinder adds its own part to all of these (axial_field.hpp).

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/interior/axial_field.hpp"
#include "core/interior/surface_tractions.hpp"
#include "core/surface/layered_medium.hpp"

namespace rollres {

/// A line of flow in one of the layers.
struct InteriorLine {
  std::size_t layer = 0;  ///< counted from the contact
  double depth = 0;       ///< below the layer's face nearer to the contact [m]
};

/// Depth of a line below the contact [m].
double depth_of(const LayeredMedium& medium, const InteriorLine& line);

/// Components of symmetric tensors, in the order in which they stand.
enum class Component { x, y, z, yz, xz, xy };
inline constexpr std::size_t components = 6;

/// Fields at points (x, place); z is up, seen from the layers under the body. Places are lines, in a contact in three
/// dimensions (line, y) with y running fastest: place = line * ys + y. Of plane strain what has y among its axes is
/// empty; of a skewed cylinder sigma_y alone, the strain along y being 0.
struct VolumeFields {
  Eigen::ArrayXXd u, v, w;  ///< [m], if asked for; 0 over a half-space, which has no place at rest
  std::array<Eigen::ArrayXXd, components> stress;  ///< [Pa], if asked for
  std::array<Eigen::ArrayXXd, components> strain;  ///< of shear gamma_ij = 2 epsilon_ij [1]
  Eigen::ArrayXXd loss_density;                    ///< [W/m3], if asked for
  Eigen::ArrayXd line_loss;                        ///< of each place [W/m2]
  Eigen::ArrayXd plane_loss;                       ///< of each line's depth, all y [W/m]; empty of a cylinder

  const Eigen::ArrayXXd& stress_of(Component c) const { return stress[static_cast<std::size_t>(c)]; }
  const Eigen::ArrayXXd& strain_of(Component c) const { return strain[static_cast<std::size_t>(c)]; }
  Eigen::ArrayXXd& stress_of(Component c) { return stress[static_cast<std::size_t>(c)]; }
  Eigen::ArrayXXd& strain_of(Component c) { return strain[static_cast<std::size_t>(c)]; }
};

class InteriorField {
 public:
  /// How much of the field near the surface is wanted.
  enum class Detail {
    surface,  ///< up to the surface, where the tractions' ends are in place
    inside,   ///< what counts for sums over the layers; strains within a hundredth of the contact are blurred
    rough     ///< the same for estimates, within a twentieth
  };

  /// @param medium from the contact away, with the creep that it has at V   @param speed V [m/s]
  /// @param flow  speed at which it flows over V, negative where a coating flows backwards: losses are as often
  /// @param reach up to which |x| fields are wanted [m]
  /// @throws std::domain_error if the fields hold no contact; BeyondLimits
  InteriorField(LayeredMedium medium, double speed, double flow, const SurfaceFields& fields, double reach,
                Detail detail);

  /// Which fields: strains alone, all, or all and the density of the loss.
  enum class Wanted { strains, all, density };

  /// @param x ascending [m], evenly spaced for the density
  VolumeFields at(const std::vector<double>& x, const std::vector<InteriorLine>& lines,
                  Wanted wanted = Wanted::all) const;

  const LayeredMedium& medium() const { return medium_; }
  const SurfaceTractions& tractions() const { return tractions_; }
  double speed() const { return std::abs(speed_); }  ///< V [m/s]
  /// Depth of a line below the contact [m].
  double depth_of(const InteriorLine& line) const { return rollres::depth_of(medium_, line); }

 private:
  struct Wave {
    double wavenumber, weight;
    SurfaceTractions::Transforms tractions;
    std::vector<std::complex<double>> moduli;
  };
  class Sum;

  double highest_wavenumber(double half_length, Detail detail) const;
  void put_wave(double wavenumber, double weight, const SurfaceTractions::Transforms& tractions);
  void add_waves(double lowest, double widest);
  /// Whether what is half a turn of a ring away counts, or memories of the last turn.
  bool comes_round(double speed) const;
  /// The whole harmonics of a ring, in place of the integral over waves.
  void add_harmonics();

  LayeredMedium medium_;
  double speed_, flow_, highest_;  // flow_ without its sign
  bool half_space_, closed_form_;
  SurfaceTractions tractions_;
  std::vector<Wave> waves_;
  double short_compliance_;          // of the first layer at the shortest waves [1/Pa]
  std::optional<AxialField> axial_;  // of a skewed cylinder
};

}  // namespace rollres
