#pragma once

/// What is solved: a scene resolved into one body, one surface and one steady motion, as a plain value. Of a cylinder
/// all is per metre of its length here, whether or not the scene gives a width; `solve` counts its answer for the body.
///
/// A scene is a question; a model is the plan to answer it. `ContactModel(scene)` takes the scene as it stands and
/// decides what follows from it alone: whether inertia counts, and which method solves it. `resolve`
/// (solve/resolve.hpp) leaves out what a tolerance allows to leave out. Solvers, estimates and fields take the model
/// and ask nobody else; what changes with the answer makes a new model (`with_flow`, `with_softening`).

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/material/material.hpp"
#include "core/model/loaded_area.hpp"
#include "core/model/roller_outline.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"
#include "core/surface/layer_compliance.hpp"

namespace rollres {

/// One layer of a model.
struct ModelLayer : BondedLayer {
  CreepSpectrum creep;            // of its material, at its temperature and at the strain amplitude taken
  double modulus_at_rest = 0;     // G'(0) [Pa]
  double ring_radius = INFINITY;  // of its face towards the contact, if it is a ring on the core; infinite: flat [m]
  bool continues = false;         // the layer before it: both are sublayers of one layer of the scene

  explicit ModelLayer(BondedLayer inputs, const SofteningFactors& factors = {});

  /// Makes creep and modulus at rest those of its inputs as they are now, times the factors of moduli.
  void take_material(const SofteningFactors& factors = {});
};

/// Of each layer the place of the scene's layer that it is, or is a sublayer of, among those on its side.
std::vector<std::size_t> layers_of_scene(const std::vector<ModelLayer>& layers);

/// A contact before it is solved (estimate/grid_choice.hpp).
struct ContactEstimate {
  double half_width;      ///< a [m], along the motion; radius of the contact for a sphere
  double approach;        ///< d [m]; NaN for a cylinder on a half-space, where it is not defined
  double load;            ///< P [N/m] for a cylinder, [N] for a sphere
  double elongation = 1;  ///< half-width across the motion over that along it, of a roller [1]
};

struct ContactModel {
  /// The scene as it stands, with nothing left out; what the heat of rolling would warm is as cold as the air. @pre it
  /// obeys `check`
  ContactModel(const RollingScene& scene);

  Indenter indenter;
  int dimension;                                         // 2: per metre of length, no y; or 3
  double radius;                                         // R [m]
  std::optional<RollerOutline> outline;                  // of a roller
  std::optional<LoadedArea> loaded;                      // in place of a body; its radius is half of its length
  std::vector<std::array<double, 2>> deflection_places;  // (x, y) of that [m]
  std::optional<double> width;  // of a cylinder whose load is told in N [m]; the rest here is per metre
  Kinematics kinematics;

  double speed;                          // V; of a skewed cylinder V cos a, square to its axle [m/s]
  double skew;                           // tan a of an axle that is turned to the left by a [1]
  double camber;                         // g by which the left end of a sphere's axle is raised [rad]
  double pivot;                          // of a sphere about z over its path [1/m]
  std::optional<double> side_force;      // in place of the skew: of a cylinder along its axle [N/m]; of a sphere along
                                         // y [N]
  std::optional<double> load, approach;  // P [N/m] or [N], or d [m]
  double friction_coefficient;           // mu [1]
  std::optional<double> traction_limit;  // tau_max [Pa]
  double adhesion_threshold;             // [Pa]
  Drive drive;
  std::optional<double> driving_torque;  // T [N] (per metre) or [N m], with drive "torque"
  std::optional<double> rotation_ratio;  // R Omega over that speed [1], with drive "rotation"

  std::vector<ModelLayer> foundation;  // under the body, from the contact down; at least one
  std::vector<ModelLayer> coating;     // on the body, from its surface inwards
  bool half_space;                     // lies below all layers of the scene: then a cylinder has no approach
  double flow;                         // R Omega/V at which the coating flows through the contact [1]
  bool inertia;                        // of the layers is part of the model
  bool inertia_automatic;              // so decided by `rayleigh_number`, not by the scene
  std::optional<double> period;        // L [m]
  int series_terms;

  Method asked_method, method;              // as the scene names it, and what solves it first
  std::optional<double> spacing;            // a [m]
  std::optional<double> tolerance;          // what is left for numbers [1]
  std::optional<double> asked_tolerance;    // of it [1]
  std::optional<ContactEstimate> estimate;  // of the contact, and
  std::optional<double> coating_share;  // of the coating in what it yields in passage [1]; both made by `simplified`
  double left_out = 0;                  // estimate of what simplifications change R_r by [1]
  std::vector<std::string> decisions;   // simplifications in words, each with the number it rests on
  SlipStencil slip_stencil;             // of method active_set, as are the next three
  double slip_threshold;
  Resticking resticking;
  SlipRule slip_rule;

  /// Whether a cylinder rolls askew. The model is in the frame of its axle: x square to it, y along it.
  bool skewed() const { return dimension == 2 && (skew != 0 || side_force); }
  /// Whether the contact is its own mirror image in y. The model of a sphere is in the frame of the travel.
  bool mirrored() const {
    const bool straight = skew == 0 && camber == 0 && pivot == 0 && !side_force;
    return dimension == 2 || has_mirror(friction_coefficient > 0, straight, outline);
  }
  /// Whether it is a roller whose outline is given by points.
  bool profiled() const { return outline && outline->is_profile(); }
  /// Unit vector along the axle, to its left end.
  std::array<double, 3> axle() const;
  /// Whether there are displacements, and with friction tractions, along y.
  bool lateral() const { return dimension == 3 || (skewed() && friction_coefficient > 0); }
  /// The same with another skew, tan a.
  ContactModel with_skew(double tangent) const;
  /// Whether its loads and torques are told per metre of a cylinder, and one of them as it is told [N/m], or [N].
  bool told_per_metre() const { return dimension == 2 && !width; }
  double told(double per_metre) const { return per_metre * width.value_or(1); }
  /// All layers, under the body from the contact and then on it.
  std::vector<const ModelLayer*> layers() const;
  /// Of all coatings together [m].
  double coating_thickness() const;
  /// The top layer under the body.
  const ModelLayer& top() const { return foundation.front(); }
  /// Whether the surface is more than one layer of one material without inertia.
  bool composite() const { return foundation.size() > 1 || !coating.empty() || inertia || rings(foundation); }
  /// Whether layers are rings on a core and not flat: the coating, or the foundation of a coating alone.
  static bool rings(const std::vector<ModelLayer>& layers) {
    return !layers.empty() && std::isfinite(layers.front().ring_radius);
  }
  bool ring() const { return rings(coating) || rings(foundation); }
  /// The single layer of a surface that is not composite.
  Layer layer() const { return {top().layer_thickness, top().poisson_ratio}; }

  /// The same at another speed of the coating through the contact, R Omega/V: inertia and method are decided anew.
  ContactModel with_flow(double ratio) const;
  /// The same with the moduli of each layer, under the body from the contact and then on it, times its factors; none
  /// for the layers beyond the list.
  ContactModel with_softening(const std::vector<SofteningFactors>& factors) const;
  /// The same with the layers that heat warms in sublayers at these temperatures [K], as many in each (`in_sublayers`).
  /// Factors of moduli are lost.
  ContactModel with_temperatures(const std::vector<double>& temperatures) const;
  /// The same with the temperatures, the moduli at its strains and the flow of its coating that an answer found.
  ContactModel with_answer(const RollingSolution& solution) const;
  /// Decides anew which method solves it: where layers were left out.
  void choose_method();
  /// Takes a cylinder's coating without inertia as a ring on the core, if it is thicker than this part of the radius.
  void bend_coating(double least);

 private:
  /// Speeds in the frame of the axle turned to a skew; nothing is decided anew.
  void turn_axle(double tangent);
  const std::vector<ModelLayer>& warmed() const { return coating.empty() ? foundation : coating; }
  /// Its warmed layers in sublayers at these temperatures; nothing is decided anew.
  void warm(const std::vector<double>& temperatures);
  void decide();
};

/// What rho V^2/G must stay below for steady motion: 1 at the speed of Rayleigh waves on a half-space of the layer at
/// rest, for the layer that is nearest to it; a coating moves at R Omega [1].
double rayleigh_number(const ContactModel& model);

/// rho V^2/G beyond which inertia would change the resistance by more than a thousandth and more than a tenth of the
/// tolerance given [1].
double negligible_inertia(const ContactModel& model);

}  // namespace rollres
