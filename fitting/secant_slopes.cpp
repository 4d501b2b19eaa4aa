#include "fitting/secant_slopes.hpp"

#include <memory>
#include <utility>

namespace rollres {

FitProblem with_secants(const FitProblem& problem, std::optional<KnownSlopes> known) {
  struct State {
    FitProblem problem;
    std::optional<KnownSlopes> known;
  };
  const auto state = std::make_shared<State>(State{problem, std::move(known)});
  FitProblem quick = problem;
  quick.differentiate = [state](const FitPoint& point, const Prediction& prediction) {
    if (!state->known) {
      const Slopes slopes = state->problem.differentiate(point, prediction);
      if (!slopes.found()) return slopes;
      state->known = {point, prediction, slopes};
    }
    KnownSlopes& last = *state->known;
    const Eigen::VectorXd moved = scaled_point(state->problem, point) - scaled_point(state->problem, last.point);
    const double square = moved.squaredNorm();
    if (square > 0) {
      const Eigen::VectorXd missed = prediction.values - last.prediction.values - last.slopes.derivatives * moved;
      last.slopes.derivatives += missed * moved.transpose() / square;
      last.point = point;
      last.prediction = prediction;
    }
    return last.slopes;
  };
  return quick;
}

}  // namespace rollres
