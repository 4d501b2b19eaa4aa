#include "db/merge/gathered.hpp"

#include "db/merge/merge.hpp"
#include "db/merge/readable_source.hpp"
#include "db/rows/schema.hpp"

namespace rollres {

GatheredDatabases::GatheredDatabases(std::span<const std::string> files) : file_(files.front()) {
  if (files.size() == 1) return;
  folder_ = temporary_folder();
  file_ = folder_ / "gathered.db";
  try {
    const Database all = open_database(file_, Access::write);
    for (const std::string& file : files)
      for (const auto& [name, here] : merge(all, file).renamed) renamed_.push_back({file, name, here});
  } catch (...) {
    std::error_code none;
    std::filesystem::remove_all(folder_, none);
    throw;
  }
}

GatheredDatabases::~GatheredDatabases() {
  std::error_code none;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, none);
}

}  // namespace rollres
