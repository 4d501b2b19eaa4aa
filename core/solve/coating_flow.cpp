#include "core/solve/coating_flow.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/estimate/assumptions.hpp"
#include "core/estimate/grid_choice.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/contact_surface.hpp"
#include "core/model/stated_error.hpp"
#include "core/solve/doubts.hpp"
#include "core/solve/grid_answer.hpp"
#include "core/solve/resolve.hpp"

namespace rollres {

namespace {

/// Whether the drive decides how fast a coating flows through the contact, and the answer depends on it.
bool flow_is_unknown(const ContactModel& model) {
  return model.friction_coefficient > 0 && model.drive != Drive::rotation && coating_flow_counts(model);
}

/// The model with the coating's share of what yields (indenter_shape.hpp) as the contact found has it, and not one that
/// was estimated, which depends on whether the load or the approach is given.
ContactModel with_own_share(ContactModel model, const RollingSolution& found) {
  if (!model.coating.empty()) model.coating_share = share_of_coating(model, half_length(found));
  return model;
}

/// Whether that share would change the creepage by more than R_r's stated error allows: its terms are of second order
/// in the slope.
bool share_counts(const ContactModel& model, const RollingSolution& found) {
  if (model.coating.empty() || model.friction_coefficient == 0 || found.status != Status::converged) return false;
  constexpr double share_of_error = 0.01, least_error = 1e-8;
  const double slope = half_length(found) / model.radius;
  const double change = share_of_coating(model, half_length(found)) - share_of_coating(model);
  return std::abs(change) * slope * slope >
         share_of_error * std::max(least_error, found.error_estimate) * std::abs(1 - found.rotation_ratio);
}

constexpr const char* stopped =
    "this drive stops the coated body or turns it backwards; give rotation_ratio, with drive \"rotation\"";

using Solve = std::function<RollingSolution(const ContactModel&)>;

/// The search for the flow that the answer gives itself.
class FlowSearch {
 public:
  explicit FlowSearch(const ContactModel& full) : full_(&full), flow_(full.flow) {}

  /// The first solution, or the next one at the flow that was found on a coarser grid, with its contact.
  const RollingSolution& begin(const Solve& solve_at) {
    solve_at_flow(solve_at);
    return *found_;
  }

  /// Secants until what is left of the flow changes R_r by less than a share of its stated error.
  /// @return false where the flow would stop or turn back
  bool run(const Solve& solve_at, double share_of_error) {
    if (!converged()) return true;
    for (int solutions = 1;; ++solutions) {
      const double step = (found_->rotation_ratio - flow_) / (1 - response_);
      const double left = sensitivity_.value_or(std::abs(found_->rolling_resistance)) * std::abs(step);
      const bool flow_known = left <= share_of_error * found_->rolling_resistance_error;
      if ((flow_known && !share_counts(*model_, *found_)) || solutions == most_solutions) {
        if (left > found_->rolling_resistance_error)
          found_->warnings.push_back(
              message_text("the speed at which the coating flows was found to ", std::abs(step), " of V only"));
        add_error(left / std::abs(found_->rolling_resistance), *found_);
        return true;
      }
      const RollingSolution before = *found_;
      if (!flow_known) flow_ += step;
      if (!(flow_ > 0)) return false;
      if (!solve_at_flow(solve_at)) return true;
      if (flow_known) continue;
      response_ = std::clamp((found_->rotation_ratio - before.rotation_ratio) / step, -2.0, 0.8);
      sensitivity_ = std::abs((found_->rolling_resistance - before.rolling_resistance) / step);
    }
  }

  bool converged() const { return found_->status == Status::converged; }
  RollingSolution& found() { return *found_; }

 private:
  static constexpr int most_solutions = 8;

  bool solve_at_flow(const Solve& solve_at) {
    model_ = simplified(full_->with_flow(flow_));
    if (found_) model_ = with_own_share(std::move(*model_), *found_);
    found_ = solve_at(*model_);
    return converged();
  }

  const ContactModel* full_;
  std::optional<ContactModel> model_;  // of the last solution
  double flow_, response_ = 0;         // d ratio/d flow
  std::optional<double> sensitivity_;  // |d R_r/d flow|: R_r itself before it is known [N]
  std::optional<RollingSolution> found_;
};

}  // namespace

RollingSolution solve_at_own_flow(const ContactModel& full, const Solve& solve_at) {
  const ContactModel first = simplified(full);
  if (!flow_is_unknown(full) || !flow_is_unknown(first)) {
    RollingSolution solution = solve_at(first);
    return first.drive == Drive::rotation && share_counts(first, solution) ? solve_at(with_own_share(first, solution))
                                                                           : solution;
  }
  constexpr double share_of_coarse_error = 0.1, share_of_error = 0.01;
  FlowSearch search(full);
  // A coarse grid finds the flow, also where continuous edges hand over to a grid, which they do at every flow.
  bool on_grid = first.method == Method::newton || first.method == Method::newton_dense, begun = false;
  if (!on_grid) {
    on_grid = search.begin(solve_at).method == Method::newton && search.converged();
    begun = true;
  }
  if (on_grid && has_coarse_grid(first)) {
    FlowSearch coarse(full);
    coarse.begin(solve_on_coarse_grid);
    if (coarse.run(solve_on_coarse_grid, share_of_coarse_error) && coarse.converged()) {
      search = std::move(coarse);
      begun = false;
    }
  }
  if (!begun) search.begin(solve_at);
  if (!search.run(solve_at, share_of_error))
    return without_answer(search.found().method, Status::not_converged, stopped);
  return std::move(search.found());
}

}  // namespace rollres
