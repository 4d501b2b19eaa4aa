#include "core/finite_strain/mesh_level.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/estimate/grid_choice.hpp"
#include "core/material/prony_series.hpp"
#include "core/model/contact_surface.hpp"

namespace rollres {

namespace {

/// Bulk modulus over shear modulus that stands for an incompressible material.
constexpr double nearly_incompressible = 1e6;

/// @param speed  of the flow at the surface; a material at rest answers with its modulus at rest
FlowingMaterial flowing(const ModelLayer& layer, double speed, double length, double modulus) {
  const RelaxationSpectrum relaxation = relaxation_spectrum(layer.creep);
  FlowingMaterial material{.modulus = relaxation.instantaneous / modulus, .terms = {}};
  for (const RelaxationSpectrum::Term& term : relaxation.terms) {
    if (!(term.modulus > 0)) continue;
    if (speed > 0)
      material.terms.push_back({term.modulus / modulus, term.time * speed / length});
    else
      material.modulus -= term.modulus / modulus;
  }
  const double nu = layer.poisson_ratio;
  material.yeoh = {layer.yeoh_second, layer.yeoh_third};
  material.bulk_relaxes = nu < 0.5;
  material.bulk_ratio =
      nu < 0.5 ? std::min(2 * (1 + nu) / (3 * (1 - 2 * nu)), nearly_incompressible) : nearly_incompressible;
  return material;
}

/// Index of the interval of descending borders that holds a value, the first or the last beyond them.
int interval(const std::vector<double>& borders, double value) {
  const auto next = std::upper_bound(borders.begin(), borders.end(), value, std::greater<>());
  return std::clamp(static_cast<int>(next - borders.begin()) - 1, 0, static_cast<int>(borders.size()) - 2);
}

/// Values of the three quadratics of a cell at a part of its length.
Eigen::Vector3d quadratic_values(double s) { return {(1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1)}; }

double part(const std::vector<double>& borders, int at, double value) {
  const auto i = static_cast<std::size_t>(at);
  return std::clamp((borders[i] - value) / (borders[i] - borders[i + 1]), 0.0, 1.0);
}

Eigen::Vector2d displacement_at(const FlowingLayer& layer, const Vector& unknowns, double x, double z) {
  const LayerMesh& mesh = layer.mesh();
  const int e = interval(mesh.x, x), r = interval(mesh.z, z);
  const Eigen::Vector3d along = quadratic_values(part(mesh.x, e, x)), down = quadratic_values(part(mesh.z, r, z));
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      if (2 * r + k < mesh.free_rows())
        moved += along(i) * down(k) * unknowns.segment<2>(layer.numbering().node(2 * e + i, 2 * r + k));
  return moved;
}

}  // namespace

FiniteProblem::FiniteProblem(const ContactModel& given) : model(given), covered(!given.coating.empty()) {
  const ContactEstimate estimate = estimate_contact(given);
  const std::vector<ModelLayer>& layers = covered ? given.coating : given.foundation;
  length = std::min(estimate.half_width, 0.8 * given.radius);
  modulus = layers.front().modulus_at_rest;
  // Over a half-space, which is rigid beside a cover, the estimate has none: then that of a row of springs.
  const double approach_guess =
      std::isfinite(estimate.approach) ? estimate.approach : length * length / (2 * given.radius);
  approach = std::min(approach_guess, 0.5 * layers.front().layer_thickness) / length;
  model.estimate.reset();
  model.radius /= length;
  if (model.load) *model.load /= modulus * length;
  if (model.approach) approach = *model.approach /= length;
  if (model.driving_torque) *model.driving_torque /= modulus * length * length;
  const double flow = covered ? given.flow : 1;
  for (const ModelLayer& layer : layers) {
    materials.push_back(flowing(layer, flow * given.speed, length, modulus));
    thicknesses.push_back(layer.layer_thickness / length);
  }
}

MeshLevel::MeshLevel(const FiniteProblem& problem, const ContactEdges& edges, int cells)
    : problem_(problem),
      given_(edges),
      cells_(cells),
      layer_(layer_mesh({edges.trailing, edges.leading, cells, problem.thicknesses,
                         problem.covered ? 1 / problem.model.radius : 0}),
             problem.materials, problem.model.friction_coefficient > 0 ? 2 : 1),
      contact_(problem.model, layer_) {}

void MeshLevel::take_over(const MeshLevel& from) {
  const LayerMesh &mesh = layer_.mesh(), &old = from.layer_.mesh();
  const Numbering& numbers = layer_.numbering();
  for (int column = 1; column < numbers.columns; ++column) {
    const double x = mesh.node_x(column);
    for (int row = 0; row < numbers.free_rows; ++row)
      state_.unknowns.segment<2>(numbers.node(column, row)) =
          displacement_at(from.layer_, from.state_.unknowns, x, mesh.node_z(row));
    // Nodes' forces over their lengths, on straight lines between nodes.
    const std::vector<SurfaceNode>& nodes = from.contact_.surface();
    const int e = interval(old.x, x);
    const double s = 2 * part(old.x, e, x);
    const auto left = static_cast<std::size_t>(2 * e + (s < 1 ? 0 : 1));
    const double t = s < 1 ? s : s - 1;
    const auto between = [&](double SurfaceNode::*force) {
      return mesh.share(column) *
             ((1 - t) * nodes[left].*force / nodes[left].share + t * nodes[left + 1].*force / nodes[left + 1].share);
    };
    state_.unknowns(numbers.surface(column, 0)) = between(&SurfaceNode::normal);
    if (numbers.extra > 1) state_.unknowns(numbers.surface(column, 1)) = between(&SurfaceNode::shear);
  }
  for (int r = 0; r < mesh.cells_down(); ++r)
    for (int e = 0; e < mesh.cells_along(); ++e) {
      const double x = mesh.node_x(2 * e + 1), z = mesh.node_z(2 * r + 1);
      const int old_e = interval(old.x, x), old_r = interval(old.z, z);
      const Eigen::Vector3d before = from.state_.pressures.col(old_r * old.cells_along() + old_e);
      const double along = 2 * part(old.x, old_e, x) - 1, down = 2 * part(old.z, old_r, z) - 1;
      state_.pressures.col(r * mesh.cells_along() + e) << before.dot(Eigen::Vector3d(1, along, down)),
          before(1) * mesh.length(e) / old.length(old_e), before(2) * mesh.height(r) / old.height(old_r);
    }
  state_.approach = from.state_.approach;
  state_.rotation_ratio = from.state_.rotation_ratio;
}

FiniteOutcome MeshLevel::solve(const MeshLevel* start) {
  const bool friction = problem_.model.friction_coefficient > 0;
  const auto rest = [&] {
    state_.unknowns = Vector::Zero(layer_.numbering().size());
    state_.pressures = Eigen::Matrix3Xd::Zero(3, layer_.cells());
    state_.approach = problem_.approach;
    state_.rotation_ratio = problem_.model.rotation_ratio.value_or(1);
  };
  rest();
  int steps = 0;
  const auto attempt = [&](bool with_friction, bool sticking) {
    FiniteOutcome outcome = contact_.solve(state_, with_friction, sticking);
    outcome.steps = steps += outcome.steps;
    return outcome;
  };
  FiniteOutcome outcome;
  if (start) {
    take_over(*start);
    outcome = attempt(friction, false);
    if (outcome.converged) return outcome;
    rest();
  }
  outcome = attempt(false, false);
  if (!friction || !outcome.converged) return outcome;
  return attempt(true, problem_.model.drive != Drive::rotation);
}

int MeshLevel::first_cell() const {
  const std::vector<double>& x = layer_.mesh().x;
  const double rounding = 1e-9 * (given_.leading - given_.trailing);
  return static_cast<int>(std::find_if(x.begin(), x.end(), [&](double at) { return at <= given_.leading + rounding; }) -
                          x.begin());
}

/// Force ahead of each corner of the contact's cells.
std::vector<double> MeshLevel::summed(double SurfaceNode::*force) const {
  const std::vector<SurfaceNode>& nodes = contact_.surface();
  const LayerMesh& mesh = layer_.mesh();
  const int first = first_cell();
  std::vector<double> sums{0};
  for (std::size_t i = 0; i <= static_cast<std::size_t>(2 * first); ++i)
    sums.front() += nodes[i].*force * (i < static_cast<std::size_t>(2 * first)
                                           ? 1
                                           : mesh.length(first - 1) / (mesh.length(first - 1) + mesh.length(first)));
  for (int e = first; e < first + cells_; ++e) {
    const auto at = static_cast<std::size_t>(2 * e);
    const double h = mesh.length(e);
    const auto part_of = [&](std::size_t node, double beyond) { return nodes[node].*force * h / (h + beyond); };
    sums.push_back(sums.back() + part_of(at, mesh.length(e - 1)) + nodes[at + 1].*force +
                   part_of(at + 2, mesh.length(e + 1)));
  }
  return sums;
}

double MeshLevel::density(const std::vector<double>& sums, int corner) const {
  // The sum is odd about both ends, where the traction is the root of the distance.
  const auto sum = [&](int k) {
    if (k < 0) return 2 * sums.front() - sums[static_cast<std::size_t>(-k)];
    if (k > cells_) return 2 * sums.back() - sums[static_cast<std::size_t>(2 * cells_ - k)];
    return sums[static_cast<std::size_t>(k)];
  };
  const double step = std::numbers::pi / cells_, half = 0.5 * (given_.leading - given_.trailing);
  return (sum(corner - 2) - 8 * sum(corner - 1) + 8 * sum(corner + 1) - sum(corner + 2)) / (12 * step) /
         (half * std::sin(step * corner));
}

ContactEdges MeshLevel::edges() const {
  const std::vector<SurfaceNode>& nodes = contact_.surface();
  const auto contact = [](const SurfaceNode& node) { return node.zone != Zone::free; };
  const auto first = std::find_if(nodes.begin(), nodes.end(), contact);
  const auto last = std::find_if(nodes.rbegin(), nodes.rend(), contact);
  if (first == nodes.end()) return {0, 0};
  const std::vector<double> sums = summed(&SurfaceNode::normal);
  double all = 0;
  for (const SurfaceNode& node : nodes) all += node.normal;
  // The force between an edge and a place at a distance d from it grows like d^(3/2) (1 + ...): where the parabola
  // through its power 2/3 at three corners of cells ends, near the last node in contact.
  const auto edge = [&](const SurfaceNode& inside, const SurfaceNode& outside, bool leading) {
    const double between = 0.5 * (inside.place + outside.place);
    Eigen::Vector3d x, y;
    int found = 0, passed = 0;
    for (int k = 1; k < cells_ && found < 3; ++k) {
      const auto corner = static_cast<std::size_t>(leading ? k : cells_ - k);
      const double place = layer_.mesh().x[static_cast<std::size_t>(first_cell()) + corner];
      if (leading ? place >= inside.place : place <= inside.place) continue;
      if (++passed < 2) continue;
      x(found) = place;
      y(found++) = std::cbrt(std::pow(leading ? sums[corner] : all - sums[corner], 2));
    }
    if (found < 3) return between;
    const double first_slope = (y(1) - y(0)) / (x(1) - x(0)), second_slope = (y(2) - y(1)) / (x(2) - x(1));
    const double bend = (second_slope - first_slope) / (x(2) - x(0));
    double place = between;
    for (int pass = 0; pass < 20; ++pass)
      place -= (y(0) + (place - x(0)) * (first_slope + bend * (place - x(1)))) /
               (first_slope + bend * (2 * place - x(0) - x(1)));
    // The last node in contact bears what lies up to a cell further inside.
    const double within = inside.place - 2 * (outside.place - inside.place);
    if (!std::isfinite(place)) return between;
    return std::clamp(place, std::min(within, outside.place), std::max(within, outside.place));
  };
  return {.trailing = edge(*last, *(last - 1), false), .leading = edge(*first, *(first - 1), true)};
}

Eigen::Vector2d MeshLevel::moved(double place) const {
  return layer_.mesh().rest(place, 0) + displacement_at(layer_, state_.unknowns, place, 0);
}

std::vector<MeshLevel::Traction> MeshLevel::tractions() const {
  const std::vector<SurfaceNode>& nodes = contact_.surface();
  const std::vector<double> normal = summed(&SurfaceNode::normal), shear = summed(&SurfaceNode::shear);
  std::vector<Traction> found;
  for (int corner = 1; corner < cells_; ++corner) {
    const auto i = static_cast<std::size_t>(2 * (first_cell() + corner));
    const double ahead = nodes[i - 1].place - nodes[i].place, behind = nodes[i].place - nodes[i + 1].place;
    const double stretch = ((nodes[i - 1].position - nodes[i].position) / ahead * behind +
                            (nodes[i].position - nodes[i + 1].position) / behind * ahead)
                               .norm() /
                           (ahead + behind);
    found.push_back({nodes[i].place, density(normal, corner) / stretch, density(shear, corner) / stretch});
  }
  return found;
}

}  // namespace rollres
