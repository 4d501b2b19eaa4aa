#include "db/merge/gathered.hpp"

#include "db/merge/merge.hpp"
#include "db/merge/readable_source.hpp"
#include "db/rows/schema.hpp"

namespace rollres {

GatheredDatabases::GatheredDatabases(std::span<const std::string> files) : file_(files.front()) {
  if (files.size() == 1) return;
  file_ = folder_.emplace() / "gathered.db";
  const Database all = open_database(file_, Access::write);
  for (const std::string& file : files)
    for (const auto& [name, here] : merge(all, file).renamed) renamed_.push_back({file, name, here});
}

std::string GatheredDatabases::renamed_in_words() const {
  std::string lines;
  for (const auto& [file, name, here] : renamed_)
    lines += file + ": study " + name + " is defined otherwise and comes as " + here + '\n';
  return lines;
}

}  // namespace rollres
