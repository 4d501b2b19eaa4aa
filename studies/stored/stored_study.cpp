#include "studies/stored/stored_study.hpp"

#include <stdexcept>

#include "studies/text/strict_json.hpp"

namespace rollres {

StudySummary stored_study(ResultStore& store, const std::string& name) {
  if (!name.empty())
    if (auto study = store.study(name)) return std::move(*study);
  const std::string& file = store.database().name();
  const std::vector<std::string> all = store.study_names();
  if (all.empty()) throw std::invalid_argument(file + ": holds no study");
  if (name.empty() && all.size() == 1) return store.study(all.front()).value();
  const std::vector<std::string_view> names(all.begin(), all.end());
  if (!name.empty())
    throw std::invalid_argument(file + ": study = " + name + ": " + unknown("unknown study", names, name));
  std::string list;
  for (const std::string& one : all) list += (list.empty() ? "" : ", ") + one;
  throw std::invalid_argument(file + ": holds several studies, choose one with --study: " + list);
}

}  // namespace rollres
