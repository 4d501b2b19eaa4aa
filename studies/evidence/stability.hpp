#pragma once

/// Which method fails where: every method solves the same random scenes (stability_scene.hpp), and what it says is not
/// believed.

#include <numeric>

#include "core/solve/rolling_contact.hpp"
#include "db/queries/table.hpp"
#include "studies/drawing/chart_frame.hpp"
#include "studies/evidence/stability_scene.hpp"

namespace rollres {

/// How a method fared with a scene.
enum class Outcome {
  converged,      ///< with every law of contact held: law_violation < 1e-8
  refused,        ///< no_steady_state, and indeed: it converges with 2 % more friction than it says it needs, and does
                  ///< not with 2 % less; or the other way round where it says that the body digs itself in
  unconfirmed,    ///< no_steady_state, but that is not so, or it does not say how much friction it needs or bears
  not_converged,  ///< no answer, and it says so; or none within the time limit
  wrong,          ///< says converged, but a law of contact is violated or a number of the answer is not finite
  crashed         ///< threw an exception, or ended its process
};
template <>
struct ChoiceNames<Outcome> {
  static constexpr std::array<std::string_view, 6> names{"converged",     "refused", "unconfirmed",
                                                         "not_converged", "wrong",   "crashed"};
};

/// Whether the outcome is one to look into.
inline bool is_failure(Outcome outcome) { return outcome != Outcome::converged && outcome != Outcome::refused; }

/// One scene solved by one method.
struct Trial {
  std::size_t number = 0;  ///< of the scene among those of its indenter
  RollingScene scene;      ///< with the method
  Outcome outcome = Outcome::crashed;
  double seconds = RollingSolution::absent;  ///< of the solution, without its confirmation [s]
  std::string reason = {};                   ///< the method's own, or what is wrong with its answer
  RollingSolution solution = {};             ///< without its fields
};

/// Solves a scene, and where it is refused also with more and with less friction. Never throws.
Trial judge(const Evaluate& evaluate, const RollingScene& scene) noexcept;

/// Every input of each trial under its key, the outcome, and the numbers.
Table trials_table(const std::vector<Trial>& trials);

/// A scene file that solves the trial's scene again, with its outcome as a comment.
std::string failed_scene_json(const Trial& trial);

/// The name of that file: "newton-cylinder-17.json".
std::string failed_scene_name(const Trial& trial);

struct StabilityPlan : RandomScenes {
  std::vector<Method> methods = {};
  std::function<void(const Trial&)> on_trial = {};  ///< called as each comes
};

struct StabilityReport {
  std::vector<Trial> trials;  ///< by indenter, number and method
  bool interrupted = false;
  double seconds = 0;
};

/// @throws std::runtime_error if no child process can be started
StabilityReport run_stability(const StabilityPlan& plan, const Evaluate& evaluate);

/// What became of the scenes of one method and one indenter.
struct StabilityCount {
  Method method;
  Indenter indenter;
  std::array<std::size_t, ChoiceNames<Outcome>::names.size()> of{};
  double median_seconds = 0, seconds_95 = 0, longest_seconds = 0;  ///< of trials that did not crash

  std::size_t operator[](Outcome outcome) const { return of[static_cast<std::size_t>(outcome)]; }
  std::size_t trials() const { return std::accumulate(of.begin(), of.end(), std::size_t{0}); }
};

/// One for each method and indenter that was tried.
std::vector<StabilityCount> counts(const std::vector<Trial>& trials);

/// The map of a method: speed against friction, a point for each scene, its outcome by colour and by mark; failures
/// are drawn over the rest.
PictureText stability_map(const std::vector<Trial>& trials, const ChartFiles& files);

/// Draws the trials of one method and one indenter, of which there is at least one.
/// @throws as draw_chart
ChartFiles draw_stability_map(const std::vector<Trial>& trials, const std::filesystem::path& name);

}  // namespace rollres
