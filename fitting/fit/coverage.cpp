#include "fitting/fit/coverage.hpp"

#include <cmath>
#include <mutex>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>

#include "core/numerics/parallel.hpp"

namespace rollres {

namespace {

/// Normal numbers that are the same on every machine (Box and Muller 1958).
class Normal {
 public:
  Normal(std::uint64_t seed, std::uint64_t draw) : random_(seed * 1'000'003 + draw) {}

  double operator()() {
    const double radius = std::sqrt(-2 * std::log1p(-uniform())), angle = 2 * std::numbers::pi * uniform();
    return radius * std::cos(angle);
  }

 private:
  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  std::mt19937_64 random_;
};

bool holds(const ConfidenceInterval& interval, double truth) {
  return (interval.low == IntervalEnd::open || truth >= interval.lowest) &&
         (interval.high == IntervalEnd::open || truth <= interval.highest);
}

}  // namespace

Coverage coverage(const FitProblem& problem, const FitPoint& truth, double scatter, const CoverageOptions& options) {
  const Prediction exact = problem.predict(truth);
  if (!exact.found()) throw std::invalid_argument("no prediction at the parameters to draw around: " + exact.reason);
  Coverage answer{.seed = options.seed, .profiles = options.profiles};
  for (std::size_t j = 0; j < problem.size(); ++j) answer.parameters.push_back({problem.parameters[j].name, truth[j]});
  const Eigen::VectorXd scaled_truth = scaled_point(problem, truth);
  std::optional<KnownSlopes> known;
  if (const Slopes slopes = problem.differentiate(truth, exact); slopes.found()) known = {truth, exact, slopes};
  std::vector<double> squares(problem.size(), 0);
  std::mutex mutex;
  for_each_piece(static_cast<std::size_t>(options.draws), options.jobs, [&](std::size_t draw) {
    if (options.stop && options.stop->load()) return;
    FitProblem drawn = problem;
    for (std::size_t j = 0; j < problem.size(); ++j) drawn.parameters[j].start = truth[j];
    Normal normal(options.seed, draw);
    for (std::size_t i = 0; i < drawn.data.size(); ++i)
      drawn.data[i].value = exact.values[static_cast<Eigen::Index>(i)] + scatter * drawn.data[i].deviation * normal();
    const FitOptions how{.profiles = options.profiles, .known = known, .stop = options.stop};
    const FitReport report = options.fit ? options.fit(drawn, how) : fit(drawn, how);
    const std::lock_guard lock(mutex);
    ++answer.draws;
    if (options.report) options.report(answer.draws);
    if (report.interrupted) {
      --answer.draws;
      return;
    }
    if (report.status < FitStatus::not_identified) {
      const std::string reason = std::string(name_of(report.status)) + ": " + report.reason;
      if (!contains(answer.failures, reason)) answer.failures.push_back(reason);
      return;
    }
    ++answer.fitted;
    for (std::size_t j = 0; j < problem.size(); ++j) {
      const FittedParameter& fitted = report.parameters[j];
      ParameterCoverage& count = answer.parameters[j];
      count.linear += holds(fitted.linear, truth[j]);
      count.profile += options.profiles && holds(fitted.profile.interval, truth[j]);
      const Variable& variable = fitted.parameter.variable;
      const double offset =
          (variable.scaled(fitted.value) - scaled_truth[static_cast<Eigen::Index>(j)]) / fitted.relative_error;
      if (!std::isfinite(offset)) continue;
      count.mean_offset += offset;
      squares[j] += offset * offset;
    }
  });
  for (std::size_t j = 0; j < problem.size(); ++j) {
    ParameterCoverage& count = answer.parameters[j];
    count.mean_offset /= answer.fitted;
    count.offset_scatter = std::sqrt(squares[j] / answer.fitted - count.mean_offset * count.mean_offset);
  }
  return answer;
}

}  // namespace rollres
