#include "core/zones/spectral_solution.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/newton/surface_window.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/scene/friction_law.hpp"
#include "core/spectral/graded_tractions.hpp"
#include "core/zones/surface_panels.hpp"

namespace rollres {

namespace {

constexpr int intervals_per_half_length = 30;
constexpr double least_wrong = 1e-6;  // violation that calls for another zone, relative

class SpectralAssessment {
 public:
  SpectralAssessment(const SpectralProblem& given_problem, const SpectralState& given_state,
                     const SpectralSurface& surface)
      : problem_(given_problem),
        state_(given_state),
        field_(surface.field),
        panels_(surface.panels),
        of_coating_(surface.coating),
        law_{given_problem.model.friction_coefficient},
        half_(given_state.edges.contact.half_length()) {}

  AssessedSpectral run() {
    measure_contact();
    sum_forces();
    check_laws();
    balance_power();
    keep_fields();
    return std::move(assessed_);
  }

 private:
  bool sheared() const { return state_.pattern.shear; }
  static bool contact(const SurfacePanel& panel) { return panel.zone != Zone::free; }
  /// As the law of friction is imposed.
  Eigen::ArrayXd law_slip(const SurfacePanel& panel) const {
    const double ratio = problem_.shape.law_ratio(state_.rotation_ratio);
    Eigen::ArrayXd values = panel.slope_u;
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      const RigidSlip rigid = problem_.shape.law_slip(panel.x(k));
      values(k) += rigid.forward - ratio * rigid.turning;
    }
    return values;
  }
  /// Velocity of the body relative to the layers over V.
  Eigen::ArrayXd slip(const SurfacePanel& panel) const {
    Eigen::ArrayXd values = panel.slope_u;
    if (panel.coating_u.size() > 0) values += (state_.rotation_ratio - 1) * panel.coating_u;
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      const RigidSlip rigid = problem_.shape.slip(panel.x(k));
      values(k) += rigid.forward - state_.rotation_ratio * rigid.turning;
    }
    return values;
  }

  struct Peak {
    double value, place;
  };
  /// Largest of |value| near its largest value at a node, by golden section between the node's neighbours, of which one
  /// may be the next panel's.
  template <class Value>
  Peak peak(const Value& value, const Eigen::ArrayXd SurfacePanel::*nodes) const {
    std::vector<double> x, at;
    for (const SurfacePanel& panel : panels_) {
      if (!contact(panel)) continue;
      const bool adjoins = !x.empty() && x.back() == panel.x(0);
      for (Eigen::Index k = adjoins ? 1 : 0; k < panel.x.size(); ++k) {
        x.push_back(panel.x(k));
        at.push_back(std::abs((panel.*nodes)(k)));
      }
    }
    const auto place = static_cast<std::size_t>(std::max_element(at.begin(), at.end()) - at.begin());
    double largest = at[place], high = x[place > 0 ? place - 1 : 0], low = x[std::min(place + 1, x.size() - 1)];
    constexpr double golden = 0.6180339887498949;
    double left = high - golden * (high - low), right = low + golden * (high - low);
    double at_left = std::abs(value(left)), at_right = std::abs(value(right));
    for (int step = 0; step < 30; ++step) {
      largest = std::max({largest, at_left, at_right});
      if (at_left > at_right) {
        high = right;
        right = left;
        at_right = at_left;
        left = high - golden * (high - low);
        at_left = std::abs(value(left));
      } else {
        low = left;
        left = right;
        at_left = at_right;
        right = low + golden * (high - low);
        at_right = std::abs(value(right));
      }
    }
    return {largest, 0.5 * (low + high)};
  }

  void measure_contact() {
    const Interval& contact = state_.edges.contact;
    s_.leading_edge = contact.to;
    s_.trailing_edge = contact.from;
    s_.contact_area = 2 * half_;
    s_.approach = state_.approach;
    s_.contact_nodes = static_cast<int>(state_.pressure.coefficients.size());
    for (Eigen::Index k = 0; k < s_.contact_nodes; ++k)
      if (field_.zone(state_.sources(k)) == Zone::slip) ++s_.slip_nodes;
    const Peak pressure = peak([&](double x) { return field_.pressure(x); }, &SurfacePanel::pressure);
    s_.peak_pressure = pressure.value;
    assessed_.peak_place = pressure.place;
    if (sheared()) s_.peak_shear_x = peak([&](double x) { return field_.shear(x); }, &SurfacePanel::shear).value;
  }

  void sum_forces() {
    const ContactModel& model = problem_.model;
    s_.load = state_.load;
    s_.mean_pressure = s_.load / s_.contact_area;
    s_.driving_torque = state_.driving_torque;
    s_.driving_force = state_.driving_force;
    s_.rolling_resistance = s_.driving_force + s_.driving_torque * state_.rotation_ratio / model.radius;
    if (sheared()) {
      s_.rotation_ratio = state_.rotation_ratio;
      s_.rotation_speed = state_.rotation_ratio * model.speed / model.radius;
    }
    s_.rolling_resistance_coefficient = s_.rolling_resistance / s_.load;
  }

  void check_laws() {
    const ContactModel& model = problem_.model;
    const double gap_scale = half_ * half_ / (2 * model.radius), slip_scale = half_ / model.radius;
    const double pressure_scale = s_.peak_pressure, shear_scale = std::max(law_.bound(pressure_scale), 1e-300);
    double worst = 0, load = 0, torque = 0, force = 0;
    const auto violated = [&](double amount) { worst = std::max(worst, std::isnan(amount) ? INFINITY : amount); };
    const auto wrong = [&](double amount) {
      violated(amount);
      if (!(amount <= assessed_.wrong_zone)) assessed_.wrong_zone = std::isnan(amount) ? INFINITY : amount;
    };
    for (const SurfacePanel& panel : panels_) {
      const Eigen::ArrayXd sliding = law_slip(panel);
      for (Eigen::Index k = 0; k < panel.x.size(); ++k) {
        const double x = panel.x(k), p = panel.pressure(k), shear = panel.shear(k);
        if (!contact(panel)) {
          if (std::abs(x) < 0.98 * model.radius) wrong(-panel.gap(k) / gap_scale);
          continue;
        }
        load += panel.weights(k) * problem_.shape.load(x)(p, shear);
        torque += panel.weights(k) * problem_.shape.torque(x)(p, shear);
        force += panel.weights(k) * problem_.shape.driving_force(x)(p, shear);
        if (state_.graded && state_.graded->near_end(x)) continue;
        violated(std::abs(panel.gap(k)) / gap_scale);
        wrong(-p / pressure_scale);
        if (!sheared()) continue;
        const FrictionViolation friction =
            friction_violation(panel.zone, law_.bound(p), shear, 0, sliding(k), 0, shear_scale, slip_scale);
        if (panel.zone == Zone::stick) {
          wrong(friction.shear);
          violated(friction.slip);
          call_for_zone(true, x, friction.shear, shear > 0 ? 1 : -1);
        } else {
          violated(friction.shear);
          wrong(friction.slip);
          call_for_zone(false, x, friction.slip, shear > 0 ? -1 : 1);
        }
      }
    }
    torque += model.radius * problem_.shape.of_coating() * of_coating_.in_torque();
    force -= problem_.shape.of_coating() * of_coating_.pressed;
    // The resultants once more, on the fine points.
    if (model.load) violated(std::abs(load - *model.load) / *model.load);
    if (model.approach) violated(std::abs(s_.approach - *model.approach) / *model.approach);
    violated(std::abs(force - s_.driving_force) / load);
    if (!state_.sticks.empty() && model.drive != Drive::rotation) {
      violated(std::abs(drive_row(model, torque, force) - drive_target(model)) / load);
    }
    assessed_.violation = worst;
    s_.law_violation = state_.graded                ? violated_at_nodes(shear_scale)
                       : problem_.curved(sheared()) ? state_.residuals.cwiseAbs().maxCoeff()
                                                    : worst;
  }

  /// Takes over a point of the contact, from the leading edge on. One that obeys the laws ends a run.
  void call_for_zone(bool in_stick, double x, double amount, int direction) {
    if (!(amount > least_wrong)) {
      run_open_ = false;
      return;
    }
    std::vector<WrongRun>& runs = assessed_.wrong_runs;
    const std::vector<Interval>& sticks = state_.edges.sticks;
    std::size_t zone = 0;
    while (zone < sticks.size() && x > (in_stick ? sticks[zone].to : sticks[zone].from)) ++zone;
    const bool same = run_open_ && runs.back().in_stick == in_stick && runs.back().zone == zone;
    if (!same) runs.push_back({in_stick, zone, direction, x, x, 0});
    WrongRun& run = runs.back();
    run.from = std::min(run.from, x);
    run.to = std::max(run.to, x);
    if (amount > run.amount) {
      run.amount = amount;
      run.direction = direction;
    }
    run_open_ = true;
  }

  /// Where the laws are imposed: at the middles by a linear system, of which the residuals are left, and at nodes but
  /// for the last ones at the ends of zones, and those nearer to them than any force could tell (section 9).
  double violated_at_nodes(double shear_scale) const {
    const GradedTractions& graded = *state_.graded;
    constexpr double last_ones = 6;  // in s
    double worst = state_.residuals.cwiseAbs().maxCoeff();
    for (Eigen::Index j = 0; j < graded.grid.size(); ++j) {
      if (graded.near_end(graded.grid.nodes()[static_cast<std::size_t>(j)].x(), last_ones)) continue;
      worst = std::max(worst, -graded.pressure(j) / s_.peak_pressure);
      if (sheared())
        worst = std::max(worst, (std::abs(graded.shear(j)) - law_.bound(graded.pressure(j))) / shear_scale);
    }
    return worst;
  }

  void balance_power() {
    const ContactModel& model = problem_.model;
    const double turning = state_.rotation_ratio;
    double layer = 0, geometry = 0, friction = 0;  // powers over V
    for (const SurfacePanel& panel : panels_) {
      if (!contact(panel)) continue;
      const Eigen::ArrayXd sliding = slip(panel);
      for (Eigen::Index k = 0; k < panel.x.size(); ++k) {
        const double x = panel.x(k), pressure = panel.weights(k) * panel.pressure(k);
        layer += pressure * panel.slope_w(k);
        const double shear = sheared() ? panel.weights(k) * panel.shear(k) : 0;
        geometry += problem_.shape.unbalanced_power(turning, x)(pressure, shear);
        if (!sheared()) continue;
        layer -= shear * panel.slope_u(k);
        friction += shear * sliding(k);
      }
      if (panel.coating_w.size() > 0)  // which flows at R Omega
        layer +=
            (turning - 1) * (panel.weights * (panel.pressure * panel.coating_w - panel.shear * panel.coating_u)).sum();
    }
    layer -= turning * of_coating_.sheared;
    geometry += (problem_.shape.of_coating() - 1) * (turning - 1) * of_coating_.pressed;
    s_.viscous_loss = model.speed * layer;
    s_.frictional_loss = model.speed * friction;
    const double power = s_.rolling_resistance * model.speed;
    const double least = 1e-6 * s_.load * model.speed * half_ / model.radius;  // an elastic layer resists with nothing
    s_.energy_residual = std::abs(power - s_.viscous_loss - s_.frictional_loss - model.speed * geometry) /
                         std::max(std::abs(power), least);
  }

  void keep_fields() {
    SurfaceFields& fields = s_.fields;
    SurfaceGrid& grid = fields.grid;
    grid.spacing_x = half_ / intervals_per_half_length;
    grid.spacing_y = 1;
    grid.rows = 1;
    const double behind = state_.edges.contact.from - spectral_field_margin * half_;
    const double ahead = std::min(state_.edges.contact.to + spectral_field_margin * half_, panels_.front().to);
    grid.first_column = checked_count(std::ceil(behind / grid.spacing_x), "nodes of the fields");
    grid.columns = checked_count(std::floor(ahead / grid.spacing_x), "nodes of the fields") - grid.first_column + 1;
    const auto columns = static_cast<std::size_t>(grid.columns);
    for (std::vector<double>* values : {&fields.u, &fields.w, &fields.pressure, &fields.shear_x, &fields.slip_x})
      values->assign(columns, 0);
    fields.zone.assign(columns, Zone::free);
    double u = field_.displacement_ahead(problem_, panels_.front().to).u;
    const double approach = std::isnan(state_.approach) ? 0 : state_.approach;
    const double rounding = 1e-9 * half_;  // the window may end where the panels do
    int column = grid.columns - 1;
    for (const SurfacePanel& panel : panels_) {
      const Eigen::ArrayXd moved = u + panel.integrated(panel.slope_u), sliding = slip(panel);
      u = moved(moved.size() - 1);
      for (; column >= 0 && grid.x(column) >= panel.from - rounding; --column) {
        const double x = grid.x(column);
        if (x > panel.to + rounding) continue;
        const auto i = static_cast<std::size_t>(column);
        fields.u[i] = panel.at(moved, x);
        fields.w[i] = problem_.shape.profile(x) - approach - panel.at(panel.gap, x);
        fields.zone[i] = panel.zone;
        if (!contact(panel)) continue;
        fields.pressure[i] = field_.pressure(x);
        fields.shear_x[i] = field_.shear(x);
        if (sheared() && panel.zone == Zone::slip) fields.slip_x[i] = panel.at(sliding, x);
      }
      if (contact(panel))
        fields.panels.push_back({panel.from,
                                 panel.to,
                                 {panel.pressure.begin(), panel.pressure.end()},
                                 {panel.shear.begin(), panel.shear.end()}});
    }
  }

  const SpectralProblem& problem_;
  const SpectralState& state_;
  const SpectralField& field_;
  const std::vector<SurfacePanel>& panels_;
  CoatingMoments of_coating_;
  FrictionLaw law_;
  double half_;
  AssessedSpectral assessed_;
  bool run_open_ = false;  // the last point checked belongs to the last of the wrong runs
  RollingSolution& s_ = assessed_.solution;
};

}  // namespace

AssessedSpectral assess(const SpectralProblem& problem, const SpectralState& state, const SpectralSurface& surface) {
  return SpectralAssessment(problem, state, surface).run();
}

AssessedSpectral assess(const SpectralProblem& problem, const SpectralState& state) {
  return assess(problem, state, SpectralSurface(problem, state));
}

}  // namespace rollres
