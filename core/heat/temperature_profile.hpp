#pragma once

/// The steady temperature through warmed layers whose power lost is known with depth.
///
/// Of the power that flows towards the core at a depth s, F(s) = F(0) + L(s), L(s) = int_0^s D ds', and with the
/// resistance r(s) from the face (heat_path.hpp) the temperature is, integrated by parts,
///     T(s) = T(0) - F(0) r(s) - r(s) L(s) + M(s),   M(s) = int_0^s D r ds'.
/// Face and core give the two numbers left:
///     F(0) = P_f - g_a [T(0) - T_a] - g_g [T(0) - T_g],   F(H) = g_c [T(H) - T_c],
/// P_f the power lost at the face itself, by friction. Integrals are those of the polynomials through the losses at
/// Gauss's nodes of each panel. F rises from face to core, so that T is highest where F = 0, or at an end.

#include <vector>

#include "core/heat/heat_path.hpp"

namespace rollres {

/// Power lost in a range of depths: of a metre of depth, at the nodes of Gauss's rule [W/m2].
struct LossPanel {
  double from = 0, to = 0;  ///< below the face [m]
  std::vector<double> loss;
};

class TemperatureProfile {
 public:
  /// @param panels from the face to the core   @param at_face lost there, P_f [W/m]
  TemperatureProfile(const HeatPath& path, std::vector<LossPanel> panels, double at_face);

  double at(double depth) const;  ///< [K]
  double face() const { return path_.air.temperature + ends_.rise; }
  double bond() const { return at(path_.thickness); }
  /// Mean over the depth by the loss; where nothing is lost inside the plain one.
  double mean() const;
  /// The same mean, were nothing lost anywhere.
  double mean_without_loss() const;
  /// At depths, were all power lost so many times as much that the mean is `mean`.
  std::vector<double> scaled_to(double mean, const std::vector<double>& depths) const;
  struct Peak {
    double depth, temperature;
  };
  Peak peak() const;

  /// [W/m]; their sum is the power lost
  double to_air() const { return path_.air.conductance * ends_.rise; }
  double to_ground() const {
    return path_.ground.conductance * (path_.air.temperature - path_.ground.temperature + ends_.rise);
  }
  double to_core() const { return ends_.inwards + lost_.back().loss; }

 private:
  /// T(0) - T_a and F(0).
  struct Ends {
    double rise, inwards;
  };
  /// L and M.
  struct Lost {
    double loss = 0, moment = 0;
  };
  Ends ends_of(const Lost& whole, double at_face) const;
  /// At a depth, were nothing lost inside.
  double without_loss(const Ends& ends, double depth) const {
    return path_.air.temperature + ends.rise - path_.resistance(depth) * ends.inwards;
  }
  Lost lost_above(double depth) const;
  double mean_of(const Ends& ends, bool with_loss) const;

  HeatPath path_;
  std::vector<LossPanel> panels_;
  std::vector<Lost> lost_;  // above each panel, and all
  Ends ends_;
};

}  // namespace rollres
