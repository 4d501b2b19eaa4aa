#pragma once

/// The answer to a scene, as a plain value, with the evidence for it.

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
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
  std::vector<double> temperatures;           // of all steady states, ascending [K]
  std::vector<double> sublayer_temperatures;  // from the contact away [K]; empty: all at mean_temperature
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

/// The outputs in the order in which all walk them.
using ListedOutput = ListedQuantity<RollingSolution, double, int, std::string, std::vector<double>,
                                    std::vector<std::string>, Method, Status>;
std::span<const ListedOutput> listed_outputs();

/// Walks the outputs: `visitor(quantity, value)`, value being double, int, an enumeration with ChoiceNames,
/// std::string, std::vector<double> or std::vector<std::string>. An output that is also an input (load, approach,
/// driving_torque, rotation_ratio, spacing, method) has the same key: it is the value found or used.
template <class Solution, class Visitor>
void visit_outputs(Solution& solution, Visitor&& visitor) {
  visit_listed(solution, listed_outputs(), visitor);
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
