#pragma once

/// One pattern of zones after the other, solved with rising orders: which of them obeys all laws, and how sure its
/// answer is.

#include <algorithm>
#include <optional>
#include <vector>

#include "core/zones/spectral_accuracy.hpp"
#include "core/zones/spectral_contact.hpp"
#include "core/zones/spectral_search.hpp"

namespace rollres {

class PatternRefinement {
 public:
  /// @param model  lives longer
  /// @throws std::domain_error where continuous edges have no problem to solve
  PatternRefinement(const ContactModel& model, const CreepSpectrum& creep);
  PatternRefinement(const PatternRefinement&) = delete;
  PatternRefinement& operator=(const PatternRefinement&) = delete;

  /// Solves with rising orders until the tolerance is met; true if the answer obeys all laws. Gives up where higher
  /// orders will not help: the pattern is wrong, a violation stays, coefficients do not fall, or work is used up.
  /// @param near  where the edges are from, if they are from another scene
  bool refine(const SlipPattern& pattern, const SpectralEdges& edges, const FoundZones* near = nullptr);

  /// Whether the best answer is as sure as asked for, or than no grid would be.
  bool answered() const;
  /// The best answer, with its warning where it misses the tolerance. @pre there is one
  SpectralOutcome take_best();

  /// From now on edges to start with are a grid's, and patterns are tried anew.
  void start_from_grid();
  void forget_tried() { tried_.clear(); }
  void forget_work() { work_ = 0; }
  bool was_tried(const SlipPattern& pattern) const {
    return std::find(tried_.begin(), tried_.end(), pattern.slips) != tried_.end();
  }

  /// Takes over what the tractions make of a coating's M and N (S18). @return by how much they change the drive's row
  /// [N/m]
  double take_coating(SpectralState& state, const CoatingMoments& now);
  void start_coating_at(const CoatingMoments& moments) { problem_.coating_moments = moments; }

  const SpectralProblem& problem() const { return problem_; }
  /// Of the last pattern: its state, if its edges were found, and what of it is wrong, from the leading edge on.
  const std::optional<SpectralState>& last() const { return last_; }
  const std::vector<WrongRun>& wrong_runs() const { return wrong_runs_; }
  double wrong() const { return wrong_; }
  int evaluations() const { return evaluations_; }

 private:
  struct Rise;
  struct Sketch;
  enum class Verdict { accepted, refuted, next_order };

  Rise begin(const SlipPattern& pattern, const SpectralEdges& edges, const FoundZones* near) const;
  bool solve_order(Rise& rise);
  Verdict judge(Rise& rise);
  bool take_last_order(Rise& rise);
  bool settle_coating(Rise& rise, int order, SpectralState& state);
  AssessedSpectral settled_and_assessed(Rise& rise);
  std::optional<SpectralState> searched(Rise& rise, const SpectralEdges& start, int order, double residual,
                                        int most_evaluations);

  Sketch sketched(Rise& rise);

  bool keep_best(AssessedSpectral& assessed, const Rise& rise);
  /// Takes the last state for the answer if all laws hold.
  bool accept(AssessedSpectral& assessed, const Rise& rise, double held);
  void take_over_wrongs(const AssessedSpectral& assessed) {
    wrong_ = assessed.wrong_zone;
    wrong_runs_ = assessed.wrong_runs;
  }

  bool dear_ring() const;
  /// Whether the drive asks for a sum of the tractions, of which the coating's M and N are part.
  bool driven() const;
  double held_violation() const { return model_.ring() ? borne_violation : largest_violation; }

  const ContactModel& model_;
  SpectralProblem problem_;
  SpectralAccuracy accuracy_;
  std::optional<SpectralState> last_;
  std::optional<AssessedSpectral> best_;
  double wrong_ = RollingSolution::absent;
  std::vector<WrongRun> wrong_runs_;
  std::vector<std::vector<int>> tried_;  // slips of patterns that were refined
  bool from_grid_ = false;               // whether edges to start with are a grid's
  int evaluations_ = 0;
  double work_ = 0;
  std::optional<FoundZones> zones_;  // of the best answer
  double scale_ = 0;                 // by which errors of the best answer are measured [N/m]
};

}  // namespace rollres
