#include "core/solve/one_temperature.hpp"

#include "core/algebra/fixed_point.hpp"
#include "core/estimate/assumptions.hpp"
#include "core/scene/warmed_layers.hpp"
#include "core/solve/heat_balance.hpp"

namespace rollres {

ResistanceChange::Change change_by_sublayers(const WarmAnswer& answer, int in_each) {
  constexpr double near_enough = 0.02, nothing = 0.01;  // of the difference between warmest and coldest; [K]
  constexpr int most_evaluations = 12;
  const std::vector<double> depths = sublayer_depths(answer.scene, in_each);
  const auto model_at = [&](const Eigen::VectorXd& temperatures) {
    return answer.model({temperatures.begin(), temperatures.end()});
  };
  const auto at_middles = [&](const TemperatureProfile& profile) {
    Eigen::VectorXd temperatures(static_cast<Eigen::Index>(depths.size()));
    for (Eigen::Index i = 0; i < temperatures.size(); ++i)
      temperatures(i) = profile.at(depths[static_cast<std::size_t>(i)]);
    return temperatures;
  };
  const ResistanceChange over(answer.model(answer.temperatures), half_length(answer.solution));
  const Eigen::VectorXd start = at_middles(answer.profile);
  const double difference = near_enough * (start.maxCoeff() - start.minCoeff()) + nothing;
  RollingSolution changed = answer.solution;
  FixedPointProblem problem;
  problem.map = [&](const Eigen::VectorXd& temperatures) -> std::optional<Eigen::VectorXd> {
    const ContactModel finer = model_at(temperatures);
    const double change = over(finer).value;
    if (!(change > -1)) return std::nullopt;
    changed.rolling_resistance = (1 + change) * answer.solution.rolling_resistance;
    changed.frictional_loss = (1 + change) * answer.solution.frictional_loss;
    return at_middles(warmed_depth(answer.scene, finer, changed, LossDetail::rough).profile);
  };
  problem.near = [&](const Eigen::VectorXd& x, const Eigen::VectorXd& made) {
    return (made - x).cwiseAbs().maxCoeff() <= difference;
  };
  problem.difference = difference;
  problem.most_evaluations = most_evaluations;
  return over(model_at(fixed_point(problem, start).value_or(start)));
}

}  // namespace rollres
