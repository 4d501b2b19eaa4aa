#pragma once

/// Where the inside of the layers is looked at: the contact's extent, lines of flow with the thickness that each stands
/// for, and the largest of what is found on them.

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "core/interior/interior_field.hpp"

namespace rollres {

/// Whether tractions and grid are their own mirror images in y, to the last digit as half a grid leaves them.
bool is_mirror_image(const SurfaceFields& fields);

/// The contact's middle and half-length along an axis [m].
struct Extent {
  double middle, half;
};

/// Of a row of nodes. Its edges lie between nodes, so that they move smoothly with the pressures and do not jump with
/// the nodes in contact: near an edge p^2 grows as the distance s from it, the share s/h of a cell is r/(1 - r) with r
/// the ratio of p^2 to that of the neighbour inside.
/// @param pressure at each of `count` nodes   @param first place of the first node   @param spacing h [m]
Extent extent_of_row(const std::function<double(int)>& pressure, int count, double first, double spacing);

std::vector<double> evenly_spaced(double from, double to, int count);

/// Places along a contact's length and as much beside it on both sides.
/// @param thin of half-length and layer's thickness the smaller [m]   @param most of their count
std::vector<double> places_along(const Extent& contact, double thin, InteriorField::Detail detail, int most);

/// How far beside the contact the bonds are looked at, deep ones of which bear tension there [m].
/// @param half of the contact's length   @param layers thickness of those that are not infinite [m]
double beside_at_bonds(double half, double layers);

/// A line with the thickness that it stands for [m].
struct WeightedLine {
  InteriorLine line;
  double weight;
};

/// Lines of Gauss's rule on panels that widen with the distance from the contact.
/// @param half of the contact's length   @param speed V [m/s]
std::vector<WeightedLine> lines_across(const LayeredMedium& medium, double speed, double half, int per_panel);

/// Lines of one layer around a line of it, down to `down` on both sides [m].
/// @param shallowest depth of a line below the contact [m]
std::vector<InteriorLine> lines_around(const InteriorLine& line, const LayeredMedium& medium, double down,
                                       double shallowest);

/// Rows of an upright section: in each layer evenly spaced lines from face to face, in the first one closer near the
/// contact, down to four half-lengths of it. A bond has two rows, one of each layer.
struct SectionRows {
  std::vector<InteriorLine> lines;
  std::vector<double> z;           ///< of each, over the undeformed surface [m]
  std::vector<std::size_t> layer;  ///< of each
};
/// @param half of the contact's length
SectionRows section_rows(const LayeredMedium& medium, bool on_body, double half);

/// States of one line of flow (point, coordinate). @param states of each coordinate (point, line)
template <class States>
Eigen::ArrayXXd at_place(const States& states, Eigen::Index line) {
  Eigen::ArrayXXd of_line(states[0].rows(), static_cast<Eigen::Index>(states.size()));
  for (std::size_t c = 0; c < states.size(); ++c) of_line.col(static_cast<Eigen::Index>(c)) = states[c].col(line);
  return of_line;
}

/// Half of the largest distance between two states of a line of flow, 0 among them.
/// @param states (point, coordinate), whose distances are those of the strain's cycle (interior_summary.hpp)
double amplitude_of(const Eigen::ArrayXXd& states);

/// The same of states at even distances, with three more between two of them.
double amplitude_between_points(const Eigen::ArrayXXd& states);

/// What a layer's amplitude is the mean of, summed over its lines of flow.
struct CycleSums {
  double lost = 0, by_loss = 0;
  double energy = 0, by_energy = 0;
  double peak = 0;  ///< [1]

  /// @param width that a line stands for   @param loss of the line, of either sign
  /// @param strain_energy  of the line, in any unit
  void add(double width, double loss, double strain_energy, double amplitude);
  /// By the loss of the lines; where nothing is lost, by their strain energy [1].
  double mean() const;
};

/// Evenly spaced lines from one end of a panel to the other, for fields that are known on its lines of Gauss's rule:
/// fields are smooth over the depth, the amplitude of their cycle has kinks, where other states become the farthest.
class LinesBetween {
 public:
  /// @param per_panel lines of Gauss's rule   @param count of these lines, odd
  LinesBetween(int per_panel, int count);

  /// Values on these lines (point, line) from those on the panel's lines of Gauss's rule.
  template <class Values>
  Eigen::MatrixXd operator()(const Values& on_gauss_lines) const {
    return on_gauss_lines.matrix() * from_gauss_;
  }
  /// The lines, each with its share of the panel's width by Simpson's rule.
  /// @param panel its lines of Gauss's rule
  std::vector<WeightedLine> lines(std::span<const WeightedLine> panel) const;

 private:
  Eigen::MatrixXd from_gauss_;  // (line of Gauss's rule, line)
};

/// The largest of values at evenly spaced places, by the parabola through its neighbours.
struct Largest {
  double place = 0, value = 0;
};
Largest largest_of(const std::vector<double>& x, const Eigen::ArrayXd& values);

}  // namespace rollres
