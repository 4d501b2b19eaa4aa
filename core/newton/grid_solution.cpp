#include "core/newton/grid_solution.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/edge/contact_outline.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/absent_outputs.hpp"
#include "core/model/contact_surface.hpp"
#include "core/newton/contact_powers.hpp"

namespace rollres {

namespace {

class Assessment {
 public:
  Assessment(const ContactProblem& given_problem, const InfluenceOperator& influence, const ContactUnknowns& given,
             const std::vector<Zone>& given_zone, const EdgeCorrection& edge)
      : problem_(given_problem),
        edge_(edge),
        unknowns_(given),
        zone_(given_zone),
        moved_(influence.apply(given.pressure, shear_or_zero(given.shear_x), lateral_shear(given))),
        coating_(moved_coating(influence, given)),
        powers_(contact_powers(given_problem, moved_, coating_, given, given_zone)) {}

  GridSolution run() {
    measure_contact();
    sum_forces();
    measure_slip();
    check_laws();
    balance_power();
    keep_fields();
    return {std::move(s_), powers_};
  }

 private:
  // Without friction the shear is zero, but the pressure moves the surface sideways all the same.
  Vector shear_or_zero(const Vector& shear) const {
    return shear.size() > 0 ? shear : Vector(Vector::Zero(problem_.grid.size()));
  }
  Vector lateral_shear(const ContactUnknowns& given) const {
    return problem_.lateral ? shear_or_zero(given.shear_y) : Vector();
  }
  Eigen::Index moved_index(Eigen::Index node) const {
    const Eigen::Index columns = problem_.grid.columns;
    return node / columns * (columns + 1) + node % columns;
  }
  bool contact(Eigen::Index node) const { return zone_[static_cast<std::size_t>(node)] != Zone::free; }
  double shear_x(Eigen::Index node) const { return problem_.friction ? unknowns_.shear_x(node) : 0; }
  double shear_y(Eigen::Index node) const { return unknowns_.shear_y.size() > 0 ? unknowns_.shear_y(node) : 0; }

  void measure_contact() {
    const SurfaceGrid& grid = problem_.grid;
    double leading = -INFINITY, trailing = INFINITY;
    if (problem_.friction) s_.peak_shear_x = 0;
    if (problem_.friction && problem_.lateral) s_.peak_shear_y = 0;
    for (Eigen::Index i = 0; i < grid.size(); ++i) {
      if (!contact(i)) continue;
      s_.contact_nodes += problem_.images(i);
      if (zone_[static_cast<std::size_t>(i)] == Zone::slip) s_.slip_nodes += problem_.images(i);
      const double x = grid.x(static_cast<int>(i % grid.columns));
      leading = std::max(leading, x);
      trailing = std::min(trailing, x);
      if (problem_.friction) s_.peak_shear_x = std::max(s_.peak_shear_x, std::abs(shear_x(i)));
      if (problem_.friction && problem_.lateral) s_.peak_shear_y = std::max(s_.peak_shear_y, std::abs(shear_y(i)));
    }
    take_outline();
    s_.spacing = grid.spacing_x;
    half_length_ = std::max(0.5 * (leading - trailing + grid.spacing_x), grid.spacing_x);
    s_.approach = why_absent(problem_.model, "approach").empty() ? unknowns_.approach : RollingSolution::absent;
  }

  void take_outline() {
    s_.peak_pressure = 0;
    if (!(unknowns_.pressure.maxCoeff() > 0)) return;
    const ContactOutline outline = contact_outline(problem_.model, problem_.grid, unknowns_.pressure);
    s_.leading_edge = outline.leading;
    s_.trailing_edge = outline.trailing;
    if (problem_.plane) s_.half_width = outline.half_width;
    s_.edge_error = outline.edge_error;
    s_.contact_area = outline.area;
    s_.contact_area_error = outline.area_error;
    s_.peak_pressure = outline.peak;
    s_.peak_pressure_error = outline.peak_error;
    if (!problem_.plane) return;
    Eigen::Index largest = 0;
    unknowns_.pressure.maxCoeff(&largest);
    const SurfaceGrid& grid = problem_.grid;
    s_.peak_pressure_x = grid.x(static_cast<int>(largest) % grid.columns);
    s_.peak_pressure_y = grid.y(static_cast<int>(largest) / grid.columns);
  }

  void sum_forces() {
    const Vector &pressure = unknowns_.pressure, &shear = unknowns_.shear_x, &across = unknowns_.shear_y;
    s_.load = problem_.load(pressure, shear, across);
    s_.mean_pressure = s_.load / s_.contact_area;
    s_.rolling_resistance = powers_.resultants;
    const double turning = problem_.turning_ratio(unknowns_.rotation_ratio), radius = problem_.model.radius;
    const double of_coating = problem_.shape.of_coating() * powers_.coating.pressed;
    if (problem_.friction) {
      s_.driving_torque =
          problem_.torque(pressure, shear, across) + radius * problem_.shape.of_coating() * powers_.coating.in_torque();
      s_.driving_force = problem_.driving_force(pressure, shear, across) - of_coating;
      s_.rotation_ratio = turning;
      s_.rotation_speed = turning * problem_.model.speed / radius;
    } else {
      // The pressure on the layers passes through the axis: it is the driving force alone that overcomes its horizontal
      // part.
      s_.driving_torque = radius * of_coating;
      s_.driving_force = s_.rolling_resistance - turning * of_coating;
    }
    sum_sideways();
    s_.rolling_resistance_coefficient = s_.rolling_resistance / s_.load;
  }

  /// Forces across the travel, or along the axle of a skewed cylinder, and moments about the middle of the axle.
  void sum_sideways() {
    const Vector &pressure = unknowns_.pressure, &along = unknowns_.shear_x, &across = unknowns_.shear_y;
    const IndenterShape& shape = problem_.shape;
    const double force = problem_.side_force(pressure, along, across);
    if (problem_.model.skewed()) s_.axial_force = force;
    if (problem_.model.mirrored()) return;
    s_.lateral_force = force;
    s_.spin_moment =
        problem_.sum_of(pressure, along, across, [&](double x, double y) { return shape.spin_moment(x, y); });
    s_.overturning_moment =
        problem_.sum_of(pressure, along, across, [&](double x, double y) { return shape.overturning(x, y); });
  }

  /// Slip over speed at contact nodes, by the scene's stencil for the paper's method, forward otherwise.
  void measure_slip() {
    if (!problem_.friction) return;
    const SurfaceGrid& grid = problem_.grid;
    slip_x_ = slip_y_ = Vector::Zero(grid.size());
    const bool own_stencil = problem_.model.method == Method::active_set;
    const SlipStencil stencil = own_stencil ? problem_.model.slip_stencil : SlipStencil::forward;
    for (Eigen::Index i = 0; i < grid.size(); ++i) {
      if (!contact(i)) continue;
      const Eigen::Index at = moved_index(i), column = i % grid.columns;
      const Eigen::Index right = stencil == SlipStencil::backward && column > 0 ? at : at + 1;
      const Eigen::Index left = stencil == SlipStencil::forward || column == 0 ? at : at - 1;
      const double distance = static_cast<double>(right - left) * grid.spacing_x;
      slip_x_(i) = problem_.slip_x(i, (moved_.u(right) - moved_.u(left)) / distance, unknowns_.rotation_ratio);
      if (problem_.lateral)
        slip_y_(i) = problem_.slip_y(i, (moved_.v(right) - moved_.v(left)) / distance, unknowns_.rotation_ratio);
    }
    if (problem_.lateral) problem_.edge.add(unknowns_.shear_x, unknowns_.shear_y, slip_x_, slip_y_);
  }

  void check_laws() {
    const ContactModel& model = problem_.model;
    const double gap_scale = half_length_ * half_length_ / (2 * model.radius);
    const double slip_scale = half_length_ / model.radius;
    const double pressure_scale = std::max(s_.peak_pressure, 1e-300);
    const double shear_scale = std::max(problem_.law.bound(pressure_scale), 1e-300);
    double worst = s_.contact_nodes > 0 ? 0 : 1;
    const auto violated = [&](double amount) { worst = std::max(worst, std::isnan(amount) ? INFINITY : amount); };
    for (Eigen::Index i = 0; i < problem_.grid.size(); ++i) {
      const double gap = problem_.profile(i) - unknowns_.approach - moved_.w(moved_index(i));
      const double pressure = unknowns_.pressure(i);
      if (!contact(i)) {
        violated(std::abs(pressure) / pressure_scale);
        violated(std::hypot(shear_x(i), shear_y(i)) / shear_scale);
        violated(-gap / gap_scale);
        continue;
      }
      violated(std::abs(gap) / gap_scale);
      violated((-pressure - model.adhesion_threshold) / pressure_scale);
      if (!problem_.friction) continue;
      const FrictionViolation friction =
          friction_violation(zone_[static_cast<std::size_t>(i)], problem_.law.bound(pressure), shear_x(i), shear_y(i),
                             slip_x_(i), slip_y_(i), shear_scale, slip_scale);
      violated(friction.shear);
      violated(friction.slip);
    }
    if (model.load) violated(std::abs(s_.load - *model.load) / *model.load);
    if (model.approach) violated(std::abs(unknowns_.approach - *model.approach) / *model.approach);
    if (problem_.friction && !problem_.rotation_given())
      violated(
          std::abs(problem_.drive_surplus(unknowns_.pressure, unknowns_.shear_x, unknowns_.shear_y, powers_.coating)) /
          s_.load);
    s_.law_violation = worst;
  }

  void balance_power() {
    const double speed = problem_.model.speed;
    powers_.take(edge_);
    s_.viscous_loss = speed * powers_.layer;
    s_.frictional_loss = speed * powers_.friction;
    add_resistance(problem_.model, powers_.resistance() - powers_.resultants, s_);
    if (powers_.share > 0.01)
      s_.model += "; rolling resistance from the losses, share " + message_text(powers_.share) +
                  ", as the resultants are a small difference";
    s_.energy_residual = powers_.missing() / powers_.scale();
  }

  void keep_fields() {
    const SurfaceGrid& half = problem_.grid;
    SurfaceFields& fields = s_.fields;
    fields.grid = mirrored(half);
    const auto keep = [&](const Vector& values, double parity) { return on_whole_grid(half, values, parity); };
    const Vector zero = Vector::Zero(half.size());
    fields.w = keep(at_nodes(half, moved_.w), 1);
    fields.pressure = keep(unknowns_.pressure, 1);
    fields.u = keep(at_nodes(half, moved_.u), 1);
    fields.shear_x = keep(problem_.friction ? unknowns_.shear_x : zero, 1);
    fields.slip_x = keep(problem_.friction ? slip_x_ : zero, 1);
    if (problem_.lateral) {
      fields.v = keep(at_nodes(half, moved_.v), -1);
      fields.shear_y = keep(problem_.friction ? unknowns_.shear_y : zero, -1);
      fields.slip_y = keep(problem_.friction ? slip_y_ : zero, -1);
    }
    Vector zones(half.size());
    for (Eigen::Index i = 0; i < zones.size(); ++i) zones(i) = static_cast<double>(zone_[static_cast<std::size_t>(i)]);
    const Vector whole = mirrored(half, zones, 1);
    for (const double value : whole) fields.zone.push_back(static_cast<Zone>(static_cast<int>(value)));
  }

  const ContactProblem& problem_;
  const EdgeCorrection& edge_;
  const ContactUnknowns& unknowns_;
  const std::vector<Zone>& zone_;
  Displacements moved_, coating_;
  ContactPowers powers_;
  Vector slip_x_, slip_y_;
  double half_length_ = 0;
  RollingSolution s_;
};

}  // namespace

GridSolution summarise(const ContactProblem& problem, const InfluenceOperator& influence,
                       const ContactUnknowns& unknowns, const std::vector<Zone>& zone, const EdgeCorrection& edge) {
  return Assessment(problem, influence, unknowns, zone, edge).run();
}

}  // namespace rollres
