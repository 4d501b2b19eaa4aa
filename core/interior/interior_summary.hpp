#pragma once

/// What designers ask of the inside of the layers: the largest shear strain, the amplitude of the strain's cycle, what
/// bonds bear, and where power is lost. Fields and their theory: interior_field.hpp.
///
/// The shear strain is that of plane strain, gamma = sqrt((epsilon_x - epsilon_z)^2 + gamma_xz^2). Material flows along
/// lines of one depth; the cycle's amplitude is half of the largest distance between two points (epsilon_x - epsilon_z,
/// gamma_xz) of a line, the unstrained state ahead among them: of a strain that only oscillates, its amplitude.

#include <vector>

#include "core/interior/interior_field.hpp"
#include "core/scene/scene.hpp"

namespace rollres {

/// Layers on one side of the contact: those under the body or those on it, where z and the shear are mirrored.
struct LayersInside {
  bool on_body;
  InteriorField field;

  /// Height over the undeformed surface, negative under the body [m].
  double height_of(const InteriorLine& line) const { return (on_body ? 1 : -1) * field.depth_of(line); }
};

/// @param reach up to which |x| fields are wanted [m]
std::vector<LayersInside> layers_inside(const RollingScene& scene, const SurfaceFields& fields, double reach,
                                        InteriorField::Detail detail);

/// One line of flow.
struct LineOfFlow {
  bool on_body;
  std::size_t layer;        ///< counted from the contact, from 0
  double z;                 ///< height over the undeformed surface [m]
  double thickness;         ///< that it stands for [m]
  double loss;              ///< [W/m2]: of a metre of length, per depth
  double strain_amplitude;  ///< [1]
};

struct LayerLoss {
  bool on_body;
  std::size_t layer;
  double loss;                   ///< [W/m]
  double strain_amplitude;       ///< mean over its lines by their loss, or by thickness where nothing is lost [1]
  double peak_strain_amplitude;  ///< [1]
};

/// The bond on the far side of a layer.
struct Bond {
  bool on_body;
  std::size_t layer;
  double z;                       ///< [m]
  double shear = 0, shear_x = 0;  ///< largest |tau_xz| and where [Pa], [m]
  double tension = 0, tension_x = 0;
};

struct InteriorSummary {
  std::vector<LineOfFlow> lines;
  std::vector<LayerLoss> layers;
  std::vector<Bond> bonds;
  double half_length = 0;                                  ///< of the contact, on a grid with edges between nodes [m]
  double loss = 0;                                         ///< [W/m]
  double strain_amplitude = 0, peak_strain_amplitude = 0;  ///< as of a layer, of all [1]
  double peak_shear_strain = 0, peak_x = 0, peak_z = 0;    ///< with Detail::surface; [1], [m], [m]
};

/// @param scene of a cylinder, a single passage   @param fields of its solution
InteriorSummary interior_summary(const RollingScene& scene, const SurfaceFields& fields, InteriorField::Detail detail);

/// The outputs of a solution that come from the inside.
void add_interior(const RollingScene& scene, RollingSolution& solution);

/// Fields on a section x-z of all layers on one side, down to some half-lengths of the contact.
struct InteriorSection {
  bool on_body;
  std::vector<double> x, z;        ///< [m]; z ascending in distance from the contact; at a bond twice
  std::vector<std::size_t> layer;  ///< of each z
  InteriorFields fields;           ///< (x, z), z upwards
};
std::vector<InteriorSection> interior_sections(const RollingScene& scene, const SurfaceFields& fields);

/// The scene as it was solved: with the moduli at its strains in place of what says how they depend on them, and the
/// flow of a coating that the drive decided.
RollingScene solved_scene(const RollingScene& scene, const RollingSolution& solution);

}  // namespace rollres
