#include "core/heat/loss_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/composite_estimate.hpp"
#include "core/estimate/grid_choice.hpp"
#include "core/material/material_scale.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/scene/shift_reach.hpp"
#include "core/scene/warmed_layers.hpp"

namespace rollres {

namespace {

/// What Hertz's pressure of a half-width says: the logarithms of load or approach, over the one given, and of the loss.
struct HertzAnswer {
  double excess, loss;
};

HertzAnswer hertz_answer(const ContactModel& model, double half_width) {
  const HertzResponse response = hertz_response(model, half_width);
  const double load = -0.5 * half_width / (model.radius * response.slope);
  const double approach = load * response.compliance + half_width * half_width / (8 * model.radius);
  return {model.load ? std::log(load / *model.load) : std::log(approach / *model.approach),
          std::log(std::max(load * load * response.loss * model.speed, 1e-200))};
}

/// The largest of the layers' changes of ln a_T and of ln b_T between two temperatures.
double change_of_shift(const RollingScene& scene, double from, double to) {
  double largest = 0;
  for (const MaterialInputs* const layer : warmed_layers(scene)) {
    if (!has_shift(*layer)) continue;
    MaterialInputs cold = *layer, warm = *layer;
    cold.temperature = from;
    warm.temperature = to;
    largest = std::max({largest, std::abs(std::log(time_shift(warm) / time_shift(cold))),
                        std::abs(std::log(modulus_shift(warm) / modulus_shift(cold)))});
  }
  return largest;
}

double last_temperature(const RollingScene& scene, double coldest) {
  constexpr double widest = 400;  // [K], beyond which no cover is left
  double last = coldest + widest;
  for (const MaterialInputs* const layer : warmed_layers(scene)) {
    std::vector<double> rows = layer->shift_temperatures;
    if (rows.size() < 2 || !has_shift(*layer)) continue;
    std::sort(rows.begin(), rows.end());
    last = std::min(last, reach_of_shifts(rows[0], rows[1], rows[rows.size() - 2], rows.back()).second);
  }
  return last;
}

}  // namespace

std::vector<double> temperatures_to_scan(const RollingScene& scene) {
  constexpr double widest = 10, change = 0.6;  // [K], of ln a_T
  double coldest = INFINITY;
  for (const Surroundings& one : surroundings(scene)) coldest = std::min(coldest, one.temperature);
  const double last = last_temperature(scene, coldest);
  std::vector<double> all{coldest};
  for (double step = widest; all.back() < last;) {
    double next = std::min(all.back() + step, last);
    while (next - all.back() > 0.01 && change_of_shift(scene, all.back(), next) > change)
      next = all.back() + 0.5 * (next - all.back());
    step = std::min(widest, 2 * (next - all.back()));
    all.push_back(next);
  }
  return all;
}

std::vector<double> estimated_losses(const RollingScene& scene, const std::vector<double>& temperatures) {
  constexpr double power_at_first = 2.5;  // of the half-width, in the load
  constexpr double near_enough = 0.05;
  double half_width = estimate_contact(ContactModel(at_temperature(scene, temperatures.front()))).half_width;
  double power = power_at_first;
  std::vector<double> losses;
  for (const double temperature : temperatures) {
    require_time();
    const ContactModel model(at_temperature(scene, temperature));
    HertzAnswer found = hertz_answer(model, half_width);
    double loss_power = 0;
    for (int step = 0; step < 8 && std::abs(found.excess) > near_enough; ++step) {
      const double change = std::clamp(-found.excess / power, -1.0, 1.0);
      half_width *= std::exp(change);
      const HertzAnswer next = hertz_answer(model, half_width);
      if (const double slope = (next.excess - found.excess) / change; slope > 0.5 && slope < 10) power = slope;
      loss_power = (next.loss - found.loss) / change;
      found = next;
    }
    losses.push_back(std::exp(found.loss - loss_power * found.excess / power));
  }
  return losses;
}

}  // namespace rollres
