#include "core/spectral/zoned_system.hpp"

#include <optional>
#include <string>

#include "core/messages/message_text.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/spectral/spectral_memory.hpp"

namespace rollres {

using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

ZonedSystem::ZonedSystem(const SpectralProblem& problem, const SlipPattern& pattern, const SpectralEdges& edges)
    : problem_(problem),
      pattern_(pattern),
      edges_(edges),
      friction_(pattern.shear ? problem.model.friction_coefficient : 0),
      terms_(problem.terms()) {}

void ZonedSystem::place_unknowns(Index contact, const std::vector<Index>& in_sticks) {
  slack_ = contact;
  amplitude_ = contact + 1;
  rotation_ = amplitude_ + terms_;
  for (std::size_t z = 0; z < in_sticks.size(); ++z) {
    sticks_.push_back({edges_.sticks[z], rotation_, in_sticks[z]});
    rotation_ += in_sticks[z] + 1 + terms_;
  }
  size_ = rotation_ + (sticks_.empty() ? 0 : 1);
  const auto unknowns = static_cast<double>(size_), copies = 2.0;  // with the means; the factorisation has its own
  const std::string what = message_text(size_, " unknowns of continuous edges, ", terms_, " retardation times");
  require_memory(8 * unknowns * (copies * unknowns + copies * static_cast<double>(terms_)), what);
  require_factorisation(unknowns, what);
  matrix_ = MatrixXd::Zero(size_, size_);
  right_ = VectorXd::Zero(size_);
}

void ZonedSystem::remember(Index amplitude, const MatrixXd& means) {
  for (Index j = 0; j < terms_; ++j) {
    require_time();
    auto row = matrix_.row(amplitude + j);
    row += problem_.relaxation_modulus[static_cast<std::size_t>(j)] * (problem_.memory_factor.row(j) * means);
    row(amplitude + j) += 1;
  }
}

void ZonedSystem::prescribe_contact(const VectorXd& points) {
  const PrescribedSlope body(problem_, edges_.contact, points, [&](double x) { return problem_.shape.slope(x); });
  right_.head(points.size()) = body.elastic;
  right_.segment(amplitude_, terms_) = body.amplitude;
}

void ZonedSystem::prescribe_stick(const Stick& stick, const VectorXd& points) {
  auto column = matrix_.col(rotation_);
  column.segment(stick.first, points.size()).setConstant(-1);
  for (Index j = 0; j < terms_; ++j)
    column(stick.amplitude() + j) = -problem_.relaxation_modulus[static_cast<std::size_t>(j)] / problem_.rubbery;
  if (problem_.shape.slips_evenly()) return;
  const PrescribedSlope turning(problem_, stick.interval, points,
                                [&](double x) { return problem_.shape.law_slip(x).turning - 1; });
  column.segment(stick.first, points.size()) -= turning.elastic / problem_.rubbery;
  column.segment(stick.amplitude(), terms_) -= turning.amplitude / problem_.rubbery;
  const PrescribedSlope known(problem_, stick.interval, points, [&](double x) {
    const RigidSlip rigid = problem_.shape.law_slip(x);
    return rigid.turning - rigid.forward;
  });
  right_.segment(stick.first, points.size()) += known.elastic;
  right_.segment(stick.amplitude(), terms_) += known.amplitude;
}

std::pair<RowVectorXd, double> ZonedSystem::drive_row() const {
  const ContactModel& model = problem_.model;
  const double half = edges_.contact.half_length();
  const RowVectorXd row =
      rollres::drive_row(model, resultant(&IndenterShape::torque), resultant(&IndenterShape::driving_force));
  return {row / half, (drive_target(model) - coating_in_drive(model, problem_.coating_moments)) / half};
}

void ZonedSystem::drive() {
  const ContactModel& model = problem_.model;
  auto row = matrix_.row(rotation_);
  if (model.drive == Drive::rotation) {
    row(rotation_) = 1;
    right_(rotation_) = problem_.rubbery * (problem_.shape.law_ratio(*model.rotation_ratio) - 1);
  } else if (const std::optional<std::size_t> zone = redundant_slack(problem_, pattern_)) {
    row(sticks_[*zone].slack()) = 1;
  } else {
    const auto [asked, wanted] = drive_row();
    row = asked;
    right_(rotation_) = wanted;
  }
}

double ZonedSystem::approach(double of_unit_modulus) const {
  double w = of_unit_modulus * problem_.rubbery_compliance;
  const VectorXd means = means_ * solution_;
  for (Index m = 0; m < terms_; ++m) {
    const auto i = static_cast<std::size_t>(m);
    w += problem_.creep_compliance[i] * problem_.creep_length[i] * means(m);
  }
  return problem_.shape.profile(edges_.contact.to) - w;
}

SpectralState ZonedSystem::state(double approach) const {
  const ContactModel& model = problem_.model;
  SpectralState state;
  state.pattern = pattern_;
  state.edges = edges_;
  state.pressure = {solution_.head(slack_), solution_.segment(amplitude_, terms_)};
  state.load = resultant(&IndenterShape::load).dot(solution_);
  const double of_coating = problem_.shape.of_coating();
  state.driving_force =
      resultant(&IndenterShape::driving_force).dot(solution_) - of_coating * problem_.coating_moments.pressed;
  state.driving_torque = resultant(&IndenterShape::torque).dot(solution_) +
                         model.radius * of_coating * problem_.coating_moments.in_torque();
  state.approach = approach;
  state.edge_means = means_ * solution_;
  const double scale = state.load / edges_.contact.half_length();
  state.residuals.resize(pattern_.unknowns());
  state.residuals(0) = solution_(slack_) / scale;
  state.residuals(1) =
      model.load ? (state.load - *model.load) / *model.load : (approach - *model.approach) / *model.approach;
  if (model.drive == Drive::rotation)
    state.rotation_ratio = *model.rotation_ratio;
  else if (!sticks_.empty())
    state.rotation_ratio = problem_.shape.rotation_ratio(1 + solution_(rotation_) / problem_.rubbery);
  const auto lacking_drive = [&] {
    const auto [row, wanted] = drive_row();
    return wanted - row.dot(solution_);
  };
  Index residual = 2;
  const std::optional<std::size_t> redundant = redundant_slack(problem_, pattern_);
  for (std::size_t z = 0; z < sticks_.size(); ++z) {
    const Stick& stick = sticks_[z];
    state.sticks.push_back({solution_.segment(stick.first, stick.count), solution_.segment(stick.amplitude(), terms_)});
    if (pattern_.slips[z] != 0)
      state.residuals(residual++) = (redundant == z ? lacking_drive() : solution_(stick.slack())) / scale;
    if (pattern_.slips[z + 1] != 0) state.residuals(residual++) = root_at_leading_end(z) / scale;
  }
  return state;
}

}  // namespace rollres
