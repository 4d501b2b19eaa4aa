#include "studies/stored/study_status.hpp"

#include <algorithm>
#include <set>

#include "db/merge/readable_source.hpp"
#include "db/rows/point_states.hpp"
#include "db/rows/result_store.hpp"
#include "studies/study/predicted_cost.hpp"
#include "studies/study/shards.hpp"

namespace rollres {

StudyStatus study_status(const Study& study, std::span<const std::filesystem::path> databases, int shards) {
  const StudyPlan plan(study);
  std::vector<std::string> keys(plan.size());
  if (!databases.empty() || shards > 1) keys = plan.keys();
  const std::vector<double> predictions = predicted_seconds(plan);
  std::vector<PointState> best(keys.size());
  for (const std::filesystem::path& file : databases) {
    const std::vector<PointState> here = point_states(ReadableSource(file).database(), keys);
    for (std::size_t i = 0; i < best.size(); ++i)
      if (here[i].answer > best[i].answer) best[i] = here[i];
  }

  StudyStatus status;
  status.points = keys.size();
  status.seconds_left = 0;
  const std::vector<int> shard = shards_of_points(keys, predictions, shards);
  std::set<int> missing;
  double took = 0, predicted = 0;
  for (std::size_t i = 0; i < best.size(); ++i) {
    const double seconds = predictions[i];
    if (best[i].answer == Answer::missing) {
      ++status.missing;
      status.seconds_left += seconds;
      missing.insert(shard[i]);
      continue;
    }
    ++(best[i].answer == Answer::converged ? status.converged : status.failed);
    took += best[i].seconds;
    predicted += seconds;
  }
  if (took > 0) status.seconds_left *= took / predicted;
  status.shards_missing.assign(missing.begin(), missing.end());
  return status;
}

}  // namespace rollres
