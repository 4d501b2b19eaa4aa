#include "core/solve/heat_balance.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/estimate/assumptions.hpp"
#include "core/estimate/composite_estimate.hpp"
#include "core/estimate/grid_choice.hpp"
#include "core/heat/loss_estimate.hpp"
#include "core/heat/steady_temperatures.hpp"
#include "core/messages/message_text.hpp"
#include "core/scene/warmed_layers.hpp"

namespace rollres {

namespace {

/// A solution at one temperature, and the temperatures that it makes.
struct IsothermalAnswer {
  RollingSolution solution;
  double power;  // [W/m]
  WarmedDepth depth;
};

class HeatBalanceSolution {
 public:
  HeatBalanceSolution(const RollingScene& scene,
                      const std::function<RollingSolution(const RollingScene&)>& solve_isothermal)
      : scene_(scene), solve_(solve_isothermal) {}

  RollingSolution run() {
    if (!depends_on_temperature(scene_)) {
      if (!balance_at(*scene_.ambient_temperature)) return std::move(failed_);
      const double mean = answers_.begin()->second.depth.profile.mean();
      return finished(answers_.begin()->second, {{mean, true, 0}});
    }
    const std::vector<double> scanned = temperatures_to_scan(scene_);
    last_scanned_ = scanned.back();
    const RiseEstimate estimate = estimated(scanned);
    const SteadyTemperatures found =
        steady_temperatures(estimate, [&](double temperature) { return balance_at(temperature); });
    if (found.unanswered) {
      failed_.reason += message_text<5>("; with the warmed layers at ", *found.unanswered, " K");
      return std::move(failed_);
    }
    if (found.states.empty()) return without_state(*found.beyond);
    return finished(answers_.at(found.states.front().temperature), found.states);
  }

 private:
  /// Of a power lost evenly over the depth, as the surroundings stand.
  RiseEstimate estimated(const std::vector<double>& scanned) const {
    const ContactModel cold(at_temperature(scene_, scanned.front()));
    const HeatPath path = heat_path(scene_, 2 * estimate_contact(cold).half_width);
    constexpr std::size_t nodes = 6;
    const TemperatureProfile even(path, {{0, path.thickness, std::vector<double>(nodes, 1 / path.thickness)}},
                                  0);  // 1 W/m in all
    const double base = even.mean_without_loss();
    return {scanned, estimated_losses(scene_, scanned), even.mean() - base, base};
  }

  std::optional<HeatBalance> balance_at(double temperature) {
    const RollingScene isothermal = at_temperature(scene_, temperature);
    RollingSolution solution = solve_(isothermal);
    if (solution.status != Status::converged) {
      failed_ = std::move(solution);
      return std::nullopt;
    }
    const ContactModel model = ContactModel(isothermal).with_answer(solution);
    WarmedDepth depth = warmed_depth(scene_, model, solution);
    const double power = solution.rolling_resistance * model.speed, base = depth.profile.mean_without_loss();
    const HeatBalance balance{base, depth.profile.mean() - base};
    answers_.insert_or_assign(temperature, IsothermalAnswer{std::move(solution), power, std::move(depth)});
    return balance;
  }

  /// "12.3 W", of the body whose width is given, or "12.3 W/m".
  std::string told(double per_metre) const {
    return message_text<4>(per_metre * body_length(scene_), scene_.width ? " W" : " W/m");
  }

  RollingSolution without_state(double last) {
    const IsothermalAnswer& there = answers_.at(last);
    const double base = there.depth.profile.mean_without_loss(), rise = there.depth.profile.mean() - base;
    const double leaving = there.power * (last - base) / rise;
    RollingSolution none;
    none.method = there.solution.method;
    none.status = Status::no_steady_state;
    none.reason = message_text<5>("heat: at ", last, " K, the last temperature that was tried, ", told(there.power),
                                  " are lost and ", told(leaving), " leave: ", told(there.power - leaving),
                                  " cannot leave at any temperature below");
    return none;
  }

  RollingSolution finished(IsothermalAnswer& answer, const std::vector<SteadyTemperature>& states) {
    RollingSolution solution = std::move(answer.solution);
    const TemperatureProfile& profile = answer.depth.profile;
    solution.mean_temperature = states.front().temperature;
    solution.peak_temperature = profile.peak().temperature;
    solution.peak_temperature_depth = profile.peak().depth;
    solution.bond_temperature = profile.bond();
    solution.surface_temperature = profile.face();
    solution.heat_to_air = profile.to_air();
    solution.heat_to_ground = profile.to_ground() + answer.depth.lost.elsewhere;
    solution.heat_to_core = profile.to_core();
    const HeatNumbers numbers = heat_numbers(scene_, answer.depth.path);
    solution.warming_time = numbers.warming_time;
    solution.peclet = numbers.peclet;
    solution.fourier = numbers.fourier;
    solution.biot = numbers.biot;
    for (const SteadyTemperature& state : states) solution.temperatures.push_back(state.temperature);
    std::erase_if(solution.assumptions, [](const std::string& one) { return one.starts_with(no_heat); });
    solution.model += message_text<6>("; the warmed layers at ", solution.mean_temperature,
                                      " K, the mean by their own loss, found in ", answers_.size(),
                                      answers_.size() == 1 ? " solution" : " solutions at one temperature each");
    assume_one_temperature(profile, solution);
    warn(states, solution);
    return solution;
  }

  void warn(const std::vector<SteadyTemperature>& states, RollingSolution& solution) const {
    constexpr double even = 20, settled = 1e-6;  // Peclet's number; of a temperature
    if (solution.peclet < even)
      solution.warnings.push_back(message_text("heat: Peclet's number is ", solution.peclet,
                                               " and Fourier's of a turn ", solution.fourier,
                                               ": the layers are not evenly warm around a turn, as is assumed"));
    if (std::abs(states.front().missed) > settled * states.front().temperature)
      solution.warnings.push_back(message_text("heat: the mean temperature is found to ",
                                               std::abs(states.front().missed),
                                               " K: solutions at neighbouring temperatures scatter as much"));
    if (states.size() > 1) {
      std::string others;
      for (std::size_t i = 1; i < states.size(); ++i)
        others +=
            message_text<4>(i > 1 ? ", " : "", states[i].temperature, states[i].stable ? " K, stable" : " K, unstable");
      solution.warnings.push_back(
          "heat: more than one steady state: this one is reached by warming from cold; others at " + others);
    }
  }

  /// What one temperature for all warmed layers changes: beside layers as warm as the profile, which stays as it is.
  void assume_one_temperature(const TemperatureProfile& profile, RollingSolution& solution) const {
    if (!depends_on_temperature(scene_)) return;
    constexpr int pieces = 6;
    const double coldest = std::min(profile.face(), profile.bond());
    const ContactModel one(at_temperature(scene_, solution.mean_temperature));
    const ContactModel each(
        at_temperatures(scene_, pieces, [&](double depth) { return std::min(profile.at(depth), last_scanned_); }));
    const auto [change, scatter] = ResistanceChange(one, half_length(solution))(each);
    if (!std::isfinite(change)) return;
    const std::string range =
        message_text<4>("the warmed layers are between ", coldest, " and ", solution.peak_temperature, " K");
    solution.assumptions.push_back(in_words({one_temperature, range, change, scatter}));
    solution.model_error = std::hypot(solution.model_error, std::abs(change) + scatter);
    constexpr double far = 0.1;
    if (std::abs(change) > far)
      solution.warnings.push_back(
          "heat: " + range +
          message_text<2>(": layers as warm as they are would change R_r by about ", 100 * change, " %"));
  }

  const RollingScene& scene_;
  const std::function<RollingSolution(const RollingScene&)>& solve_;
  std::map<double, IsothermalAnswer> answers_;
  double last_scanned_ = 0;  // [K]
  RollingSolution failed_;
};

}  // namespace

WarmedDepth warmed_depth(const RollingScene& scene, const ContactModel& solved, const RollingSolution& solution) {
  const HeatPath path = heat_path(scene, solution.leading_edge - solution.trailing_edge);
  LossWithDepth lost = loss_with_depth(solved, solution);
  TemperatureProfile profile(path, lost.panels, lost.at_face);
  return {path, std::move(lost), std::move(profile)};
}

RollingSolution solve_with_heat(const RollingScene& scene,
                                const std::function<RollingSolution(const RollingScene&)>& solve_isothermal) {
  return HeatBalanceSolution(scene, solve_isothermal).run();
}

}  // namespace rollres
