#include "studies/stored/study_provenance.hpp"

#include <algorithm>
#include <map>

#include "db/queries/query.hpp"

namespace rollres {

std::vector<ComputedShare> computed_shares(ResultStore& store, const std::string& study) {
  const Table results = run_query(store.database(), {.filters = {{"study", Comparison::equal, study}},
                                                     .columns = {"id", "provenance", "created", "seconds"}});
  std::map<std::int64_t, ComputedShare> shares;
  for (const std::vector<Cell>& row : results.rows) {
    ComputedShare& share = shares[std::get<std::int64_t>(row[1])];
    const std::string& time = std::get<std::string>(row[2]);
    if (share.points++ == 0) {
      share.program = store.find(std::get<std::int64_t>(row[0])).value().provenance;
      share.first = share.last = time;
    }
    share.first = std::min(share.first, time);
    share.last = std::max(share.last, time);
    if (const auto* const seconds = std::get_if<double>(&row[3])) share.seconds += *seconds;
  }
  std::vector<ComputedShare> list;
  for (auto& [ignored, share] : shares) list.push_back(std::move(share));
  return list;
}

}  // namespace rollres
