#pragma once

/// Whether errors are what they are said to be: on random scenes (stability_scene.hpp) each way to solve one is
/// compared with a finer solution.
///
/// The reference of a cylinder is the spectral method's at a tolerance of 1e-10, where that answers, else, and of a
/// sphere, the Newton method's at a fifth of the smallest tolerance. Where the reference itself is known no better than
/// to a third of what is judged, nothing is counted. All ways of one scene are solved in one child process, each
/// from cold kernels.

#include "core/solve/rolling_contact.hpp"
#include "db/queries/table.hpp"
#include "studies/evidence/stability_scene.hpp"

namespace rollres {

/// The time limit is that of one scene with all its solutions.
struct RandomAccuracyPlan : RandomScenes {
  std::vector<double> tolerances{1e-2, 1e-3};
};

/// What came of one way to solve one scene.
struct JudgedNumbers {
  Status status = Status::not_converged;
  double seconds = RollingSolution::absent;
  int contact_nodes = 0;
  double error_estimate = RollingSolution::absent;  ///< as the solution says, relative
  double error = RollingSolution::absent;           ///< against the reference, relative; NaN: no reference
  double uncertainty = RollingSolution::absent;     ///< of the reference
};
struct JudgedSolution : JudgedNumbers {
  std::size_t number = 0;  ///< of the scene
  RollingScene scene;      ///< with its method, and its spacing or its tolerance
};

struct RandomAccuracyReport {
  std::vector<JudgedSolution> solutions;  ///< by indenter, number and way
  bool interrupted = false;
};

/// @throws std::runtime_error if no child process can be started
RandomAccuracyReport measure_random_accuracy(const RandomAccuracyPlan& plan, const Evaluate& evaluate);

/// What became of one way to solve the scenes of one indenter. Shares are NaN where nothing could be counted.
struct RandomAccuracyCount {
  Method method = Method::newton;
  Indenter indenter = Indenter::cylinder;
  double tolerance = RollingSolution::absent;  ///< absent: with the scene's spacing
  std::size_t converged = 0, judged = 0;
  double covered = 0;       ///< share of the judged whose error is at most its estimate
  double median_ratio = 0;  ///< of estimate to error
  double met = 0;           ///< share of those with a good reference whose error is at most the tolerance
  double median_seconds = 0, seconds_95 = 0;
  double median_nodes = 0;
};

std::vector<RandomAccuracyCount> counts_of(const std::vector<JudgedSolution>& solutions);

/// A row for each way and indenter.
Table random_accuracy_table(const std::vector<RandomAccuracyCount>& counts);
/// A row for each solution, with all inputs of its scene.
Table judged_table(const std::vector<JudgedSolution>& solutions);

}  // namespace rollres
