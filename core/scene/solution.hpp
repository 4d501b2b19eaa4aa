#pragma once

/// The answer to a scene, as a plain value, with the evidence for it.

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/quantity.hpp"
#include "core/scene/scene.hpp"

namespace rollres {

enum class Status {
  converged,        ///< every law of contact holds at every node within the solver's tolerance
  no_steady_state,  ///< the drive asks for more traction than friction can give, or friction makes the body dig itself
                    ///< in, or it is faster than the waves of layers whose inertia counts, or more heat is made at any
                    ///< temperature than leaves; `reason` says which
  not_converged     ///< no answer; `reason` says in which state the solver stopped
};
template <>
struct ChoiceNames<Status> {
  static constexpr std::array<std::string_view, 3> names{"converged", "no_steady_state", "not_converged"};
};

/// Nodes at (x(i), y(j)); arrays over them have x running fastest: index = j * columns + i.
struct SurfaceGrid {
  double spacing_x = 0, spacing_y = 0;  // [m]; spacing_y is 1 m (per metre) for a cylinder
  double origin_x = 0, origin_y = 0;    // position of node (first_column = 0, first_row = 0) [m]
  int first_column = 0, first_row = 0;
  int columns = 0, rows = 0;
  bool folded = false;  // rows begin at y = 0, and those at y > 0 stand for their mirror images, too

  double x(int column) const { return origin_x + spacing_x * (first_column + column); }
  double y(int row) const { return origin_y + spacing_y * (first_row + row); }
  int size() const { return columns * rows; }
  int index(int column, int row) const { return row * columns + column; }
  /// How often the nodes of a row stand on the whole grid.
  int images(int row) const { return folded && first_row + row > 0 ? 2 : 1; }
  int whole_rows() const { return folded ? 2 * rows - 1 : rows; }
  double cell_area() const { return spacing_x * spacing_y; }  // [m2]; [m] per metre of length for a cylinder
};

enum class Zone : signed char { free, stick, slip };
template <>
struct ChoiceNames<Zone> {
  static constexpr std::array<std::string_view, 3> names{"free", "stick", "slip"};
};

/// The tractions on a part of a cylinder's surface, smooth inside it: at x = middle + half sin(pi s/2), s = cos(pi
/// k/last) from the leading end to the trailing one; a single value is uniform.
struct TractionPanel {
  double from = 0, to = 0;              // [m]
  std::vector<double> pressure, shear;  // [Pa]
};

/// Fields on the surface of the layer. Tractions act on the layer; v, shear_y and slip_y are empty for a straight
/// cylinder; those of a skewed one are in the frame of its axle.
struct SurfaceFields {
  SurfaceGrid grid;
  std::vector<double> u, v, w;           // displacements along x, y, z [m]
  std::vector<double> pressure;          // -sigma_z [Pa], > 0 in compression
  std::vector<double> shear_x, shear_y;  // tau_xz, tau_yz [Pa]
  std::vector<double> slip_x, slip_y;    // velocity of the body relative to the layer over V [1]; 0 outside
  std::vector<Zone> zone;
  std::vector<TractionPanel> panels;  // of continuous tractions; empty: those of each node are uniform over its cell
};

/// Absent numbers (not applicable, or not computed) are NaN.
struct RollingSolution {
  static constexpr double absent = std::numeric_limits<double>::quiet_NaN();

  double rolling_resistance = absent;
  double rolling_resistance_coefficient = absent;
  double driving_force = absent;
  double driving_torque = absent;
  double rotation_speed = absent;
  double rotation_ratio = absent;
  double skew_angle = absent, axial_force = absent;  // of a skewed cylinder; the angle of a sphere, too
  double lateral_force = absent, spin_moment = absent, overturning_moment = absent;
  double creepage_x = absent, creepage_y = absent, spin = absent;
  double approach = absent;
  double load = absent;
  double leading_edge = absent, trailing_edge = absent, half_width = absent;
  double edge_error = absent;
  double contact_area = absent, contact_area_error = absent;
  double mean_pressure = absent, peak_pressure = absent, peak_pressure_error = absent;
  double peak_pressure_x = absent, peak_pressure_y = absent;
  double deflection = absent, peak_deflection = absent, peak_deflection_x = absent, deflection_error = absent;
  std::vector<double> deflections;  // at the places that the scene gives [m]
  double peak_shear_x = absent, peak_shear_y = absent;
  int contact_nodes = 0, slip_nodes = 0;
  double viscous_loss = absent, frictional_loss = absent;
  double energy_residual = absent;
  double law_violation = absent;
  double friction_needed = absent;
  double friction_borne = absent;
  double error_estimate = absent;
  double rolling_resistance_error = absent;
  double model_error = absent;  // estimate/assumptions.hpp
  double peak_shear_strain = absent;
  double peak_shear_strain_x = absent, peak_shear_strain_y = absent, peak_shear_strain_z = absent;
  double strain_amplitude = absent, peak_strain_amplitude = absent;
  double bond_shear = absent, bond_tension = absent;
  std::vector<double> bond_shears, bond_tensions;  // of each layer, under the body from the contact, then on it [Pa]
  double interior_loss = absent;
  double softening = absent;
  double mean_temperature = absent;
  double peak_temperature = absent, peak_temperature_depth = absent;
  double bond_temperature = absent, surface_temperature = absent;
  double heat_to_air = absent, heat_to_ground = absent, heat_to_core = absent;
  double warming_time = absent, peclet = absent, fourier = absent, biot = absent;
  std::vector<double> temperatures;  // of all steady states, ascending [K]
  double spacing = absent;
  int iterations = 0;
  double seconds = absent;
  Method method = Method::newton;
  std::string model;
  std::vector<std::string> assumptions;
  Status status = Status::not_converged;
  std::string reason;
  std::vector<std::string> warnings;

  // Not scalar outputs: not visited.
  SurfaceFields fields;
  std::vector<std::array<double, 2>> moduli_factors;  // rest_factor, relaxation_factor of each layer; empty: linear
};

/// Walks the outputs: `visitor(quantity, value)`, value being double, int, an enumeration with ChoiceNames,
/// std::string, std::vector<double> or std::vector<std::string>. An output that is also an input (load, approach,
/// driving_torque, rotation_ratio, spacing, method) has the same key: it is the value found or used.
template <class Solution, class Visitor>
void visit_outputs(Solution& solution, Visitor&& visitor) {
  using Q = Quantity;
  auto& s = solution;
  visitor(Q{"rolling_resistance", "R_r", "N", "rolling resistance Q + T Ω / V", any_number, "N/m"},
          s.rolling_resistance);
  visitor(Q{"rolling_resistance_coefficient", "R_r/P", "1", "rolling resistance over load"},
          s.rolling_resistance_coefficient);
  visitor(Q{"driving_force", "Q", "N", "horizontal force that drives the body", any_number, "N/m"}, s.driving_force);
  visitor(Q{"driving_torque", "T", "N.m", "torque that drives the body, clockwise", any_number, "N"}, s.driving_torque);
  visitor(Q{"rotation_speed", "Ω", "rad/s", "rotational speed of the body"}, s.rotation_speed);
  visitor(Q{"rotation_ratio", "RΩ/V", "1", "circumferential speed over speed"}, s.rotation_ratio);
  visitor(Q{"skew_angle", "α", "rad", "angle by which the axle is turned to the left of across the travel"},
          s.skew_angle);
  visitor(Q{"axial_force", "F_a", "N", "force on a cylinder along its axle, to the left", any_number, "N/m"},
          s.axial_force);
  visitor(Q{"lateral_force", "F_y", "N", "force across the travel, to the left, that a sphere needs"}, s.lateral_force);
  visitor(Q{"spin_moment", "M_z", "N.m", "moment about the vertical through the middle of a sphere that it needs"},
          s.spin_moment);
  visitor(Q{"overturning_moment", "M_x", "N.m", "moment about the travel through the middle of a sphere that it needs"},
          s.overturning_moment);
  visitor(Q{"creepage_x", "ξ", "1", "1 - (RΩ/V) cos α cos γ"}, s.creepage_x);
  visitor(Q{"creepage_y", "η", "1", "-(RΩ/V) sin α cos γ"}, s.creepage_y);
  visitor(Q{"spin", "φ", "1/m", "(Ω/V) sin γ + pivot: turning about the vertical over the path of a sphere"}, s.spin);
  visitor(Q{"approach", "d", "m", "penetration of the body below the undeformed surface"}, s.approach);
  visitor(Q{"load", "P", "N", "vertical load", any_number, "N/m"}, s.load);
  visitor(Q{"leading_edge", "x+", "m", "largest x of the contact"}, s.leading_edge);
  visitor(Q{"trailing_edge", "x-", "m", "smallest x of the contact"}, s.trailing_edge);
  visitor(Q{"half_width", "b", "m", "largest y of the contact (sphere)"}, s.half_width);
  visitor(Q{"edge_error", "", "m", "estimated error of leading_edge, trailing_edge and half_width on a grid"},
          s.edge_error);
  visitor(
      Q{"contact_area", "A", "m2", "area of contact (per metre of a cylinder: its length along x)", any_number, "m"},
      s.contact_area);
  visitor(Q{"contact_area_error", "", "m2", "estimated error of the area of contact on a grid", any_number, "m"},
          s.contact_area_error);
  visitor(Q{"mean_pressure", "p_m", "Pa", "load over area of contact"}, s.mean_pressure);
  visitor(Q{"peak_pressure", "p_0", "Pa", "largest pressure"}, s.peak_pressure);
  visitor(Q{"peak_pressure_error", "", "Pa", "estimated error of the largest pressure"}, s.peak_pressure_error);
  visitor(Q{"peak_pressure_x", "", "m", "place of the node with the largest pressure of a sphere or roller"},
          s.peak_pressure_x);
  visitor(Q{"peak_pressure_y", "", "m", "the same across the motion, to the left; of two mirror images the left one"},
          s.peak_pressure_y);
  visitor(Q{"deflection", "", "m", "downward displacement of the surface under the middle of a given pressure"},
          s.deflection);
  visitor(Q{"peak_deflection", "", "m", "largest downward displacement that it causes"}, s.peak_deflection);
  visitor(Q{"peak_deflection_x", "", "m", "where that is along the motion"}, s.peak_deflection_x);
  visitor(Q{"deflections", "", "m", "downward displacements at deflection_places_x and _y"}, s.deflections);
  visitor(Q{"deflection_error", "", "m", "estimated error of these displacements, the largest"}, s.deflection_error);
  visitor(Q{"peak_shear_x", "max|τ_xz|", "Pa", "largest shear traction along x"}, s.peak_shear_x);
  visitor(Q{"peak_shear_y", "max|τ_yz|", "Pa", "largest shear traction along y (sphere, skewed cylinder)"},
          s.peak_shear_y);
  visitor(Q{"contact_nodes", "", "1", "nodes in contact"}, s.contact_nodes);
  visitor(Q{"slip_nodes", "", "1", "nodes in contact that slip"}, s.slip_nodes);
  visitor(Q{"viscous_loss", "", "W", "power lost in the layer", any_number, "W/m"}, s.viscous_loss);
  visitor(Q{"frictional_loss", "", "W", "power lost to friction", any_number, "W/m"}, s.frictional_loss);
  visitor(Q{"energy_residual", "", "1", "what the power balance misses, over R_r V"}, s.energy_residual);
  visitor(Q{"law_violation", "", "1", "largest relative violation of a law of contact at any node"}, s.law_violation);
  visitor(Q{"friction_needed", "", "1", "least friction coefficient with a steady state, where there is none"},
          s.friction_needed);
  visitor(Q{"friction_borne", "", "1",
            "largest friction coefficient with a steady state, where under more the body digs itself in"},
          s.friction_borne);
  visitor(Q{"error_estimate", "", "1", "estimated relative error of the rolling resistance"}, s.error_estimate);
  visitor(Q{"rolling_resistance_error", "", "N", "estimated error of the rolling resistance", any_number, "N/m"},
          s.rolling_resistance_error);
  visitor(
      Q{"model_error", "", "1", "estimated relative error of R_r by what the model assumes, where all of it is known"},
      s.model_error);
  visitor(Q{"peak_shear_strain", "γ_max", "1", "largest shear strain in the layers"}, s.peak_shear_strain);
  visitor(Q{"peak_shear_strain_x", "", "m", "where it is along the motion"}, s.peak_shear_strain_x);
  visitor(Q{"peak_shear_strain_y", "", "m", "where it is across the motion, at y and -y (sphere)"},
          s.peak_shear_strain_y);
  visitor(Q{"peak_shear_strain_z", "", "m", "its height over the surface, negative in the layers under the body"},
          s.peak_shear_strain_z);
  visitor(Q{"strain_amplitude", "γ_a", "1",
            "half of the largest difference of shear strains along a line of flow, mean over the lines by their loss"},
          s.strain_amplitude);
  visitor(Q{"peak_strain_amplitude", "", "1", "largest such half difference of any line"}, s.peak_strain_amplitude);
  visitor(Q{"bond_shear", "", "Pa", "largest shear stress at a bond of a layer"}, s.bond_shear);
  visitor(Q{"bond_tension", "", "Pa", "largest tension normal to a bond of a layer"}, s.bond_tension);
  visitor(
      Q{"bond_shears", "", "Pa",
        "largest shear stress at the far side of each layer: those under the body from the contact, then those on it"},
      s.bond_shears);
  visitor(Q{"bond_tensions", "", "Pa", "largest tension there, layer by layer"}, s.bond_tensions);
  visitor(Q{"interior_loss", "", "W", "power lost in the layers, summed over their inside", any_number, "W/m"},
          s.interior_loss);
  visitor(Q{"softening", "", "1",
            "G' at the strain amplitude and the contact's frequency V/a over that at small "
            "strains, of the layer that softens most"},
          s.softening);
  visitor(Q{"mean_temperature", "T_m", "K",
            "temperature of the layers that heat warms, mean by what each depth loses: the one of their materials"},
          s.mean_temperature);
  visitor(Q{"peak_temperature", "T_max", "K", "highest temperature in them"}, s.peak_temperature);
  visitor(Q{"peak_temperature_depth", "", "m", "where it is below the face in contact"}, s.peak_temperature_depth);
  visitor(Q{"bond_temperature", "T_b", "K", "temperature of their bond to the core, or of a belt's other face"},
          s.bond_temperature);
  visitor(Q{"surface_temperature", "T_s", "K", "temperature of their face in contact, in the mean of a turn"},
          s.surface_temperature);
  visitor(Q{"heat_to_air", "", "W", "heat that their face gives to the air", any_number, "W/m"}, s.heat_to_air);
  visitor(Q{"heat_to_ground", "", "W",
            "heat that it gives to what it touches, with what layers under a covered body lose themselves", any_number,
            "W/m"},
          s.heat_to_ground);
  visitor(Q{"heat_to_core", "", "W", "heat that leaves through the core; all three are R_r V", any_number, "W/m"},
          s.heat_to_core);
  visitor(Q{"warming_time", "H²/κ", "s", "thickness squared over the diffusivity: the time that warming takes"},
          s.warming_time);
  visitor(Q{"peclet", "Pe", "1", "V H²/(κ R): large where temperatures are even around a turn"}, s.peclet);
  visitor(Q{"fourier", "Fo", "1", "κ t/H² of the time of a turn: small where they are"}, s.fourier);
  visitor(Q{"biot", "Bi", "1", "heat transfer of the face, with the contact's, times H/k"}, s.biot);
  visitor(Q{"temperatures", "", "K",
            "mean temperatures of all steady states, ascending: stable, unstable and stable in turn; warming reaches "
            "the first"},
          s.temperatures);
  visitor(Q{"spacing", "a", "m", "distance between nodes"}, s.spacing);
  visitor(Q{"iterations", "", "1", "iterations of the solver on its last grid"}, s.iterations);
  visitor(Q{"seconds", "", "s", "wall time of the solution"}, s.seconds);
  visitor(Q{"method", "", "", "solver"}, s.method);
  visitor(Q{"model", "", "", "what was left out and why"}, s.model);
  visitor(Q{"assumptions", "", "", "what the model assumes, with its number and what it changes R_r by"},
          s.assumptions);
  visitor(Q{"status", "", "", "converged, no_steady_state or not_converged"}, s.status);
  visitor(Q{"reason", "", "", "why there is no answer"}, s.reason);
  visitor(Q{"warnings", "", "", "what to mind when using the answer"}, s.warnings);
}

/// The output with this key, or a number of a list of them, "bond_shears[1]", whether or not an answer has such a
/// number; nothing if there is none.
std::optional<Quantity> output_quantity(std::string_view key);

/// The number that it is in an answer; NaN where that has none. A count counts as a number.
double output_number(const RollingSolution& solution, std::string_view key);

/// The reason of `no_steady_state`.
/// @param needed, given friction coefficients [1]
std::string too_much_traction(double needed, double given);

/// Keys of all outputs, in the order of the list.
std::vector<std::string_view> output_keys();

}  // namespace rollres
