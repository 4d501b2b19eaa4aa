#include "core/heat/steady_temperatures.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/numerics/bracketed_root.hpp"

namespace rollres {

namespace {

constexpr double wanted = 1e-8;           // of the temperature
constexpr int most_answers_a_state = 12;  // beyond which the best is taken
constexpr int most_rounds = 8;

/// Cubic Hermite interpolation with slopes by differences (Catmull and Rom 1974).
double smooth_between(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const std::size_t last = x.size() - 1;
  if (last == 0) return y[0];
  const auto above = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
  const std::size_t i = std::clamp<std::size_t>(above, 1, last) - 1;
  const auto slope = [&](std::size_t k) {
    const std::size_t from = k == 0 ? 0 : k - 1, to = std::min(k + 1, last);
    return (y[to] - y[from]) / (x[to] - x[from]);
  };
  const double h = x[i + 1] - x[i], t = std::clamp((at - x[i]) / h, 0.0, 1.0);
  return (1 + 2 * t) * (1 - t) * (1 - t) * y[i] + t * t * (3 - 2 * t) * y[i + 1] +
         h * t * (1 - t) * ((1 - t) * slope(i) - t * slope(i + 1));
}

class TemperatureSearch {
 public:
  TemperatureSearch(const RiseEstimate& estimate, const std::function<std::optional<HeatBalance>(double)>& exact)
      : temperatures_(estimate.temperatures), factor_(estimate.factor), base_(estimate.base), exact_(exact) {
    for (const double rise : estimate.rise) logarithms_.push_back(std::log(rise));
  }

  SteadyTemperatures run() {
    for (int round = 0; round < most_rounds && !found_.unanswered; ++round)
      if (!find_more()) break;
    std::sort(found_.states.begin(), found_.states.end(),
              [](const auto& a, const auto& b) { return a.temperature < b.temperature; });
    leave_out_twins();
    if (found_.states.empty() && !found_.unanswered) found_.beyond = temperatures_.back();
    return std::move(found_);
  }

 private:
  /// An exact answer: base, and the logarithm of its rise over the estimate.
  struct Sample {
    double base, logarithm, excess;
  };
  using Samples = std::map<double, Sample>;

  /// The correction at a temperature by some samples: the polynomial through them, at most a span of them outside.
  Sample through(const std::vector<Samples::const_iterator>& samples, double at) const {
    if (samples.empty()) return {base_, std::log(factor_), 0};
    double low = samples[0]->first, high = low;
    for (const auto& sample : samples) low = std::min(low, sample->first), high = std::max(high, sample->first);
    const double x = std::clamp(at, low - (high - low), high + (high - low));
    Sample sum{0, 0, 0};
    for (const auto& one : samples) {
      double basis = 1;
      for (const auto& other : samples)
        if (other != one) basis *= (x - other->first) / (one->first - other->first);
      sum.base += basis * one->second.base;
      sum.logarithm += basis * one->second.logarithm;
    }
    return sum;
  }
  double excess_with(const Sample& correction, double at) const {
    return correction.base + std::exp(correction.logarithm + smooth_between(temperatures_, logarithms_, at)) - at;
  }
  /// By the two samples around a temperature: continuous, and exact at samples.
  double excess_between(double at) const {
    const auto above = samples_.lower_bound(at);
    std::vector<Samples::const_iterator> around;
    if (above != samples_.end()) around.push_back(above);
    if (above != samples_.begin()) around.push_back(std::prev(above));
    return excess_with(through(around, at), at);
  }
  /// By the nearest three samples of a place.
  std::vector<Samples::const_iterator> nearest(double place) const {
    std::vector<Samples::const_iterator> all;
    for (auto i = samples_.begin(); i != samples_.end(); ++i) all.push_back(i);
    std::sort(all.begin(), all.end(),
              [&](auto a, auto b) { return std::abs(a->first - place) < std::abs(b->first - place); });
    all.resize(std::min<std::size_t>(all.size(), 3));
    return all;
  }

  /// @return the exact excess at a temperature; nothing where there is no answer, which ends the search
  std::optional<double> ask(double at) {
    if (const auto known = samples_.find(at); known != samples_.end()) return known->second.excess;
    const std::optional<HeatBalance> balance = exact_(at);
    if (!balance) {
      found_.unanswered = at;
      return std::nullopt;
    }
    const double least = 1e-12 * std::exp(smooth_between(temperatures_, logarithms_, at));
    const Sample sample{balance->base,
                        std::log(std::max(balance->rise, least)) - smooth_between(temperatures_, logarithms_, at),
                        balance->base + balance->rise - at};
    return samples_.emplace(at, sample).first->second.excess;
  }

  /// Places between which the excess by all samples so far is looked at.
  std::vector<double> places() const {
    std::vector<double> all;
    for (std::size_t i = 0; i < temperatures_.size(); ++i) {
      if (i > 0)
        for (const double share : {0.25, 0.5, 0.75})
          all.push_back(temperatures_[i - 1] + share * (temperatures_[i] - temperatures_[i - 1]));
      all.push_back(temperatures_[i]);
    }
    for (const auto& [at, sample] : samples_)
      if (!is_state(at)) all.push_back(at);
    std::sort(all.begin(), all.end());
    return all;
  }
  bool is_state(double at) const {
    return std::any_of(found_.states.begin(), found_.states.end(),
                       [&](const SteadyTemperature& state) { return state.temperature == at; });
  }
  bool has_state_between(double low, double high) const {
    return std::any_of(found_.states.begin(), found_.states.end(), [&](const SteadyTemperature& state) {
      return state.temperature >= low && state.temperature <= high;
    });
  }

  /// Whether another exact answer was asked for: at a state that is not known yet, where the excess comes near to 0
  /// without a change of sign, or at the end where there is no state.
  bool find_more() {
    const std::vector<double> all = places();
    std::vector<double> excess;
    for (const double at : all) excess.push_back(excess_between(at));
    const std::size_t before = samples_.size();
    // Below it the layers would be colder than all that takes their heat: a state there is stable.
    if (!(excess.front() > 0) && found_.states.empty()) refine(all.front(), all.front(), true);
    for (std::size_t i = 1; i < all.size() && !found_.unanswered; ++i)
      if ((excess[i - 1] > 0) != (excess[i] > 0) && !has_state_between(all[i - 1], all[i]))
        refine(all[i - 1], all[i], excess[i - 1] > 0);
    if (samples_.size() > before) return true;
    for (std::size_t i = 1; i + 1 < all.size() && !found_.unanswered; ++i) look_at_turn(all, excess, i);
    for (std::size_t i = 0; i < all.size() && !found_.unanswered; ++i) look_where_flat(all[i], excess[i]);
    if (found_.states.empty() && !found_.unanswered) ask(all.back());
    return samples_.size() > before;
  }

  /// Asks where the excess turns back before it reaches 0, unless an answer near by has shown by how much.
  void look_at_turn(const std::vector<double>& all, const std::vector<double>& excess, std::size_t i) {
    constexpr double near = 0.6, nearer = 0.15;  // of the rise
    const double sign = excess[i] > 0 ? 1 : -1, rise = excess[i] + all[i] - base_;
    const double before = all[i] - all[i - 1], behind = all[i + 1] - all[i];
    const double up = (excess[i] - excess[i - 1]) / before, next = (excess[i + 1] - excess[i]) / behind;
    if (!(sign * up <= 0 && sign * next > 0) || std::abs(excess[i]) > near * rise) return;
    // Of the parabola through the three.
    const double turn = all[i] - 0.5 * (up * behind + next * before) / (next - up);
    const double shown = (before + behind) * (std::abs(excess[i]) < nearer * rise ? 0.1 : 1);
    ask_unless_near(turn, shown);
  }

  /// Asks at a temperature, unless an answer within so many kelvin has been given.
  void ask_unless_near(double at, double distance) {
    const auto above = samples_.lower_bound(at - distance);
    if (above == samples_.end() || above->first > at + distance) ask(at);
  }

  /// Stable and unstable states take turns: two of a kind beside one another are one, found twice where the excess is
  /// flat.
  void leave_out_twins() {
    std::vector<SteadyTemperature>& states = found_.states;
    for (std::size_t i = 1; i < states.size();) {
      if (states[i].stable != states[i - 1].stable) {
        ++i;
        continue;
      }
      const bool latter = std::abs(states[i].missed) < std::abs(states[i - 1].missed);
      states.erase(states.begin() + static_cast<std::ptrdiff_t>(latter ? i - 1 : i));
    }
  }

  /// Asks where the estimate cannot tell on which side of 0 the excess is, unless an answer near by has.
  void look_where_flat(double at, double excess) {
    constexpr double told = 0.06, near = 0.2;  // of the rise
    const double rise = excess + at - base_;
    if (std::abs(excess) > told * rise) return;
    ask_unless_near(at, near * rise);
  }

  /// To the state between two temperatures, if exact answers have one there.
  /// @param falling whether the excess falls from the one to the other, so that the state is stable
  void refine(double low, double high, bool falling) {
    double at = root_in(low, high).value_or(0.5 * (low + high));
    std::optional<SteadyTemperature> best;
    for (int answer = 0; answer < most_answers_a_state; ++answer) {
      const std::optional<double> excess = ask(at);
      if (!excess) return;
      if (!best || std::abs(*excess) < std::abs(best->missed)) best = {at, true, *excess};
      if (std::abs(*excess) <= wanted * at) break;
      const double next = step_from(at, *excess);
      if (!(std::abs(next - at) > 0.1 * wanted * at)) break;
      at = next;
    }
    constexpr double taken_for_one = 1e-3;  // of the rise: what grids cannot tell apart
    const double rise = best->temperature + best->missed - samples_.at(best->temperature).base;
    if (std::abs(best->missed) > std::max(wanted * best->temperature, taken_for_one * rise)) return;
    const double width = std::max(1e-3, 1e-4 * best->temperature);
    if (has_state_between(best->temperature - 1e-6 * best->temperature, best->temperature + 1e-6 * best->temperature))
      return;
    const auto near = nearest(best->temperature);
    const auto slope = excess_with(through(near, best->temperature + width), best->temperature + width) -
                       excess_with(through(near, best->temperature - width), best->temperature - width);
    best->stable = near.size() > 1 ? slope < 0 : falling;
    found_.states.push_back(*best);
  }

  /// The root of the corrected estimate that is nearest to a place which has been asked.
  double step_from(double at, double excess) const {
    const auto near = nearest(at);
    constexpr double first = 0.02, most = 2e3;  // [K]
    const auto corrected = [&](double place) { return excess_with(through(near, place), place); };
    // Both ways, the one in which a stable state lies first: up where more is lost than leaves.
    for (double step = first; step < most; step *= 2)
      for (const double way : {excess > 0 ? 1.0 : -1.0, excess > 0 ? -1.0 : 1.0}) {
        const double end = std::clamp(at + way * step, temperatures_.front(), temperatures_.back());
        if (end == at) continue;
        if (const auto root = root_between(corrected, at, end, 1e-13)) return *root;
      }
    return std::clamp(at + excess, temperatures_.front(), temperatures_.back());
  }

  std::optional<double> root_in(double low, double high) const {
    if (low == high) return low;
    return root_between([&](double at) { return excess_between(at); }, low, high, 1e-13);
  }

  const std::vector<double>& temperatures_;
  std::vector<double> logarithms_;  // of the estimate of the rise
  double factor_, base_;
  const std::function<std::optional<HeatBalance>(double)>& exact_;
  Samples samples_;
  SteadyTemperatures found_;
};

}  // namespace

SteadyTemperatures steady_temperatures(const RiseEstimate& estimate,
                                       const std::function<std::optional<HeatBalance>(double)>& exact) {
  return TemperatureSearch(estimate, exact).run();
}

}  // namespace rollres
