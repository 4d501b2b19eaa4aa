#include "core/solve/heat_balance.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/algebra/fixed_point.hpp"
#include "core/estimate/assumptions.hpp"
#include "core/estimate/grid_choice.hpp"
#include "core/heat/loss_estimate.hpp"
#include "core/heat/steady_temperatures.hpp"
#include "core/messages/message_text.hpp"
#include "core/scene/warmed_layers.hpp"
#include "core/solve/one_temperature.hpp"

namespace rollres {

namespace {

/// A solution at given temperatures, and those that it makes.
struct IsothermalAnswer {
  RollingSolution solution;
  double power;  // [W/m]
  WarmedDepth depth;
  double unsettled;  // of the sublayers' temperatures, those that it makes scaled to the mean less the given [K]
};

class HeatBalanceSolution {
 public:
  HeatBalanceSolution(const RollingScene& scene,
                      const std::function<RollingSolution(const ContactModel&)>& solve_isothermal)
      : scene_(scene),
        model_(scene),
        solve_(solve_isothermal),
        in_each_(depends_on_temperature(scene) ? scene.thermal_sublayers : 1),
        depths_(sublayer_depths(scene, in_each_)) {}

  RollingSolution run() {
    if (!depends_on_temperature(scene_)) {
      if (!balance_at(*scene_.ambient_temperature)) return std::move(failed_);
      const double mean = answers_.begin()->second.depth.profile.mean();
      return finished(answers_.begin()->second, {{mean, true, 0}});
    }
    const std::vector<double> scanned = temperatures_to_scan(scene_);
    coldest_ = scanned.front();
    warmest_ = scanned.back();
    const RiseEstimate estimate = estimated(scanned);
    const SteadyTemperatures found =
        steady_temperatures(estimate, [&](double temperature) { return balance_at(temperature); });
    if (found.unanswered) {
      failed_.reason += "; with the warmed layers at " + in_celsius(*found.unanswered);
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

  bool in_sublayers() const { return in_each_ > 1; }

  /// The exact answer at a mean temperature, whose sublayers are as warm as its profile scaled to that mean.
  std::optional<HeatBalance> balance_at(double mean) {
    constexpr double wanted = 1e-9, far = 1e-3;  // of a temperature; of what the mean is from a steady one
    std::optional<IsothermalAnswer> answer;
    FixedPointProblem problem;
    problem.map = [&](const Eigen::VectorXd& temperatures) -> std::optional<Eigen::VectorXd> {
      answer = answer_at(bounded({temperatures.begin(), temperatures.end()}));
      if (!answer) return std::nullopt;
      if (!in_sublayers()) return temperatures;
      const Eigen::VectorXd made = as_vector(bounded(answer->depth.profile.scaled_to(mean, depths_)));
      answer->unsettled = (made - temperatures).cwiseAbs().maxCoeff();
      return made;
    };
    problem.near = [&](const Eigen::VectorXd&, const Eigen::VectorXd&) {
      const double excess = answer->depth.profile.mean() - mean;
      return answer->unsettled <= std::max(wanted * mean, far * std::abs(excess));
    };
    problem.difference = 1e-2;
    problem.most_evaluations = 20 + 10 * static_cast<int>(depths_.size());
    if (!fixed_point(problem, as_vector(first_temperatures(mean))) || !answer) return std::nullopt;
    const double base = answer->depth.profile.mean_without_loss(), found = answer->depth.profile.mean();
    answers_.insert_or_assign(mean, std::move(*answer));
    return HeatBalance{base, found - base};
  }

  static Eigen::VectorXd as_vector(const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  }

  /// Within what the laws of shift are asked for.
  std::vector<double> bounded(std::vector<double> temperatures) const {
    for (double& one : temperatures) one = std::clamp(one, coldest_, warmest_);
    return temperatures;
  }

  /// As the profile of the nearest answer has them.
  std::vector<double> first_temperatures(double mean) const {
    const auto nearest = std::min_element(answers_.begin(), answers_.end(), [&](const auto& one, const auto& other) {
      return std::abs(one.first - mean) < std::abs(other.first - mean);
    });
    if (!in_sublayers() || nearest == answers_.end()) return std::vector<double>(depths_.size(), mean);
    return bounded(nearest->second.depth.profile.scaled_to(mean, depths_));
  }

  std::optional<IsothermalAnswer> answer_at(const std::vector<double>& temperatures) {
    const ContactModel isothermal = model_.with_temperatures(temperatures);
    RollingSolution solution = solve_(isothermal);
    ++solutions_;
    if (solution.status != Status::converged) {
      failed_ = std::move(solution);
      return std::nullopt;
    }
    const ContactModel model = isothermal.with_answer(solution);
    WarmedDepth depth = warmed_depth(scene_, model, solution);
    if (in_sublayers()) solution.sublayer_temperatures = temperatures;
    const double power = solution.rolling_resistance * model.speed;
    return IsothermalAnswer{std::move(solution), power, std::move(depth), 0};
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
    none.reason = message_text<5>("heat: at ", in_celsius(last), ", the last temperature that was tried, ",
                                  told(there.power), " are lost and ", told(leaving),
                                  " leave: ", told(there.power - leaving), " cannot leave at any temperature below");
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
    const std::string sublayers =
        in_sublayers() ? message_text(", in ", in_each_, " sublayers each as warm as its middle") : "";
    solution.model += message_text<6>("; the warmed layers at ", in_celsius(solution.mean_temperature),
                                      ", the mean by their own loss", sublayers, ", found in ", solutions_,
                                      solutions_ == 1  ? " solution"
                                      : in_sublayers() ? " solutions"
                                                       : " solutions at one temperature each");
    assume_one_temperature(profile, solution);
    warn(states, answer.unsettled, solution);
    return solution;
  }

  void warn(const std::vector<SteadyTemperature>& states, double unsettled, RollingSolution& solution) const {
    constexpr double even = 20, settled = 1e-6;  // Peclet's number; of a temperature
    if (solution.peclet < even)
      solution.warnings.push_back(message_text("heat: Peclet's number is ", solution.peclet,
                                               " and Fourier's of a turn ", solution.fourier,
                                               ": the layers are not evenly warm around a turn, as is assumed"));
    const double missed = std::max(std::abs(states.front().missed), unsettled);
    if (missed > settled * states.front().temperature)
      solution.warnings.push_back(
          message_text("heat: the ", unsettled < missed ? "mean temperature is" : "temperatures of the sublayers are",
                       " found to ", missed, " K: solutions at neighbouring temperatures scatter as much"));
    if (in_sublayers() &&
        solution.sublayer_temperatures.end() !=
            std::find(solution.sublayer_temperatures.begin(), solution.sublayer_temperatures.end(), warmest_))
      solution.warnings.push_back("heat: sublayers are warmer than the law of shift reaches: taken at " +
                                  in_celsius(warmest_));
    if (states.size() > 1) {
      std::string others;
      for (std::size_t i = 1; i < states.size(); ++i)
        others +=
            (i > 1 ? ", " : "") + in_celsius<4>(states[i].temperature) + (states[i].stable ? ", stable" : ", unstable");
      solution.warnings.push_back(
          "heat: more than one steady state: this one is reached by warming from cold; others at " + others);
    }
  }

  /// What one temperature for all warmed layers, or for each sublayer, changes.
  void assume_one_temperature(const TemperatureProfile& profile, RollingSolution& solution) const {
    if (!depends_on_temperature(scene_)) return;
    constexpr int least = 6, finer = 3;
    const int in_each = std::max(least, finer * in_each_);
    const WarmAnswer answer{scene_, solution, profile,
                            in_sublayers() ? solution.sublayer_temperatures
                                           : std::vector<double>(depths_.size(), solution.mean_temperature),
                            [&](const std::vector<double>& temperatures) {
                              const ContactModel model = model_.with_temperatures(bounded(temperatures));
                              return std::isfinite(solution.rotation_ratio) ? model.with_flow(solution.rotation_ratio)
                                                                            : model;
                            }};
    const auto [change, scatter] = change_by_sublayers(answer, in_each);
    if (!std::isfinite(change)) return;
    const std::string range =
        message_text("the warmed layers are between ", in_celsius<4>(std::min(profile.face(), profile.bond())), " and ",
                     in_celsius<4>(solution.peak_temperature));
    const std::string sublayers = in_sublayers() ? message_text("of each of ", in_each_, " sublayers; ") : "";
    solution.assumptions.push_back(in_words({one_temperature, sublayers + range, change, scatter}));
    solution.model_error = std::hypot(solution.model_error, std::abs(change) + scatter);
    constexpr double far = 0.1;
    if (std::abs(change) > far)
      solution.warnings.push_back("heat: " + range +
                                  message_text<2>(": layers as warm as they are would change R_r by about ",
                                                  100 * change, " %: give thermal_sublayers = ", in_each));
  }

  const RollingScene& scene_;
  ContactModel model_;
  const std::function<RollingSolution(const ContactModel&)>& solve_;
  int in_each_;                                      // sublayers
  std::vector<double> depths_;                       // of the sublayers' middles below the face [m]
  std::map<double, IsothermalAnswer> answers_;       // by their mean temperature
  double coldest_ = -INFINITY, warmest_ = INFINITY;  // that are scanned [K]
  int solutions_ = 0;
  RollingSolution failed_;
};

}  // namespace

WarmedDepth warmed_depth(const RollingScene& scene, const ContactModel& solved, const RollingSolution& solution,
                         LossDetail detail) {
  const HeatPath path = heat_path(scene, solution.leading_edge - solution.trailing_edge);
  LossWithDepth lost = loss_with_depth(solved, solution, detail);
  TemperatureProfile profile(path, lost.panels, lost.at_face);
  return {path, std::move(lost), std::move(profile)};
}

RollingSolution solve_with_heat(const RollingScene& scene,
                                const std::function<RollingSolution(const ContactModel&)>& solve_isothermal) {
  return HeatBalanceSolution(scene, solve_isothermal).run();
}

}  // namespace rollres
