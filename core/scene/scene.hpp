#pragma once

/// A scene: a rigid cylinder or sphere in steady motion over a viscoelastic layer, as a plain value.
///
/// The body of radius R moves at speed V along +x; the frame moves with it, x = 0 lies under its axis and the leading
/// edge of the contact at x > 0. The layer of thickness H is bonded to a rigid base. All numbers are SI.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scene/bonded_layer.hpp"
#include "core/scene/quantity.hpp"

namespace rollres {

/// What drives the body.
enum class Drive {
  top_force,  ///< a horizontal force Q at the top of the body, so that T = Q R
  torque,     ///< the torque T about its axis is given (`driving_torque`)
  free,       ///< T = 0: the body is pulled at its axis
  rotation    ///< R Omega / V is given (`rotation_ratio`); 0 is a locked, sliding body
};
template <>
struct ChoiceNames<Drive> {
  static constexpr std::array<std::string_view, 4> names{"top_force", "torque", "free", "rotation"};
};

enum class Method {
  automatic,      ///< spectral for a cylinder, newton for a sphere, with a spacing or where spectral does not apply
  newton,         ///< coupled semi-smooth Newton method (newton_contact.hpp)
  newton_dense,   ///< the same with dense linear algebra: the second route
  active_set,     ///< the algorithms of Zehil and Gavin (2013), normal and tangential problem in turn
  spectral,       ///< continuous edges of contact, without a grid (spectral_contact.hpp); cylinder
  finite_strain,  ///< displacements and strains that are not small, on a mesh of the layers (finite_strain_contact.hpp)
  convolution     ///< tractions are given, and move the surface (given_pressure.hpp); indenter pressure
};
template <>
struct ChoiceNames<Method> {
  static constexpr std::array<std::string_view, 7> names{"automatic", "newton",        "newton_dense", "active_set",
                                                         "spectral",  "finite_strain", "convolution"};
};

/// Whether the method solves on a grid, and takes a spacing.
inline bool on_grid(Method method) {
  return method == Method::newton || method == Method::newton_dense || method == Method::active_set ||
         method == Method::convolution;
}

/// Difference that turns surface displacements into slip along a row of nodes.
enum class SlipStencil { forward, central, backward };
template <>
struct ChoiceNames<SlipStencil> {
  static constexpr std::array<std::string_view, 3> names{"forward", "central", "backward"};
};

enum class Resticking { on, off };
template <>
struct ChoiceNames<Resticking> {
  static constexpr std::array<std::string_view, 2> names{"on", "off"};
};

/// How the zones of stick and slip change in 3D (stick_slip.hpp).
enum class SlipRule { projected, printed };
template <>
struct ChoiceNames<SlipRule> {
  static constexpr std::array<std::string_view, 2> names{"projected", "printed"};
};

/// What the forces of the contact do to the body, and what counts as slip (indenter_shape.hpp).
enum class Kinematics {
  consistent,  ///< resultants and slip are each other's conjugates: power balances in every solution
  printed      ///< as Zehil and Gavin (2013) print them: the power is off by terms of second order in the slope
};
template <>
struct ChoiceNames<Kinematics> {
  static constexpr std::array<std::string_view, 2> names{"consistent", "printed"};
};

/// What the outline of a crowned roller is, in a section through its axle.
enum class Crown {
  circle,  ///< an arc of the transverse radius, as drawings of rollers have it
  ellipse  ///< that of an ellipsoid of the same curvature at its largest radius
};
template <>
struct ChoiceNames<Crown> {
  static constexpr std::array<std::string_view, 2> names{"circle", "ellipse"};
};

/// The part of the surface on which a given pressure acts, and how it is spread there (core/model/loaded_area.hpp).
enum class PressureShape { ellipse, rectangle };
template <>
struct ChoiceNames<PressureShape> {
  static constexpr std::array<std::string_view, 2> names{"ellipse", "rectangle"};
};
enum class PressureDistribution { uniform, hertz };
template <>
struct ChoiceNames<PressureDistribution> {
  static constexpr std::array<std::string_view, 2> names{"uniform", "hertz"};
};

/// Whether the layers' inertia is part of the model.
enum class Inertia {
  automatic,  ///< where it matters to a given tolerance, of a cylinder or in a periodic train
  off,
  on
};
template <>
struct ChoiceNames<Inertia> {
  static constexpr std::array<std::string_view, 3> names{"automatic", "off", "on"};
};

/// Whether what goes on inside the layers is part of the answer.
enum class Interior { off, on };
template <>
struct ChoiceNames<Interior> {
  static constexpr std::array<std::string_view, 2> names{"off", "on"};
};

/// Whether the heat of rolling warms the layers, and the temperatures of its steady state are part of the answer.
enum class Heat { off, on };
template <>
struct ChoiceNames<Heat> {
  static constexpr std::array<std::string_view, 2> names{"off", "on"};
};

/// What the core of the warmed layers, or the other face of a belt, does with heat.
enum class CoreHeat {
  automatic,  ///< takes it as core_temperature and core_heat_transfer say, and without them none
  insulated   ///< takes none
};
template <>
struct ChoiceNames<CoreHeat> {
  static constexpr std::array<std::string_view, 2> names{"automatic", "insulated"};
};

/// The inputs; those of the first layer are the base.
struct RollingScene : BondedLayer {
  Indenter indenter = Indenter::cylinder;
  double radius = 0;                        // R; of a given pressure half its length along the motion [m]
  std::optional<double> transverse_radius;  // of a roller's crown, across the motion; half a pressure's width [m]
  Crown crown = Crown::circle;
  std::vector<double> profile_places;   // of a profiled roller, along its axle to the left, rising [m]
  std::vector<double> profile_heights;  // there, over its lowest point, where its radius is R [m]
  PressureShape pressure_shape = PressureShape::ellipse;  // of a given pressure, as are the next four
  PressureDistribution pressure_distribution = PressureDistribution::uniform;
  double traction_coefficient = 0;          // tau_x on the surface over p [1]
  std::vector<double> deflection_places_x;  // where the answer tells the deflection, from the load's middle [m],
  std::vector<double> deflection_places_y;  // and across the motion [m]
  std::optional<double> width;  // of a cylinder whose load, torque, forces and powers are those of the whole body [m]
  BondedLayers lower_layers;    // bonded under the first, from above; under the last a rigid base
  BondedLayers coating_layers;  // bonded on the body, from its surface inwards to a rigid core
  Inertia inertia = Inertia::automatic;
  double speed = 0;                      // V [m/s]
  std::optional<double> load;            // P [N], of a cylinder without a width [N/m]; this or
  std::optional<double> approach;        // d [m]
  double friction_coefficient = 0;       // mu [1]
  std::optional<double> traction_limit;  // tau_max: |tau| <= min(mu p, tau_max) [Pa]
  Drive drive = Drive::top_force;
  std::optional<double> driving_torque;  // T [N m], of a cylinder without a width [N], with drive "torque"
  std::optional<double> rotation_ratio;  // R Omega / V [1], with drive "rotation"
  std::optional<double> skew_angle;      // a of the axle, to the left of across the travel [rad]
  std::optional<double> axial_force;     // along a cylinder's axle, in place of it [N/m], or [N] with a width
  std::optional<double> lateral_force;   // on a sphere along y, in place of it [N]
  double camber_angle = 0;               // g of a sphere's axle, its left end raised [rad]
  double pivot = 0;                      // of a sphere about z over its path: the path's curvature, to the left [1/m]
  Kinematics kinematics = Kinematics::consistent;
  double adhesion_threshold = 0;    // [Pa]
  std::optional<double> spacing;    // a [m]; this or
  std::optional<double> tolerance;  // [1]; neither: 1e-8 (spectral) or the program's own grid
  Method method = Method::automatic;
  Interior interior = Interior::off;
  Heat heat = Heat::off;
  std::optional<double> thermal_conductivity;   // k of all warmed layers [W/m/K]
  std::optional<double> heat_capacity;          // of their volume [J/m3/K]
  std::optional<double> turn_length;            // of a belt: after which it comes round again [m]
  std::optional<double> surface_heat_transfer;  // h of the face to the air [W/m2/K]
  std::optional<double> ambient_temperature;    // of the air [K]
  double ground_effusivity = 0;                 // of what the face touches [W s^(1/2)/m2/K]; 0: takes no heat
  std::optional<double> ground_temperature;     // [K]; absent: the air's
  CoreHeat core = CoreHeat::automatic;
  std::optional<double> core_temperature;           // [K]
  std::optional<double> core_heat_transfer;         // to that, or to the air's [W/m2/K]
  int thermal_sublayers = 1;                        // of each warmed layer, each at its own temperature; 1: all at one
  std::optional<double> time_limit;                 // of processor time [s]; absent: 60 s
  std::optional<double> memory_limit;               // [byte]; absent: a quarter of the machine's, 4 GB at most
  std::optional<double> period;                     // L [m]; absent: a single passage
  int series_terms = 2000;                          // [1], with period: wavenumbers kept in each direction
  SlipStencil slip_stencil = SlipStencil::forward;  // active_set
  double slip_threshold = 1e-9;                     // w_th / V [1], active_set
  Resticking resticking = Resticking::on;           // active_set in 2D
  SlipRule slip_rule = SlipRule::projected;         // active_set in 3D
};

/// The inputs of a scene beside those of its first layer: of the body, which come before these, and all others after
/// them.
using SceneInput = ListedQuantity<RollingScene, double, int, std::optional<double>, std::vector<double>, BondedLayers,
                                  Indenter, Crown, PressureShape, PressureDistribution, Inertia, Drive, Kinematics,
                                  Method, Interior, Heat, CoreHeat, SlipStencil, Resticking, SlipRule>;
std::span<const SceneInput> listed_body_inputs();
std::span<const SceneInput> listed_motion_inputs();

/// Walks the inputs: `visitor(quantity, value)`, value being a reference to double, int, std::optional<double>, an
/// enumeration with ChoiceNames or, for lists, std::vector<double> or BondedLayers. Works on const and non-const
/// scenes.
template <class Scene, class Visitor>
void visit_inputs(Scene& scene, Visitor&& visitor) {
  visit_listed(scene, listed_body_inputs(), visitor);
  visit_layer_inputs(scene, visitor);
  visit_listed(scene, listed_motion_inputs(), visitor);
}

/// Keys of all inputs, in the order of the list.
std::vector<std::string_view> input_keys();

/// Whether the axle is turned, or bears a force that turns it.
inline bool is_skewed(const RollingScene& scene) {
  return scene.skew_angle.value_or(0) != 0 || scene.axial_force || scene.lateral_force;
}
/// Whether the motion is its own mirror image in y.
inline bool is_straight(const RollingScene& scene) {
  return !is_skewed(scene) && scene.camber_angle == 0 && scene.pivot == 0;
}

/// The body on which the units of the scene and of its answer depend.
inline Body body_of(const RollingScene& scene) { return {scene.indenter, scene.width.has_value()}; }

/// Length of the body to which loads, forces, torques and powers of the scene belong: its width, or 1 m of it [m].
inline double body_length(const RollingScene& scene) { return scene.width.value_or(1); }

}  // namespace rollres
