#include "studies/relations/relation_run.hpp"

#include <algorithm>

#include "studies/scene_io/cells.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

namespace {

/// All trials of a plan, every relation in turn, so that the first part of a run tells of all.
std::vector<RelationTrial> planned(const RelationPlan& plan) {
  std::vector<RelationTrial> trials;
  for (std::size_t number = 0; number < std::max(plan.cylinders, plan.spheres); ++number)
    for (std::size_t relation = 0; relation < relations().size(); ++relation) {
      const bool asked = contains(plan.names, relations()[relation].name);
      if (!plan.names.empty() && !asked) continue;
      if (number < plan.cylinders) trials.push_back({relation, Indenter::cylinder, number});
      if (number < plan.spheres && relations()[relation].of_spheres)
        trials.push_back({relation, Indenter::sphere, number});
    }
  return trials;
}

RelationFinding tried(const RelationPlan& plan, const RelationTrial& trial, const Evaluate& evaluate) {
  const RelatedScenes scenes =
      related_scenes(relations()[trial.relation], trial.indenter, plan.seed, trial.number, plan.spectra);
  return try_relation(scenes, [&](RollingScene scene) {
    scene.time_limit = plan.time_limit;
    return evaluate(scene);
  });
}

/// What a child process tells of a trial.
template <class Finding, class Visitor>
void visit_finding(Finding&& finding, Visitor&& visitor) {
  visitor(finding.outcome);
  visitor(finding.worst);
  visitor(finding.output);
  visitor(finding.difference);
  visitor(finding.words);
  visitor(finding.one);
  visitor(finding.other);
}

RelationFinding found(const PieceEnd& end) {
  RelationFinding finding;
  if (end.out_of_time) {
    finding.outcome = RelationOutcome::unanswered;
    finding.words = "no answers within the time limit";
  } else if (!end.death.empty()) {
    finding.words = end.death;
  } else {
    visit_finding(finding, Unpacker{end.answer});
  }
  return finding;
}

/// The trials of one relation and one indenter.
struct RelationCount {
  std::string_view relation;
  Indenter indenter = Indenter::cylinder;
  std::array<std::size_t, ChoiceNames<RelationOutcome>::names.size()> of{};
  const RelationTrial* worst = nullptr;  ///< of those compared

  void add(const RelationTrial& trial) {
    ++of[static_cast<std::size_t>(trial.finding.outcome)];
    const bool compared = !trial.finding.output.empty();
    if (compared && (!worst || trial.finding.worst > worst->finding.worst)) worst = &trial;
  }
  std::size_t trials() const {
    std::size_t sum = 0;
    for (const std::size_t count : of) sum += count;
    return sum;
  }
};

std::vector<RelationCount> relation_counts(const std::vector<RelationTrial>& trials) {
  std::vector<RelationCount> counts;
  for (std::size_t relation = 0; relation < relations().size(); ++relation)
    for (const Indenter indenter : {Indenter::cylinder, Indenter::sphere}) {
      RelationCount count{relations()[relation].name, indenter};
      for (const RelationTrial& trial : trials)
        if (trial.relation == relation && trial.indenter == indenter) count.add(trial);
      if (count.trials() > 0) counts.push_back(count);
    }
  return counts;
}

}  // namespace

RelationReport run_relations(const RelationPlan& plan, const Evaluate& evaluate) {
  const std::vector<RelationTrial> trials = planned(plan);
  ForkedWork work = plan.work(trials.size());
  work.time_limit = 2.2 * plan.time_limit;  // of two solutions that end by themselves
  const auto tell = [&](const RelationTrial& trial, Packer& pack) {
    visit_finding(tried(plan, trial, evaluate), pack);
  };
  const auto take = [](RelationTrial& trial, const PieceEnd& end) {
    trial.finding = found(end);
    return !is_broken(trial);
  };
  RelationReport report{.trials = try_forked(std::move(work), trials, tell, take)};
  stable_sort(report.trials, [](const RelationTrial& a, const RelationTrial& b) {
    return a.relation != b.relation ? a.relation < b.relation : a.indenter < b.indenter;
  });
  report.interrupted = report.trials.size() < trials.size();
  return report;
}

Table relations_table(const std::vector<RelationTrial>& trials) {
  return table_of(relation_counts(trials), [](const RelationCount& count) {
    NamedCells row{{"relation", std::string(count.relation)},
                   {"indenter", cell_of(count.indenter)},
                   {"tried", cell_of(count.trials())}};
    for (std::size_t i = 0; i < count.of.size(); ++i)
      row.emplace_back(ChoiceNames<RelationOutcome>::names[i], cell_of(count.of[i]));
    row.emplace_back("worst", cell_of(count.worst ? count.worst->finding.worst : RollingSolution::absent));
    row.emplace_back("difference", cell_of(count.worst ? count.worst->finding.difference : RollingSolution::absent));
    row.emplace_back("of", cell_of(count.worst ? count.worst->finding.output : std::string()));
    return row;
  });
}

Table relation_trials_table(const std::vector<RelationTrial>& trials) {
  return table_of(trials, [](const RelationTrial& trial) {
    return NamedCells{{"relation", std::string(relations()[trial.relation].name)},
                      {"indenter", cell_of(trial.indenter)},
                      {"number", cell_of(trial.number)},
                      {"outcome", cell_of(trial.finding.outcome)},
                      {"worst", cell_of(trial.finding.worst)},
                      {"difference", cell_of(trial.finding.difference)},
                      {"output", cell_of(trial.finding.output)},
                      {"words", cell_of(trial.finding.words)}};
  });
}

std::string trial_name(const RelationTrial& trial) {
  std::string name(relations()[trial.relation].name);
  std::replace(name.begin(), name.end(), ' ', '_');
  return name + '-' + std::string(name_of(trial.indenter)) + '-' + std::to_string(trial.number);
}

std::string trial_scene_json(const RelationTrial& trial, const std::string& scene) {
  Json file = Json::object();
  file["comment"] = std::string(relations()[trial.relation].meaning) + ": " + trial.finding.words;
  file.update(parse_object(scene, "scene"));
  return file.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace rollres
