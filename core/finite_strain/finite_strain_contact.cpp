#include "core/finite_strain/finite_strain_contact.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>

#include "core/finite_strain/mesh_level.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/stated_error.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/surface/edge_peak.hpp"

namespace rollres {

namespace {

/// Cells in the contact, mesh by mesh.
constexpr int meshes[] = {8, 12, 17, 24, 34, 48, 68, 96};
/// At least so many where no tolerance is given: then peaks and edges are as good as the resistance.
constexpr int usual_cells = 17;
/// Change of an edge by the half-width that needs no further coarse mesh.
constexpr double settled = 0.03;
/// What edges and peaks may still change from one mesh to the next, by the tolerance of the resistance, and at least.
constexpr double looser = 5, least_change = 5e-3;
/// A resistance below so much of the load's lever is rounding and the mesh's.
constexpr double negligible = 1e-3;

class FiniteStrainSolution {
 public:
  explicit FiniteStrainSolution(const ContactModel& model) : model_(model), problem_(model) {
    tolerance_ = model.tolerance.value_or(default_finite_tolerance);
  }

  RollingSolution run() {
    solution_.method = Method::finite_strain;
    if (!find_contact()) return refuse();
    refine();
    if (solution_.status == Status::converged) warn_of_peaks();
    return std::move(solution_);
  }

 private:
  bool advance(const ContactEdges& edges, int cells) {
    auto next = std::make_unique<MeshLevel>(problem_, edges, cells);
    outcome_ = next->solve(level_.get());
    solution_.iterations += outcome_.steps;
    if (!outcome_.converged) return false;
    level_ = std::move(next);
    return true;
  }

  /// Loads or approaches step by step on coarse meshes, each from the answer before. @return whether the whole is
  /// reached
  bool press_gradually() {
    const FiniteProblem whole = problem_;
    constexpr double least_step = 1.0 / 64;
    double reached = 0;
    for (double step = 1.0 / 3; reached < 1 && step >= least_step;) {
      const double share = std::min(1.0, reached + step);
      for (auto input : {&ContactModel::load, &ContactModel::approach, &ContactModel::driving_torque})
        if (whole.model.*input) problem_.model.*input = share * *(whole.model.*input);
      problem_.approach = share * whole.approach;
      ContactEdges edges = level_ ? level_->edges() : ContactEdges{};
      const double wider = std::sqrt(reached > 0 ? share / reached : share);
      edges.leading *= wider;
      edges.trailing *= wider;
      if (advance(edges, meshes[0])) {
        reached = share;
        step *= 1.5;
      } else {
        step /= 2;
      }
    }
    problem_.model = whole.model;
    problem_.approach = whole.approach;
    if (reached < 1)
      outcome_.reason +=
          message_text("; of the ", model_.load ? "load" : "approach", " ", 100 * reached, " % have an answer");
    return reached == 1;
  }

  /// A coarse mesh, made anew for the edges that it finds.
  bool find_contact() {
    ContactEdges edges;
    if (!advance(edges, meshes[0]) && !press_gradually()) return false;
    edges = level_->edges();
    constexpr int most_passes = 6;
    for (int pass = 0; pass < most_passes; ++pass) {
      if (!advance(edges, meshes[0])) return true;
      const ContactEdges found = level_->edges();
      const double half = 0.5 * (found.leading - found.trailing);
      if (!(half > 0)) return false;
      const double change =
          std::max(std::abs(found.leading - edges.leading), std::abs(found.trailing - edges.trailing)) / half;
      edges = found;
      if (change < settled) break;
    }
    return true;
  }

  void refine() {
    take_answer();
    for (const int cells : meshes) {
      if (cells == meshes[0]) continue;
      try {
        if (!advance(level_->edges(), cells)) break;
      } catch (const BeyondLimits& limit) {
        if (std::isnan(solution_.error_estimate)) throw;
        outcome_.reason = limit.what();
        break;
      }
      const RollingSolution before = solution_;
      take_answer();
      const double error = std::max({std::abs(solution_.rolling_resistance - before.rolling_resistance), unbalanced_,
                                     problem_.modulus * problem_.length * level_->contact().friction_power_missed()});
      solution_.rolling_resistance_error = error;
      solution_.error_estimate = error / std::abs(solution_.rolling_resistance);
      changed_ = change_of_contact(before);
      if (error <= tolerance_ * scale() && changed_ <= std::max(looser * tolerance_, least_change) &&
          (model_.tolerance || level_->cells() >= usual_cells))
        return;
    }
    if (std::isnan(solution_.error_estimate)) {
      clear(outcome_.reason);
      return;
    }
    if (solution_.rolling_resistance_error > tolerance_ * scale())
      solution_.warnings.push_back(tolerance_missed(
          tolerance_, solution_, message_text(level_->cells(), " cells in the contact"), outcome_.reason));
    else
      solution_.warnings.push_back(message_text("length and peaks of the contact still changed by ", changed_,
                                                " with the last mesh, of ", level_->cells(), " cells in the contact",
                                                outcome_.reason.empty() ? "" : "; ", outcome_.reason));
  }

  /// Largest relative change of the contact's length, the peak pressure and the peak shear (by the peak pressure).
  double change_of_contact(const RollingSolution& before) const {
    const RollingSolution& now = solution_;
    const auto relative = [](double a, double b, double scale) { return std::abs(a - b) / scale; };
    return std::max(
        {relative(now.contact_area, before.contact_area, now.contact_area),
         relative(now.peak_pressure, before.peak_pressure, now.peak_pressure),
         model_.friction_coefficient > 0 ? relative(now.peak_shear_x, before.peak_shear_x, now.peak_pressure) : 0.0});
  }

  double lever() const {
    return solution_.load * std::max(std::abs(solution_.leading_edge), std::abs(solution_.trailing_edge)) /
           model_.radius;
  }
  double scale() const { return std::max(std::abs(solution_.rolling_resistance), negligible * lever()); }

  void take_answer() {
    RollingSolution& s = solution_;
    const FiniteContact& contact = level_->contact();
    const FiniteState& state = level_->state();
    const double force = problem_.modulus * problem_.length;
    s.status = Status::converged;
    s.load = force * contact.load();
    s.approach = problem_.length * state.approach;
    s.driving_force = force * contact.driving_force();
    s.driving_torque = 0;
    s.rolling_resistance = s.driving_force;
    const bool covered = problem_.covered, friction = model_.friction_coefficient > 0;
    s.viscous_loss = (covered ? state.rotation_ratio : 1) * model_.speed * force * level_->layer().taken_power();
    s.frictional_loss = 0;
    if (covered || friction) {
      s.driving_torque = force * problem_.length * contact.torque();
      s.rotation_ratio = state.rotation_ratio;
      s.rotation_speed = state.rotation_ratio * model_.speed / model_.radius;
      s.rolling_resistance = force * contact.resistance();
    }
    if (friction) s.frictional_loss = model_.speed * force * contact.friction_power();
    s.rolling_resistance_coefficient = s.rolling_resistance / s.load;
    const ContactEdges edges = level_->edges();
    s.leading_edge = problem_.length * level_->moved(edges.leading).x();
    s.trailing_edge = problem_.length * level_->moved(edges.trailing).x();
    s.contact_area = s.leading_edge - s.trailing_edge;
    s.mean_pressure = s.load / s.contact_area;
    unbalanced_ = std::abs(s.rolling_resistance - (s.viscous_loss + s.frictional_loss) / model_.speed);
    s.energy_residual = unbalanced_ / std::max(std::abs(s.rolling_resistance), 1e-6 * lever());
    s.law_violation = contact.law_violation();
    s.model = message_text("; finite strain: ", hyperelastic_law(),
                           ", viscous overstresses linear in the second Piola-Kirchhoff "
                           "stress (Simo, Holzapfel); deformed positions against the ",
                           covered ? "plane, the layers under the body taken as rigid; mesh of " : "circle; mesh of ",
                           level_->layer().mesh().cells_along(), " x ", level_->layer().mesh().cells_down(), " cells, ",
                           level_->cells(), " in the contact");
    take_fields(edges);
  }

  /// Of the layers that flow.
  std::string_view hyperelastic_law() const {
    const auto stiffens = [](const FlowingMaterial& solid) { return solid.yeoh.second != 0 || solid.yeoh.third != 0; };
    const auto count = std::count_if(problem_.materials.begin(), problem_.materials.end(), stiffens);
    if (count == 0) return "neo-Hookean";
    return count == std::ssize(problem_.materials) ? "Yeoh's solid" : "neo-Hookean and Yeoh's solids";
  }

  /// Peaks, and fields at places of the undeformed surface, 30 to the half-width of the contact there, as far as the
  /// mesh goes.
  void take_fields(const ContactEdges& edges) {
    RollingSolution& s = solution_;
    const std::vector<SurfaceNode>& nodes = level_->contact().surface();
    const bool friction = model_.friction_coefficient > 0;
    s.contact_nodes = s.slip_nodes = 0;
    for (const SurfaceNode& node : nodes) {
      if (node.zone == Zone::free) continue;
      ++s.contact_nodes;
      if (friction && node.zone == Zone::slip) ++s.slip_nodes;
    }
    const std::vector<MeshLevel::Traction> tractions = level_->tractions();
    s.peak_pressure = problem_.modulus * peak(tractions);
    if (friction) {
      s.peak_shear_x = 0;
      for (const MeshLevel::Traction& at : tractions)
        s.peak_shear_x = std::max(s.peak_shear_x, problem_.modulus * std::abs(at.shear));
    }

    // What acts on a cover acts on the layer the other way; its mesh is seen from below (README, section 6).
    const double upon_layer = problem_.covered ? -1 : 1;
    constexpr int per_half_width = 30;
    constexpr double margin = 2;  // half-widths on either side
    const double half = 0.5 * (edges.leading - edges.trailing), step = half / per_half_width;
    SurfaceFields& fields = s.fields;
    fields = {};
    SurfaceGrid& grid = fields.grid;
    grid.spacing_x = problem_.length * step;
    grid.spacing_y = 1;
    grid.rows = 1;
    const double behind = std::max(edges.trailing - margin * half, nodes.back().place);
    const double ahead = std::min(edges.leading + margin * half, nodes.front().place);
    grid.first_column = checked_count(std::ceil(behind / step), "nodes of the fields");
    grid.columns = checked_count(std::floor(ahead / step), "nodes of the fields") - grid.first_column + 1;
    for (int column = 0; column < grid.columns; ++column) {
      const double place = step * (grid.first_column + column);
      const Eigen::Vector2d moved = level_->moved(place) - level_->layer().mesh().rest(place, 0);
      fields.u.push_back(problem_.length * upon_layer * moved.x());
      fields.w.push_back(problem_.length * moved.y());
      // Rounding may put a place beyond the first or the last node.
      const auto after = std::find_if(nodes.begin() + 1, nodes.end() - 1,
                                      [&](const SurfaceNode& node) { return node.place <= place; });
      const auto next = static_cast<std::size_t>(after - nodes.begin());
      const std::size_t nearest = place - nodes[next].place < nodes[next - 1].place - place ? next : next - 1;
      const bool contact = place > edges.trailing && place < edges.leading;
      const Zone zone = nodes[nearest].zone == Zone::free ? Zone::slip : nodes[nearest].zone;
      fields.zone.push_back(contact ? zone : Zone::free);
      const MeshLevel::Traction traction = contact ? between(tractions, edges, place) : MeshLevel::Traction{};
      fields.pressure.push_back(problem_.modulus * traction.pressure);
      fields.shear_x.push_back(problem_.modulus * upon_layer * traction.shear);
      fields.slip_x.push_back(contact && friction && zone == Zone::slip ? level_->contact().slip(nearest) : 0);
    }
  }

  /// The top of the parabola through the largest pressure and its neighbours.
  static double peak(const std::vector<MeshLevel::Traction>& at) {
    const auto most =
        std::max_element(at.begin(), at.end(), [](const auto& a, const auto& b) { return a.pressure < b.pressure; });
    if (most == at.begin() || most + 1 == at.end()) return most->pressure;
    const double ahead = (most - 1)->place - most->place, behind = (most + 1)->place - most->place;
    const double up = ((most - 1)->pressure - most->pressure) / ahead,
                 down = ((most + 1)->pressure - most->pressure) / behind;
    const double bend = (up - down) / (ahead - behind), slope = up - bend * ahead;
    return most->pressure - slope * slope / (4 * bend);
  }

  void warn_of_peaks() {
    const auto warn = [&](std::string_view output, double peak, auto MeshLevel::Traction::*traction) {
      std::vector<double> sizes;
      for (const MeshLevel::Traction& at : level_->tractions())
        sizes.push_back(problem_.modulus * std::abs(at.*traction));
      std::string line = unresolved_peak(output, peak, sizes, 3, "mesh", "tolerance");
      if (!line.empty()) solution_.warnings.push_back(std::move(line));
    };
    warn("peak_pressure", solution_.peak_pressure, &MeshLevel::Traction::pressure);
    if (solution_.peak_shear_x > 0) warn("peak_shear_x", solution_.peak_shear_x, &MeshLevel::Traction::shear);
  }

  /// On straight lines between the places where tractions are known, and to 0 at the edges.
  static MeshLevel::Traction between(const std::vector<MeshLevel::Traction>& at, const ContactEdges& edges,
                                     double place) {
    const auto next = std::find_if(at.begin(), at.end(), [&](const auto& known) { return known.place <= place; });
    const MeshLevel::Traction before = next == at.begin() ? MeshLevel::Traction{edges.leading, 0, 0} : *(next - 1);
    const MeshLevel::Traction after = next == at.end() ? MeshLevel::Traction{edges.trailing, 0, 0} : *next;
    const double t = before.place > after.place ? (before.place - place) / (before.place - after.place) : 0;
    return {place, (1 - t) * before.pressure + t * after.pressure, (1 - t) * before.shear + t * after.shear};
  }

  void clear(const std::string& reason) {
    const int iterations = solution_.iterations;
    solution_ = {};
    solution_.iterations = iterations;
    solution_.method = Method::finite_strain;
    solution_.reason = reason;
  }

  /// What the drive asks friction for, by the resistance without friction; 0 where none of it is needed.
  double friction_needed() {
    if (model_.friction_coefficient == 0 || model_.drive == Drive::rotation || model_.drive == Drive::free) return 0;
    if (model_.drive == Drive::torque && model_.load)
      return std::abs(*model_.driving_torque) / (model_.radius * *model_.load);
    if (model_.drive == Drive::torque) return 0;
    ContactModel smooth = problem_.model;
    smooth.friction_coefficient = 0;
    problem_.model = smooth;
    level_.reset();
    // The second mesh is made for the edges found on the first.
    for (const int cells : {meshes[0], meshes[1]})
      if (!advance(level_ ? level_->edges() : ContactEdges{}, cells)) return 0;
    return std::abs(level_->contact().resistance()) / (2 * level_->contact().load());
  }

  RollingSolution refuse() {
    const double needed = friction_needed(), given = model_.friction_coefficient;
    clear(outcome_.reason.empty() ? "no contact was found" : outcome_.reason);
    if (needed > given) {
      solution_.status = Status::no_steady_state;
      solution_.friction_needed = needed;
      solution_.reason = too_much_traction(needed, given);
    }
    return std::move(solution_);
  }

  const ContactModel& model_;
  FiniteProblem problem_;
  double tolerance_, unbalanced_ = 0, changed_ = 0;
  std::unique_ptr<MeshLevel> level_;
  FiniteOutcome outcome_;
  RollingSolution solution_;
};

}  // namespace

RollingSolution solve_finite_strain(const ContactModel& model) { return FiniteStrainSolution(model).run(); }

}  // namespace rollres
