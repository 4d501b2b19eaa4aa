#pragma once

/// Relations (relations.hpp) tried on many random scenes, each pair of scenes in a process of its own.

#include "db/queries/table.hpp"
#include "studies/relations/relations.hpp"

namespace rollres {

/// So many scenes of each indenter for each relation. The time limit is that of both scenes of a pair.
struct RelationPlan : RandomScenes {
  std::vector<std::string> names = {};  ///< of the relations to try; empty: all
};

/// What came of one pair of scenes.
struct RelationTrial {
  std::size_t relation = 0;  ///< place in relations()
  Indenter indenter = Indenter::cylinder;
  std::size_t number = 0;  ///< of the scene
  RelationFinding finding = {};
};

struct RelationReport {
  std::vector<RelationTrial> trials;  ///< by relation, indenter and number
  bool interrupted = false;
};

/// @throws std::runtime_error if no child process can be started
RelationReport run_relations(const RelationPlan& plan, const Evaluate& evaluate);

/// Whether a relation does not hold, or a process ended.
inline bool is_broken(const RelationTrial& trial) {
  return trial.finding.outcome == RelationOutcome::broken || trial.finding.outcome == RelationOutcome::crashed;
}

/// A row for each relation and indenter: how many were tried, the outcomes, and the worst.
Table relations_table(const std::vector<RelationTrial>& trials);

/// A row for each pair.
Table relation_trials_table(const std::vector<RelationTrial>& trials);

/// The name of a trial, for its files: "cut_in_two-cylinder-17".
std::string trial_name(const RelationTrial& trial);

/// One of its scenes as a scene file, with what differs as a comment. @param scene  one or other of the finding
std::string trial_scene_json(const RelationTrial& trial, const std::string& scene);

}  // namespace rollres
