#pragma once

/// What designers ask of the inside of the layers: the largest shear strain, the amplitude of the strain's cycle, what
/// bonds bear, and where power is lost. Fields and their theory: interior_field.hpp, volume_field.hpp.
///
/// The largest shear strain is the difference of the outer principal strains, under a cylinder of those in its plane,
/// sqrt((epsilon_x - epsilon_z)^2 + gamma_xz^2), if it is not skewed. Material flows along lines of one y and one
/// depth; the cycle's amplitude is half of the largest distance between two states of a line, the unstrained one ahead
/// among them: of a strain that only oscillates, its amplitude. The distance of two states is sqrt((epsilon_x -
/// epsilon_z)^2 + gamma_xz^2 + gamma_yz^2 + gamma_xy^2) of their difference under a cylinder, sqrt(2 e : e) of its
/// deviator e under a sphere, the same in plane strain without change of volume.

#include <vector>

#include "core/interior/interior_lines.hpp"
#include "core/interior/volume_field.hpp"
#include "core/model/contact_model.hpp"

namespace rollres {

/// Lines of flow at one depth: under a cylinder one, under a sphere those of all y.
struct LineOfFlow {
  bool on_body;
  std::size_t layer;        ///< of the model, counted from the contact, from 0
  double z;                 ///< height over the undeformed surface [m]
  double thickness;         ///< that it stands for [m]
  double loss;              ///< of a metre of depth: [W/m2], per metre of a cylinder's length; sphere [W/m]
  double strain_amplitude;  ///< of a sphere's, mean by their loss (of what loses nothing, by strain energy) [1]
  double energy;            ///< amplitude squared, of a sphere's summed over y [1], [m]
};

struct LayerLoss {
  bool on_body;
  std::size_t layer;
  double loss;                   ///< [W/m]; sphere [W]
  double strain_amplitude;       ///< mean over its lines by their loss, or by strain energy where nothing is lost [1]
  double amplitude_error;        ///< estimated, of that mean by its quadrature [1]
  double peak_strain_amplitude;  ///< of lines from one face to the other, without the first of Gauss's rule [1]
};

/// The bond on the far side of a layer.
struct Bond {
  bool on_body;
  std::size_t layer;
  double z;                                    ///< [m]
  double shear = 0, shear_x = 0, shear_y = 0;  ///< largest shear stress and where [Pa], [m]
  double tension = 0, tension_x = 0, tension_y = 0;
};

struct InteriorSummary {
  std::vector<LineOfFlow> lines;
  std::vector<LayerLoss> layers;
  std::vector<Bond> bonds;
  double half_length = 0;                                  ///< of the contact along x, on a grid between nodes [m]
  double loss = 0;                                         ///< [W/m]; sphere [W]
  double strain_amplitude = 0, peak_strain_amplitude = 0;  ///< as of a layer, of all [1]
  double peak_shear_strain = 0;                            ///< with Detail::surface [1]
  double peak_x = 0, peak_y = 0, peak_z = 0;  ///< where; y >= 0 where a contact is its own mirror image [m]
};

/// @param model of a single passage, with what the answer decided (`with_answer`)   @param fields of its solution
InteriorSummary interior_summary(const ContactModel& model, const SurfaceFields& fields, InteriorField::Detail detail);

/// Of an answer, with Detail::surface; layers are those of the scene, whose sublayers are taken together.
InteriorSummary inside_of_answer(const ContactModel& model, const RollingSolution& solution);

/// Losses and amplitudes of layers and of all of them, from the lines and from those between them.
/// @param between of each layer, in the order of the lines   @param missed  of amplitudes, between the points of a line
/// [1]
void add_totals(InteriorSummary& summary, const std::vector<CycleSums>& between, double missed = 0);

/// The outputs of a solution that come from the inside.
void add_interior(const ContactModel& model, RollingSolution& solution);

/// Fields on a section of all layers on one side, down to some half-lengths of the contact; of a cylinder and, at
/// the middle of the contact, of a sphere x-z, of a sphere also x-y: its surface and its bonds.
struct InteriorSection {
  bool on_body;
  std::vector<double> x, y, z;     ///< [m]; one y or one z; z ascending in distance from the contact; at a bond twice
  std::vector<std::size_t> layer;  ///< of each z
  VolumeFields fields;             ///< (x, place), places of z and y, z upwards; what is 0 by symmetry is empty

  bool is_face() const { return y.size() > 1; }
};
std::vector<InteriorSection> interior_sections(const ContactModel& model, const SurfaceFields& fields);

/// Largest shear strain at (x, place); without strains along y that in the plane.
Eigen::ArrayXXd largest_shear_strain(const VolumeFields& fields);

/// What tau_xz and tau_yz are together on a plane of z at (x, place) [Pa].
Eigen::ArrayXXd shear_on_bond(const VolumeFields& fields);

/// Fields as outputs count z, upwards also in the layers on the body.
void turn_upwards(InteriorSection& section);

}  // namespace rollres
