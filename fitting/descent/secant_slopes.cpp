#include "fitting/descent/secant_slopes.hpp"

#include <cmath>
#include <memory>
#include <utility>

namespace rollres {

CarriedSlopes carried_to(const FitPoint& point, const Prediction& prediction, const KnownSlopes& known,
                         const FitProblem& problem, double share) {
  CarriedSlopes answer{{point, prediction, known.slopes}, 0};
  const Eigen::VectorXd moved = scaled_point(problem, point) - scaled_point(problem, known.point);
  const double square = moved.squaredNorm();
  if (!(square > 0)) return answer;
  double missed = 0, changed = 0;
  for (Eigen::Index i = 0; i < prediction.values.size(); ++i) {
    const double before = known.prediction.values[i], now = prediction.values[i];
    const bool powers = before > 0 && now > 0;
    const double change = powers ? std::log(now / before) : now - before, size = powers ? now : 1;
    Eigen::VectorXd slope = known.slopes.derivatives.row(i).transpose() / (powers ? before : 1);
    const double miss = change - slope.dot(moved);
    slope += share * miss / square * moved;
    answer.slopes.slopes.derivatives.row(i) = size * slope.transpose();
    const double deviation = problem.data[static_cast<std::size_t>(i)].deviation;
    missed += std::pow(size * miss / deviation, 2);
    changed += std::pow(size * change / deviation, 2);
  }
  answer.missed = changed > 0 ? std::sqrt(missed / changed) : 0;
  return answer;
}

FitProblem with_secants(const FitProblem& problem, SecantOptions options) {
  struct State {
    FitProblem problem;
    SecantOptions options;
  };
  const auto state = std::make_shared<State>(State{problem, std::move(options)});
  if (!state->options.evaluate) state->options.evaluate = problem.model.differentiate;
  FitProblem quick = problem;
  quick.model.differentiate = [state](const FitPoint& point, const Prediction& prediction) {
    std::optional<KnownSlopes>& known = state->options.known;
    if (known) {
      CarriedSlopes next = carried_to(point, prediction, *known, state->problem);
      if (next.missed <= state->options.trusted_miss) {
        known = std::move(next.slopes);
        if (state->options.latest) *state->options.latest = known;
        return known->slopes;
      }
    }
    Slopes slopes = state->options.evaluate(point, prediction);
    if (slopes.found()) known = {point, prediction, slopes};
    if (state->options.latest) *state->options.latest = known;
    return slopes;
  };
  return quick;
}

}  // namespace rollres
